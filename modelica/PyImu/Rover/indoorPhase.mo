within PyImu.Rover;
function indoorPhase "Share of the turn rate in one sample period of the indoor drive, and whether it drives"
  extends Modelica.Icons.Function;
  input Real i "Number of the period, from 0";
  input Real samplePeriod "s";
  output Real y[2] "Share of the turn rate before its edges are rounded; 1 where the robot moves";
protected
  constant Real sense[10] = {1, 1, -1, 1, 1, -1, 1, 1, -1, 1} "Of the quarter turns";
  Real rest "Periods of each rest, turn and straight, whole numbers";
  Real spin;
  Real last;
  Real stop;
  Real leg;
  Real quarter;
  Real start "Periods of the start-up motion";
  Real within_ "Period of its cycle";
algorithm
  rest := floor(2/samplePeriod + 0.5);
  spin := floor(6/samplePeriod + 0.5);
  last := floor(4/samplePeriod + 0.5);
  stop := floor(4.8/samplePeriod + 0.5);
  leg := floor(8.2/samplePeriod + 0.5);
  quarter := floor(3/samplePeriod + 0.5);
  start := 2*rest + 2*spin + last;
  within_ := mod(i - start, stop + leg + quarter);
  if i < 0 then
    y := {0, 0};
  elseif i < start then
    if i >= rest and i < rest + spin then
      y := {1, 1};
    elseif i >= 2*rest + spin and i < 2*rest + 2*spin then
      y := {-1, 1};
    else
      y := {0, 0};
    end if;
  elseif within_ < stop then
    y := {0, 0};
  elseif within_ < stop + leg then
    y := {0, 1};
  else
    y := {sense[integer(min(floor((i - start)/(stop + leg + quarter)), 9)) + 1], 1};
  end if;
  annotation(Documentation(info="<html>
<p>Start-up motion: 2 s of rest, 6 s to the left, 2 s of rest, 6 s to the right, 4 s of rest. Then
ten times 4.8 s of rest, 8.2 s straight on and 3 s of a quarter turn. As pyimu.rover.indoor, which
says what of it is assumed.</p>
</html>"));
end indoorPhase;
