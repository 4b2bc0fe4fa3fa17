within PyImu.Noise;
function layerOf "The layer of the ziggurat, 0 to 255, that a word chooses by its lowest 8 bits"
  extends Modelica.Icons.Function;
  input Real word[4];
  output Real y;
algorithm
  y := word[1] - 256*floor(word[1]/256);
  annotation(Documentation(info="<html>
<p>The lowest 8 bits of the lowest limb. Marsaglia, Tsang, The ziggurat method for generating random
variables, Journal of Statistical Software 5(8), 2000.</p>
</html>"));
end layerOf;
