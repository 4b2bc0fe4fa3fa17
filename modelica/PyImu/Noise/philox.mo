within PyImu.Noise;
function philox "The four words of Philox4x64-10 for the counter (counter0, counter1, 0, 0)"
  extends Modelica.Icons.Function;
  input Real seed;
  input Real channel;
  input Real counter0;
  input Real counter1;
  output Real words[16] "Four words of four limbs";
protected
  constant Real multiplier0[4] = {27795, 57676, 18190, 53991};
  constant Real multiplier1[4] = {4439, 38162, 33379, 51802};
  constant Real weyl0[4] = {31765, 32586, 31161, 40503};
  constant Real weyl1[4] = {42811, 33994, 44677, 47975};
  Real key0[4];
  Real key1[4];
  Real x0[4];
  Real x1[4];
  Real x2[4];
  Real x3[4];
  Real p0[8];
  Real p1[8];
algorithm
  key0 := limbs(seed);
  key1 := limbs(channel);
  x0 := limbs(counter0);
  x1 := limbs(counter1);
  x2 := {0, 0, 0, 0};
  x3 := {0, 0, 0, 0};
  for round in 1:10 loop
    p0 := productOfWords(multiplier0, x0);
    p1 := productOfWords(multiplier1, x2);
    x0 := exclusiveOr(exclusiveOr({p1[5], p1[6], p1[7], p1[8]}, x1), key0);
    x2 := exclusiveOr(exclusiveOr({p0[5], p0[6], p0[7], p0[8]}, x3), key1);
    x1 := {p1[1], p1[2], p1[3], p1[4]};
    x3 := {p0[1], p0[2], p0[3], p0[4]};
    key0 := sumOfWords(key0, weyl0);
    key1 := sumOfWords(key1, weyl1);
  end for;
  words := {x0[1], x0[2], x0[3], x0[4], x1[1], x1[2], x1[3], x1[4],
    x2[1], x2[2], x2[3], x2[4], x3[1], x3[2], x3[3], x3[4]};
  annotation(Documentation(info="<html>
<p>Salmon, Moraes, Dror, Shaw, Parallel random numbers: as easy as 1, 2, 3, SC11, 2011; key (seed,
channel). In limbs of 16 bits held as Real: products stay below 2^34 and sums below 2^53, so that
every step is exact in any tool, whatever the range of its integers.</p>
</html>"));
end philox;
