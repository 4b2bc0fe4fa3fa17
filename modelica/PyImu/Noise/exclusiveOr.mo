within PyImu.Noise;
function exclusiveOr "a xor b of two words"
  extends Modelica.Icons.Function;
  input Real a[4];
  input Real b[4];
  output Real y[4];
protected
  constant Real nibble[256] = {
    0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15,
    1, 0, 3, 2, 5, 4, 7, 6, 9, 8, 11, 10, 13, 12, 15, 14,
    2, 3, 0, 1, 6, 7, 4, 5, 10, 11, 8, 9, 14, 15, 12, 13,
    3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12,
    4, 5, 6, 7, 0, 1, 2, 3, 12, 13, 14, 15, 8, 9, 10, 11,
    5, 4, 7, 6, 1, 0, 3, 2, 13, 12, 15, 14, 9, 8, 11, 10,
    6, 7, 4, 5, 2, 3, 0, 1, 14, 15, 12, 13, 10, 11, 8, 9,
    7, 6, 5, 4, 3, 2, 1, 0, 15, 14, 13, 12, 11, 10, 9, 8,
    8, 9, 10, 11, 12, 13, 14, 15, 0, 1, 2, 3, 4, 5, 6, 7,
    9, 8, 11, 10, 13, 12, 15, 14, 1, 0, 3, 2, 5, 4, 7, 6,
    10, 11, 8, 9, 14, 15, 12, 13, 2, 3, 0, 1, 6, 7, 4, 5,
    11, 10, 9, 8, 15, 14, 13, 12, 3, 2, 1, 0, 7, 6, 5, 4,
    12, 13, 14, 15, 8, 9, 10, 11, 4, 5, 6, 7, 0, 1, 2, 3,
    13, 12, 15, 14, 9, 8, 11, 10, 5, 4, 7, 6, 1, 0, 3, 2,
    14, 15, 12, 13, 10, 11, 8, 9, 6, 7, 4, 5, 2, 3, 0, 1,
    15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0} "i xor j at 16 i + j + 1";
  Real highA;
  Real highB;
  Real lowA;
  Real lowB;
algorithm
  for i in 1:4 loop
    highA := floor(a[i]/256);
    highB := floor(b[i]/256);
    lowA := a[i] - 256*highA;
    lowB := b[i] - 256*highB;
    y[i] := 4096*nibble[integer(16*floor(highA/16) + floor(highB/16)) + 1]
      + 256*nibble[integer(16*(highA - 16*floor(highA/16)) + (highB - 16*floor(highB/16))) + 1]
      + 16*nibble[integer(16*floor(lowA/16) + floor(lowB/16)) + 1]
      + nibble[integer(16*(lowA - 16*floor(lowA/16)) + (lowB - 16*floor(lowB/16))) + 1];
  end for;
  annotation(Documentation(info="<html>
<p>Bit by bit, by a table of half bytes: Modelica has no operation on bits.</p>
</html>"));
end exclusiveOr;
