// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package RateRamp "Rate (acceleration) ramp"
  extends PyImu.Icons.EffectPackage;

  function rateRampOutput "rate (acceleration) ramp"
    extends Modelica.Icons.Function;
    input Real x[3], R[3], t;
    output Real y[3];
  algorithm
    y[1] := x[1] + R[1]*t;
    y[2] := x[2] + R[2]*t;
    y[3] := x[3] + R[3]*t;
  end rateRampOutput;

  block Gyro "Rate (acceleration) ramp, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real R[3](each unit="rad/s2") = fill(0, 3) "Bias that grows with time";
    Modelica.Blocks.Interfaces.RealInput t(unit="s", start=0) "Time since power-on"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    when sample(samplePeriod, samplePeriod) then
      y = rateRampOutput(x, R, t);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"), R(each unit="m/s3"))
    "Rate (acceleration) ramp, of an accelerometer";

  block GyroContinuous "Rate (acceleration) ramp, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real R[3](each unit="rad/s2") = fill(0, 3) "Bias that grows with time";
    Modelica.Blocks.Interfaces.RealInput t(unit="s", start=0) "Time since power-on"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    y = rateRampOutput(x, R, t);
  end GyroContinuous;

  block AccelContinuous = GyroContinuous(x(each unit="m/s2"), y(each unit="m/s2"), R(each
    unit="m/s3")) "Rate (acceleration) ramp, of an accelerometer, without samples";

  annotation(Documentation(info="<html>
<p>Rate (acceleration) ramp; stage: bias.</p>
<p>Equation (LaTeX): <code>y = x + R t</code></p>
<p>Source: Hidalgo 2012, table 3, rate ramp.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>R</td><td>{y}/s</td><td>bias that grows with time</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end RateRamp;
