within PyImu.Interfaces;
partial block NoiseSource "Noise of three axes"
  extends PyImu.Interfaces.Sampled;
  parameter Integer count = 3 "Number of normals";
  parameter Real seed(min=0) = mod(1.0*globalSeed.seed
    + Modelica.Utilities.Strings.hashString(getInstanceName()), 2147483647)
    "Seed of the noise: a whole number, not negative";
  parameter Real channel[count] = linspace(1, count, count) "Numbers of the streams";
  outer PyImu.Noise.GlobalSeed globalSeed "Seed of all that have none of their own";
  PyImu.Noise.Normals normals(samplePeriod=samplePeriod, n=count, seed=seed, channel=channel);
  Modelica.Blocks.Interfaces.RealOutput y[3] "Noise"
    annotation(Placement(transformation(extent={{100,-10},{120,10}})));
  annotation(Documentation(info="<html>
<p>Normals of some channels, and what is made of them. Without a seed of its own a source mixes the
hash of its instance's name into globalSeed.seed.</p>
</html>"));
end NoiseSource;
