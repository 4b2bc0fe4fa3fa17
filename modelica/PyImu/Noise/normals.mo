within PyImu.Noise;
function normals "The standard normals of a sample of several channels, in Modelica"
  extends PyImu.Interfaces.NormalsFunction;
algorithm
  for i in 1:size(channel, 1) loop
    y[i] := normal(seed, channel[i], sample);
  end for;
end normals;
