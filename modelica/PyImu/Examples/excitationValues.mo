within PyImu.Examples;
function excitationValues "The values of Excitation at one sample"
  extends Modelica.Icons.Function;
  input Real k;
  input Real shift;
  input Real offset[:];
  input Real amplitude[size(offset, 1)];
  output Real y[size(offset, 1)];
protected
  Real j "The index as a real number, which some tools want in mod";
algorithm
  j := 0;
  for i in 1:size(offset, 1) loop
    j := j + 1;
    y[i] := offset[i] + amplitude[i]*(mod((j + shift)*k + 5*j, 19) - 9)/9;
  end for;
  annotation(Documentation(info="<html>
<p>offset[i] + amplitude[i] (((i + shift) k + 5 i) mod 19 - 9)/9.</p>
</html>"));
end excitationValues;
