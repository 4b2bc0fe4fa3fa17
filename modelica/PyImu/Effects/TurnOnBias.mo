// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package TurnOnBias "Turn-on bias"
  extends PyImu.Icons.EffectPackage;

  function turnOnBiasOutput "turn-on bias"
    extends Modelica.Icons.Function;
    input Real x[3], b0[3];
    output Real y[3];
  algorithm
    y[1] := x[1] + b0[1];
    y[2] := x[2] + b0[2];
    y[3] := x[3] + b0[3];
  end turnOnBiasOutput;

  block Gyro "Turn-on bias, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real b0[3](each unit="rad/s") = fill(0, 3)
      "Turn-on bias, a new draw at each power-on";
  equation
    when sample(samplePeriod, samplePeriod) then
      y = turnOnBiasOutput(x, b0);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"), b0(each unit="m/s2"))
    "Turn-on bias, of an accelerometer";

  block GyroContinuous "Turn-on bias, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real b0[3](each unit="rad/s") = fill(0, 3)
      "Turn-on bias, a new draw at each power-on";
  equation
    y = turnOnBiasOutput(x, b0);
  end GyroContinuous;

  block AccelContinuous = GyroContinuous(x(each unit="m/s2"), y(each unit="m/s2"), b0(each
    unit="m/s2")) "Turn-on bias, of an accelerometer, without samples";

  annotation(Documentation(info="<html>
<p>Turn-on bias; stage: bias.</p>
<p>Equation (LaTeX): <code>y = x + b_0</code></p>
<p>Source: Groves 2013, eqs. 4.16 and 4.17, terms b_a and b_g.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>b0</td><td>{y}</td><td>turn-on bias, a new draw at each power-on</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end TurnOnBias;
