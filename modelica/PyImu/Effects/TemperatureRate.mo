// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package TemperatureRate "Bias temperature-gradient sensitivity"
  extends PyImu.Icons.EffectPackage;

  function temperatureRateOutput "bias temperature-gradient sensitivity"
    extends Modelica.Icons.Function;
    input Real x[3], kd[3], Td;
    output Real y[3];
  algorithm
    y[1] := x[1] + kd[1]*Td;
    y[2] := x[2] + kd[2]*Td;
    y[3] := x[3] + kd[3]*Td;
  end temperatureRateOutput;

  block Gyro "Bias temperature-gradient sensitivity, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real kd[3](each unit="rad/K") = fill(0, 3) "Bias per rate of temperature";
    Modelica.Blocks.Interfaces.RealInput Td(unit="K/s", start=0) "Rate of the temperature"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    when sample(samplePeriod, samplePeriod) then
      y = temperatureRateOutput(x, kd, Td);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"), kd(each unit="m/(s.K)"))
    "Bias temperature-gradient sensitivity, of an accelerometer";

  block GyroContinuous "Bias temperature-gradient sensitivity, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real kd[3](each unit="rad/K") = fill(0, 3) "Bias per rate of temperature";
    Modelica.Blocks.Interfaces.RealInput Td(unit="K/s", start=0) "Rate of the temperature"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    y = temperatureRateOutput(x, kd, Td);
  end GyroContinuous;

  block AccelContinuous = GyroContinuous(x(each unit="m/s2"), y(each unit="m/s2"), kd(each
    unit="m/(s.K)")) "Bias temperature-gradient sensitivity, of an accelerometer, without samples";

  annotation(Documentation(info="<html>
<p>Bias temperature-gradient sensitivity; stage: bias.</p>
<p>Equation (LaTeX): <code>y = x + k_d \\dot T</code></p>
<p>Source: no source for the equation; data sheets state its coefficient per K/min (STIM300, bias
over temperature gradients).</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>kd</td><td>{y}*s/K</td><td>bias per rate of temperature</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end TemperatureRate;
