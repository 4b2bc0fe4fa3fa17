within PyImu.Rover;
function smoothProgress "How far a move has come that starts and ends smoothly, and its two derivatives"
  extends Modelica.Icons.Function;
  input Real t "Time since its start, s";
  input Real duration "Time that it takes at full speed, s";
  input Real ramp "Time in which it reaches its speed, and in which it ends, s";
  output Real y[3] "Seconds at full speed, share of that speed, its derivative";
protected
  Real x "Share of the first ramp";
  Real z "Share of the last one";
algorithm
  x := min(max(t/ramp, 0), 1);
  z := min(max((t - duration)/ramp, 0), 1);
  y := {
    min(max(t - ramp, 0), duration - ramp)
      + ramp*(x^4*(2.5 + x*(x - 3)) + (z - z^4*(2.5 + z*(z - 3)))),
    x^3*(10 + x*(6*x - 15)) - z^3*(10 + z*(6*z - 15)),
    (30*x^2*(1 - x)^2 - 30*z^2*(1 - z)^2)/ramp};
  annotation(Documentation(info="<html>
<p>The share of the speed rises along 10 x^3 - 15 x^4 + 6 x^5, whose derivatives vanish at both ends.</p>
</html>"));
end smoothProgress;
