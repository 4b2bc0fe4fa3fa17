within PyImu.Noise;
function drawNormals "The standard normals of a sample of several channels, in Modelica"
  extends PyImu.Interfaces.NormalsFunction;
algorithm
  for i in 1:size(channel, 1) loop
    y[i] := normal(seed, channel[i], number);
  end for;
end drawNormals;
