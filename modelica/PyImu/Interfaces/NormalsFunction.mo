within PyImu.Interfaces;
partial function NormalsFunction "Standard normals of a sample of several channels"
  extends Modelica.Icons.Function;
  input Real seed "Whole number, not negative, below 2^53";
  input Real channel[:] "Whole numbers, not negative, below 2^53";
  input Real number "Number of the sample, the first is 1";
  output Real y[size(channel, 1)] "Standard normals";
  annotation(Documentation(info="<html>
<p>What Noise.Normals may draw by: as Noise.normal, several channels at a time.</p>
</html>"));
end NormalsFunction;
