// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu;
package ShapingFilters "Noises as filters on white noise in continuous time"
  extends Modelica.Icons.Package;
  annotation(Documentation(info="<html>
<p>From white noise of two-sided density 1 to the noise of one axis. The sampled noises of
PyImu.Noise have the same densities far below half the sample rate.</p>
</html>"));
end ShapingFilters;
