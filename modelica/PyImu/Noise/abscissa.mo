within PyImu.Noise;
function abscissa "A point between -1 and 1 times the width of the word's layer"
  extends Modelica.Icons.Function;
  input Real word[4];
  output Real x;
protected
  Real odd;
  Real share "Whole number within -2^53 and 2^53";
algorithm
  odd := 2*floor(word[1]/2048) + 1;
  share := (word[4] - 32768)*274877906944.0 + word[3]*4194304.0 + word[2]*64 + odd;
  x := share/9007199254740992.0*layerEdge(layerOf(word));
  annotation(Documentation(info="<html>
<p>The top 54 bits of the word, made odd: 2^38 = 274877906944, 2^22 = 4194304, 2^53 =
9007199254740992.</p>
</html>"));
end abscissa;
