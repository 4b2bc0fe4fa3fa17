within PyImu.Sensors;
block Sampler "The input at each sample, held until the next"
  extends PyImu.Interfaces.SampledEffect;
equation
  when sample(samplePeriod, samplePeriod) then
    y = x;
  end when;
  annotation(Documentation(info="<html>
<p>A perfect sensor that is sampled: what a part has where it declares no effect.</p>
</html>"));
end Sampler;
