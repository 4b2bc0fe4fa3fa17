// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Attitude;
class AttitudeUkfMemory "What AttitudeUkf remembers from sample to sample, in C"
  extends ExternalObject;

  function constructor "A filter before its first sample"
    extends Modelica.Icons.Function;
    input Real samplePeriod "s";
    input Real p[:] "Parameters, in the order of the co-simulation unit";
    output AttitudeUkfMemory memory;
  external "C" memory = pyimu_imt30_ukf_create(samplePeriod, p, size(p, 1))
    annotation(Include="#include \"pyimu_imt30_ukf.c\"", IncludeDirectory="modelica://PyImu/Resources/C-Sources");
  end constructor;

  function destructor "Free the memory"
    extends Modelica.Icons.Function;
    input AttitudeUkfMemory memory;
  external "C" pyimu_imt30_ukf_free(memory)
    annotation(Include="#include \"pyimu_imt30_ukf.c\"", IncludeDirectory="modelica://PyImu/Resources/C-Sources");
  end destructor;

  annotation(Documentation(info="<html>
<p>A tool makes it at the start of a run and frees it at the end; nobody else calls it.</p>
</html>"));
end AttitudeUkfMemory;
