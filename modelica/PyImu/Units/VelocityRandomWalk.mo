within PyImu.Units;
type VelocityRandomWalk = Real(final quantity="VelocityRandomWalk", min=0) "Root of the two-sided density of a specific force's white noise; unit m/s/sqrt(s)"
  annotation(Documentation(info="<html>
<p>Modelica's units have whole exponents (Modelica specification, chapter 19), and this one has a
root; so it stands in the description.</p>
</html>"));
