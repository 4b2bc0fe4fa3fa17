within PyImu.Noise;
function tableRow "Row of a table, from the first on again after the last"
  extends Modelica.Icons.Function;
  input Real table[:,:];
  input Real number;
  output Real y[size(table, 2)];
protected
  Integer row;
algorithm
  row := integer(mod(number - 1, size(table, 1))) + 1;
  for i in 1:size(table, 2) loop
    y[i] := table[row, i];
  end for;
end tableRow;
