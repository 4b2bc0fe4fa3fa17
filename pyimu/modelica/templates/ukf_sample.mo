impure function {{ function }} "One sample of {{ name }}, in C"
  extends Modelica.Icons.Function;
  input {{ name }}Memory memory "What it remembers";
  input Real number "Number of the sample; 0 is the start";
  input Real u[{{ inputs }}] "Inputs, in the order of the co-simulation unit";
  output Real y[{{ outputs }}] "Outputs, in that order";
external "C" {{ prefix }}_sample(memory, number, u, size(u, 1), y, size(y, 1))
  annotation(Include="#include \"{{ file }}\"", IncludeDirectory="{{ folder }}");
  annotation(Documentation(info="<html>
<p>A sample follows the one before it; the same number once more makes the same sample again, as a
tool may evaluate an event several times.</p>
</html>"));
end {{ function }};
