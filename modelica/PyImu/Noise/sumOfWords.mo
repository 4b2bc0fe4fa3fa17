within PyImu.Noise;
function sumOfWords "a + b modulo 2^64"
  extends Modelica.Icons.Function;
  input Real a[4];
  input Real b[4];
  output Real y[4];
protected
  Real carry;
  Real digit;
algorithm
  carry := 0;
  for i in 1:4 loop
    digit := a[i] + b[i] + carry;
    carry := floor(digit/65536);
    y[i] := digit - 65536*carry;
  end for;
  annotation(Documentation(info="<html>
<p>Limb by limb with a carry.</p>
</html>"));
end sumOfWords;
