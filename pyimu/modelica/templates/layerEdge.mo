within PyImu.Noise;
function layerEdge "Where layer i of the ziggurat ends, i from 0 to 256"
  extends Modelica.Icons.Function;
  input Real i;
  output Real x;
protected
  constant Real edges[257] = {
{% for line in lines %}
    {{ line }}
{% endfor %}
    0};
algorithm
  x := edges[integer(i) + 1];
  annotation(Documentation(info="<html>
<p>256 layers of equal area under exp(-x^2/2); Marsaglia, Tsang, The ziggurat method for generating
random variables, Journal of Statistical Software 5(8), 2000, section 2.</p>
</html>"));
end layerEdge;
