within PyImu.Noise;
function drawNormalsC "The standard normals of a sample of several channels, by C"
  extends PyImu.Interfaces.NormalsFunction;
algorithm
  for i in 1:size(channel, 1) loop
    y[i] := normalByC(seed, channel[i], number);
  end for;
end drawNormalsC;
