within PyImu.Interfaces;
partial function NormalFunction "Standard normals as a function of seed, channel and sample"
  extends Modelica.Icons.Function;
  input Real seed "Whole number, not negative, below 2^53";
  input Real channel "Whole number, not negative, below 2^53";
  input Real number "Number of the sample";
  output Real y "Standard normal";
  annotation(Documentation(info="<html>
<p>A number that depends on its three arguments alone, so that neither a solver's steps nor another
instance change it.</p>
</html>"));
end NormalFunction;
