within PyImu.Noise;
function normals "The standard normals of a sample of several channels"
  extends Modelica.Icons.Function;
  input Real seed;
  input Real channel[:];
  input Real sample;
  output Real y[size(channel, 1)];
algorithm
  for i in 1:size(channel, 1) loop
    y[i] := normal(seed, channel[i], sample);
  end for;
end normals;
