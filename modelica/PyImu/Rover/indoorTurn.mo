within PyImu.Rover;
function indoorTurn "Mean turn rate of the sample period that ends with sample k, and whether the robot stands"
  extends Modelica.Icons.Function;
  input Real k "Number of the sample, from 0";
  input Real samplePeriod "s";
  input Real count "Periods of the drive, a whole number";
  input Integer width "Samples over which an edge is rounded, an odd number";
  output Real y[2] "Share of the turn rate, its edges rounded by a Gaussian; 1 where the robot stands";
protected
  Real spread "Standard deviation of the Gaussian in samples: a sixth of the ramp of 0.3 s";
  Real weight;
  Real weights;
  Real sum;
  Real phase[2];
  Real j "Sample from the middle of the Gaussian";
algorithm
  spread := 0.3/6/samplePeriod;
  j := -(width + 1)/2;
  weights := 0;
  sum := 0;
  for i in 1:width loop
    j := j + 1;
    weight := exp(-0.5*(j/spread)^2);
    weights := weights + weight;
    phase := indoorPhase(min(k - 1 + j, count - 1), samplePeriod);
    sum := sum + weight*phase[1];
  end for;
  phase := indoorPhase(k - 1, samplePeriod);
  y := if k > count then {0, 1} else {sum/weights, if phase[2] > 0.5 or abs(sum) > 0 then 0 else 1};
  annotation(Documentation(info="<html>
<p>The edges of the turns, rounded by a Gaussian whose standard deviation is a sixth of the ramp of
0.3 s and which is cut off at three of them: where it is cut off the robot stands. As
pyimu.rover.indoor.</p>
</html>"));
end indoorTurn;
