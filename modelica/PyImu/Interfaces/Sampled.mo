within PyImu.Interfaces;
partial block Sampled "Something that acts at sample instants, the first one period after the start"
  extends PyImu.Icons.Effect;
  parameter Modelica.Units.SI.Time samplePeriod(min=1e-9) = 0.01
    "Time between two samples, the first at this time" annotation(Evaluate=true);
equation
  assert(samplePeriod > 0, "samplePeriod must be a positive number of seconds");
  annotation(Documentation(info="<html>
<p>Sample k is made at the time k samplePeriod. The period is structural: another one is another
model.</p>
</html>"));
end Sampled;
