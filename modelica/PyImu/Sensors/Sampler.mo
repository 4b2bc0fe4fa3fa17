within PyImu.Sensors;
block Sampler "The input at each sample, held until the next"
  extends PyImu.Interfaces.SampledEffect;
equation
  when sample(samplePeriod, samplePeriod) then
    y = x;
  end when;
end Sampler;
