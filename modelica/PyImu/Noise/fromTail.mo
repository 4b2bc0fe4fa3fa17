within PyImu.Noise;
function fromTail "A normal of the tail beyond the lowest layer, 0 where the words are refused"
  extends Modelica.Icons.Function;
  input Real words[16];
  output Real y;
protected
  Real beyond;
algorithm
  beyond := -log(uniform({words[1], words[2], words[3], words[4]}))/layerEdge(1);
  y := if -2*log(uniform({words[5], words[6], words[7], words[8]})) > beyond*beyond then
    layerEdge(1) + beyond else 0;
  annotation(Documentation(info="<html>
<p>x = -log(u1)/r is taken where -2 log(u2) is more than x^2; Marsaglia, Generating a variable from
the tail of the normal distribution, Technometrics 6, 1964.</p>
</html>"));
end fromTail;
