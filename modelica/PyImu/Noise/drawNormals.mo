within PyImu.Noise;
function drawNormals "The standard normals of a sample of several channels, in Modelica"
  extends PyImu.Interfaces.NormalsFunction;
algorithm
  for i in 1:size(channel, 1) loop
    y[i] := normal(seed, channel[i], number);
  end for;
  annotation(Documentation(info="<html>
<p>In pure Modelica, some 5000 operations a number; drawNormalsC is faster where a tool compiles
C.</p>
</html>"));
end drawNormals;
