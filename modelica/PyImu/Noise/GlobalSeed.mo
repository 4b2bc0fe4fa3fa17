within PyImu.Noise;
block GlobalSeed "What all noise of a model shares: the seed of sensors that have none, and C or not"
  parameter Integer seed(min=0) = 0 "Whole number, not negative";
  parameter Boolean useC = false "True where the tool compiles C: noise is drawn faster, the same numbers"
    annotation(Evaluate=true, choices(checkBox=true));
equation
  assert(seed >= 0, "globalSeed.seed must not be negative");
  annotation(
    defaultComponentName="globalSeed",
    defaultComponentPrefixes="inner",
    missingInnerMessage="No globalSeed is there: one with the seed 0 is taken.",
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100,-100},{100,100}}), graphics={
      Rectangle(extent={{-100,100},{100,-100}}, lineColor={0,0,127}, fillColor={255,255,255},
        fillPattern=FillPattern.Solid),
      Text(extent={{-90,40},{90,-40}}, textString="seed", textColor={0,0,127})}),
    Documentation(info="<html>
<p>A sensor mixes the hash of its instance's name into it, so that two sensors differ without being
told. Give a sensor a seed of its own to have the numbers of a co-simulation unit with that seed.</p>
</html>"));
end GlobalSeed;
