within PyImu.Noise;
function normal "The standard normal of a sample of a channel"
  extends PyImu.Interfaces.NormalFunction;
protected
  Real four "Number of the four samples that share words";
  Real words[16];
  Real word[4];
  Integer first;
algorithm
  four := floor(number/4);
  words := philox(seed, channel, four + 1, 0);
  first := integer(4*(number - 4*four));
  word := {words[first + 1], words[first + 2], words[first + 3], words[first + 4]};
  y := abscissa(word);
  if not abs(y) < layerEdge(layerOf(word) + 1) then
    y := beyondTheEdge(seed, channel, number, word);
  end if;
  annotation(Documentation(info="<html>
<p>The number that the co-simulation units draw for this seed, channel and sample, to the last bit
where the tool's exp and log are those of the C library. The channel is the CRC-32 of a variable's
name, the first sample is number 1.</p>
</html>"));
end normal;
