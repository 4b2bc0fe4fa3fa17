within PyImu.Noise;
function limbs "A whole number below 2^53 as four limbs of 16 bits, the lowest first"
  extends Modelica.Icons.Function;
  input Real number;
  output Real word[4];
protected
  Real rest;
algorithm
  rest := number;
  for i in 1:4 loop
    word[i] := rest - 65536*floor(rest/65536);
    rest := floor(rest/65536);
  end for;
  annotation(Documentation(info="<html>
<p>Each limb is a Real below 65536.</p>
</html>"));
end limbs;
