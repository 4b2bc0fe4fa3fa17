within PyImu.Noise;
function productOfWords "a b in full, eight limbs"
  extends Modelica.Icons.Function;
  input Real a[4];
  input Real b[4];
  output Real y[8];
protected
  Real column[8] "Sums of products of limbs, each below 2^34";
  Real carry;
  Real digit;
algorithm
  column := {
    a[1]*b[1],
    a[1]*b[2] + a[2]*b[1],
    a[1]*b[3] + a[2]*b[2] + a[3]*b[1],
    a[1]*b[4] + a[2]*b[3] + a[3]*b[2] + a[4]*b[1],
    a[2]*b[4] + a[3]*b[3] + a[4]*b[2],
    a[3]*b[4] + a[4]*b[3],
    a[4]*b[4],
    0};
  carry := 0;
  for i in 1:8 loop
    digit := column[i] + carry;
    carry := floor(digit/65536);
    y[i] := digit - 65536*carry;
  end for;
  annotation(Documentation(info="<html>
<p>School multiplication in limbs of 16 bits; all sums are exact, as they stay below 2^53.</p>
</html>"));
end productOfWords;
