within PyImu.Noise;
function underBell "Whether a point of the wedge of layer i lies under the bell"
  extends Modelica.Icons.Function;
  input Real x;
  input Real i;
  input Real word[4];
  output Boolean y;
algorithm
  y := uniform(word)*(bell(layerEdge(i + 1)) - bell(layerEdge(i))) < bell(x) - bell(layerEdge(i));
end underBell;
