within PyImu;
package Noise "Standard normals as a function of seed, channel and sample, and noise made of them"
  extends Modelica.Icons.Package;
  annotation(Documentation(info="<html>
<p>Randomness is an input of the effects. <code>normal</code> gives the numbers that the co-simulation units draw: they depend on seed, channel and sample and on nothing else, so that a run does not depend on the solver's steps.</p>
<p>The words are those of Philox4x64-10 (Salmon, Moraes, Dror, Shaw, 2011) with key (seed, channel); a word becomes a normal through a ziggurat of 256 layers (Marsaglia, Tsang, 2000).</p>
</html>"));
end Noise;
