within PyImu.UsersGuide;
class Noise "Seeds, channels, and tools without C"
  extends Modelica.Icons.Information;
  annotation(DocumentationClass=true, Documentation(info="<html>
<p>A normal is a function of seed, channel and sample. The channel is the CRC-32 of the variable's name in the
co-simulation unit, so equal seeds give equal samples here and there; but a unit takes the seed 0, where it starts, for the
name of its instance. A seed is a whole number, not negative. A sensor without one mixes
<code>globalSeed.seed</code> with the hash of its instance's name, so that two sensors differ: put an
<code>inner PyImu.Noise.GlobalSeed</code> beside them.</p>
<p><code>Noise.drawNormals</code> draws in pure Modelica, some 5000 operations a number.
<code>Noise.drawNormalsC</code> draws the same numbers by the C of the units, for all sensors of a model
where <code>globalSeed(useC=true)</code> says so. The function <code>draw</code> of the block
<code>Noise.Normals</code> is replaceable, and with <code>useTable</code> a table stands for it.</p>
</html>"));
end Noise;
