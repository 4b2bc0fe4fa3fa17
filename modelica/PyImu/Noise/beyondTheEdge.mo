within PyImu.Noise;
function beyondTheEdge "The normal of a word that does not suffice, one in 67"
  extends Modelica.Icons.Function;
  input Real seed;
  input Real channel;
  input Real number;
  input Real first[4];
  output Real x;
protected
  constant Integer attempts = 63 "Each is refused with a chance below 0.07";
  Real words[16];
  Real word[4];
  Real size;
  Real layer;
  Boolean done;
algorithm
  word := first;
  x := abscissa(word);
  done := false;
  for attempt in 1:attempts loop
    if not done then
      words := philox(seed, channel, number, attempt);
      layer := layerOf(word);
      if layer < 0.5 then
        size := fromTail(words);
        if size > 0 then
          x := if x < 0 then -size else size;
          done := true;
        end if;
      elseif underBell(x, layer, {words[1], words[2], words[3], words[4]}) then
        done := true;
      else
        word := {words[5], words[6], words[7], words[8]};
        x := abscissa(word);
        done := abs(x) < layerEdge(layerOf(word) + 1);
      end if;
    end if;
  end for;
  annotation(Documentation(info="<html>
<p>A word of the lowest layer goes to the tail, one of another is taken if its point lies under the
bell, else the next word stands for it; further words come from the counter's second half, the
attempt. Marsaglia, Tsang, The ziggurat method for generating random variables, Journal of
Statistical Software 5(8), 2000, sections 2 and 3.</p>
</html>"));
end beyondTheEdge;
