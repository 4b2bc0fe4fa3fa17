within PyImu.Units;
type RateRandomWalk = Real(final quantity="RateRandomWalk", min=0) "Root of the two-sided density of a rate's derivative; unit rad/s/sqrt(s)"
  annotation(Documentation(info="<html>
<p>Modelica's units have whole exponents (Modelica specification, chapter 19), and this one has a
root; so it stands in the description.</p>
</html>"));
