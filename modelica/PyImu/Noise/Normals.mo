within PyImu.Noise;
block Normals "Standard normals of several channels, new ones at each sample"
  extends PyImu.Interfaces.Sampled;
  replaceable function draw = PyImu.Noise.drawNormals
    constrainedby PyImu.Interfaces.NormalsFunction "What draws them" annotation(choicesAllMatching=true);
  parameter Integer n = 3 "Number of channels";
  parameter Real channel[n] "Number of each channel: the CRC-32 of the variable's name";
  parameter Real seed(min=0) "Whole number, not negative";
  parameter Boolean useC = globalSeed.useC "True where the tool compiles C: faster, the same numbers"
    annotation(Evaluate=true, choices(checkBox=true));
  parameter Boolean useTable = false "True where a table stands for the draws"
    annotation(Evaluate=true, choices(checkBox=true));
  parameter Real table[:, n] = fill(0, 1, n)
    "A row for each sample; after the last one the first comes again"
    annotation(Dialog(enable=useTable));
  outer PyImu.Noise.GlobalSeed globalSeed "What all noise of a model shares";
  Modelica.Blocks.Interfaces.RealOutput y[n] "Standard normals"
    annotation(Placement(transformation(extent={{100,-10},{120,10}})));
protected
  discrete Real k(start=0, fixed=true) "Number of the sample";
  discrete Integer row(start=0, fixed=true) "Row of the table";
equation
  assert(size(table, 1) > 0, "table must have a row at least");
  assert(seed >= 0 and seed <= floor(seed) and seed < 9007199254740992.0,
    "seed must be a whole number, not negative, below 2^53");
  for i in 1:n loop
    assert(channel[i] >= 0 and channel[i] <= floor(channel[i]) and channel[i] < 9007199254740992.0,
      "channel must be whole numbers, not negative, below 2^53");
  end for;
  when sample(samplePeriod, samplePeriod) then
    k = pre(k) + 1;
    row = mod(pre(row), size(table, 1)) + 1;
    y = if useTable then table[row, :]
      elseif useC then drawNormalsC(seed, channel, k)
      else draw(seed, channel, k);
  end when;
  annotation(Documentation(info="<html>
<p>Sample k of a channel is a function of seed, channel and k alone. With <code>useC</code>, which is set
once for a model by <code>globalSeed(useC=true)</code>, the C of the co-simulation units draws it; else
the same in pure Modelica. A table stands for the draws with <code>useTable</code>.</p>
</html>"));
end Normals;
