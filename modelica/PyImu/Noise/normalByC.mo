within PyImu.Noise;
function normalByC "The standard normal of a sample of a channel, by the C of the co-simulation units"
  extends PyImu.Interfaces.NormalFunction;
external "C" y = pyimu_normal(seed, channel, number)
  annotation(Include="#include \"pyimu_normal.c\"",
    IncludeDirectory="modelica://PyImu/Resources/C-Sources");
  annotation(Documentation(info="<html>
<p>The same numbers as <code>normal</code>, faster. For tools that compile C.</p>
</html>"));
end normalByC;
