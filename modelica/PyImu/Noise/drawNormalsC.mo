within PyImu.Noise;
function drawNormalsC "The standard normals of a sample of several channels, by C"
  extends PyImu.Interfaces.NormalsFunction;
algorithm
  for i in 1:size(channel, 1) loop
    y[i] := normalByC(seed, channel[i], number);
  end for;
  annotation(Documentation(info="<html>
<p>As drawNormals, by the C of the co-simulation units. For tools that compile C; rumoca 0.10.2 does
not.</p>
</html>"));
end drawNormalsC;
