class {{ name }}Memory "What {{ name }} remembers from sample to sample, in C"
  extends ExternalObject;

  function constructor "A filter before its first sample"
    extends Modelica.Icons.Function;
    input Real samplePeriod "s";
    input Real p[:] "Parameters, in the order of the co-simulation unit";
    output {{ name }}Memory memory;
  external "C" memory = {{ prefix }}_create(samplePeriod, p, size(p, 1))
    annotation(Include="#include \"{{ file }}\"", IncludeDirectory="{{ folder }}");
  end constructor;

  function destructor "Free the memory"
    extends Modelica.Icons.Function;
    input {{ name }}Memory memory;
  external "C" {{ prefix }}_free(memory)
    annotation(Include="#include \"{{ file }}\"", IncludeDirectory="{{ folder }}");
  end destructor;

  annotation(Documentation(info="<html>
<p>A tool makes it at the start of a run and frees it at the end; nobody else calls it.</p>
</html>"));
end {{ name }}Memory;
