within PyImu.Interfaces;
partial function NormalFunction "Standard normals as a function of seed, channel and sample"
  extends Modelica.Icons.Function;
  input Real seed "Whole number, not negative, below 2^53";
  input Real channel "Whole number, not negative, below 2^53";
  input Real number "Number of the sample";
  output Real y "Standard normal";
end NormalFunction;
