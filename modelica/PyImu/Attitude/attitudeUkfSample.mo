// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Attitude;
impure function attitudeUkfSample "One sample of AttitudeUkf, in C"
  extends Modelica.Icons.Function;
  input AttitudeUkfMemory memory "What it remembers";
  input Real number "Number of the sample; 0 is the start";
  input Real u[18] "Inputs, in the order of the co-simulation unit";
  output Real y[21] "Outputs, in that order";
external "C" pyimu_imt30_ukf_sample(memory, number, u, size(u, 1), y, size(y, 1))
  annotation(Include="#include \"pyimu_imt30_ukf.c\"", IncludeDirectory="modelica://PyImu/Resources/C-Sources");
  annotation(Documentation(info="<html>
<p>A sample follows the one before it; the same number once more makes the same sample again, as a
tool may evaluate an event several times.</p>
</html>"));
end attitudeUkfSample;
