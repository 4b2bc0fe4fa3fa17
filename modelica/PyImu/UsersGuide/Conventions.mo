within PyImu.UsersGuide;
class Conventions "Axes, units, densities, samples"
  extends Modelica.Icons.Information;
  annotation(DocumentationClass=true, Documentation(info="<html>
<ul>
<li>Body axes are forward, left, up; world axes are east, north, up. Quaternions are Hamilton's, scalar
first, from body to world.</li>
<li>A gyro measures rate against inertial space; specific force is +g on z at rest.</li>
<li>SI units and radians; temperature in degC. A unit with a root, such as rad/sqrt(s), stands in the
description, because Modelica's units have whole exponents.</li>
<li>A noise coefficient is the root of a two-sided density.</li>
<li>Sample k is made at the time k samplePeriod, the first one period after the start. Before it the
output is what a perfect sensor at rest shows. Of an input that jumps at the instant of a sample the
value after the jump counts. The solver's step changes no sample.</li>
<li>The sample period is structural: it cannot change in a run.</li>
</ul>
</html>"));
end Conventions;
