within PyImu.Noise;
block GlobalSeed "The seed that all sensors of a model share which have no seed of their own"
  parameter Integer seed(min=0) = 0 "Whole number, not negative";
  annotation(
    defaultComponentName="globalSeed",
    defaultComponentPrefixes="inner",
    missingInnerMessage="No globalSeed is there: one with the seed 0 is taken.",
    Documentation(info="<html>
<p>A sensor mixes the hash of its instance's name into it, so that two sensors differ without being
told. Give a sensor a seed of its own to have the numbers of a co-simulation unit with that seed.</p>
</html>"));
end GlobalSeed;
