within PyImu.Noise;
function underBell "Whether a point of the wedge of layer i lies under the bell"
  extends Modelica.Icons.Function;
  input Real x;
  input Real i;
  input Real word[4];
  output Boolean y;
algorithm
  y := uniform(word)*(bell(layerEdge(i + 1)) - bell(layerEdge(i))) < bell(x) - bell(layerEdge(i));
  annotation(Documentation(info="<html>
<p>A height between the layer's two edges, drawn evenly, lies below exp(-x^2/2). Marsaglia, Tsang,
The ziggurat method for generating random variables, Journal of Statistical Software 5(8), 2000,
section 2.</p>
</html>"));
end underBell;
