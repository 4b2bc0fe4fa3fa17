within PyImu.Noise;
function uniform "The middle of one of 2^52 equal cells of (0, 1), from the upper bits of a word"
  extends Modelica.Icons.Function;
  input Real word[4];
  output Real y;
algorithm
  y := (word[4]*68719476736.0 + word[3]*1048576.0 + word[2]*16 + floor(word[1]/4096) + 0.5)/4503599627370496.0;
  annotation(Documentation(info="<html>
<p>The upper 52 bits of a word and a half, over 2^52: never 0, never 1.</p>
</html>"));
end uniform;
