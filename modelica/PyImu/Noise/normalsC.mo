within PyImu.Noise;
function normalsC "The standard normals of a sample of several channels, by C"
  extends PyImu.Interfaces.NormalsFunction;
algorithm
  for i in 1:size(channel, 1) loop
    y[i] := normalC(seed, channel[i], sample);
  end for;
end normalsC;
