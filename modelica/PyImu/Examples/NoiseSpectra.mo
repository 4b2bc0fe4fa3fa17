within PyImu.Examples;
model NoiseSpectra "Each noise by itself, for its spectrum and Allan deviation"
  extends Modelica.Icons.Example;
  inner PyImu.Noise.GlobalSeed globalSeed;
  PyImu.Noise.WhiteNoise white(seed=1, N=fill(1e-4, 3))
    annotation(Placement(transformation(extent={{-60,40},{-20,80}})));
  PyImu.Noise.RateRandomWalk walk(seed=2, K=fill(1e-5, 3))
    annotation(Placement(transformation(extent={{20,40},{60,80}})));
  PyImu.Noise.GaussMarkov markov(seed=3, q=fill(1e-5, 3), tau=fill(10, 3))
    annotation(Placement(transformation(extent={{-60,-20},{-20,20}})));
  PyImu.Noise.Flicker flicker(seed=4, B=fill(1e-5, 3), f_low=1e-3, f_high=10)
    annotation(Placement(transformation(extent={{20,-20},{60,20}})));
  PyImu.Noise.Ramp ramp(R=fill(1e-6, 3))
    annotation(Placement(transformation(extent={{-60,-80},{-20,-40}})));
  annotation(
    experiment(StopTime=100, Interval=0.01),
    Documentation(info="<html>
<p>The sample period is 0.01 s. The formulas of spectrum and Allan deviation stand with the filters
in PyImu.ShapingFilters.</p>
</html>"));
end NoiseSpectra;
