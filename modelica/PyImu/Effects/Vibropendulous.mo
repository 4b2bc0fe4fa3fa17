// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package Vibropendulous "Vibropendulous error, cross coupling"
  extends PyImu.Icons.EffectPackage;

  function vibropendulousOutput "vibropendulous error, cross coupling"
    extends Modelica.Icons.Function;
    input Real x[3], kp[3,3];
    output Real y[3];
  algorithm
    y[1] := x[1] + x[1]*(kp[1,2]*x[2] + kp[1,3]*x[3]);
    y[2] := x[2] + x[2]*(kp[2,1]*x[1] + kp[2,3]*x[3]);
    y[3] := x[3] + x[3]*(kp[3,1]*x[1] + kp[3,2]*x[2]);
  end vibropendulousOutput;

  block Accel "Vibropendulous error, cross coupling, of an accelerometer"
    extends PyImu.Interfaces.SampledEffect(x(each unit="m/s2"), y(each unit="m/s2"));
    parameter Real kp[3,3](each unit="s2/m") = fill(0, 3, 3)
      "Relative change of axis i's scale factor per force along axis j";
  equation
    assert(abs(kp[1,1]) + abs(kp[2,2]) + abs(kp[3,3]) <= 0,
      "vibropendulous: kp must have zeros on its diagonal");
    when sample(samplePeriod, samplePeriod) then
      y = vibropendulousOutput(x, kp);
    end when;
  end Accel;

  block AccelContinuous "Vibropendulous error, cross coupling, of an accelerometer, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="m/s2"), y(each unit="m/s2"));
    parameter Real kp[3,3](each unit="s2/m") = fill(0, 3, 3)
      "Relative change of axis i's scale factor per force along axis j";
  equation
    assert(abs(kp[1,1]) + abs(kp[2,2]) + abs(kp[3,3]) <= 0,
      "vibropendulous: kp must have zeros on its diagonal");
    y = vibropendulousOutput(x, kp);
  end AccelContinuous;

  annotation(Documentation(info="<html>
<p>Vibropendulous error, cross coupling; stage: gain.</p>
<p>Equation (LaTeX): <code>y_i = x_i + \\sum_{j \\ne i} k_{ij} x_i x_j</code></p>
<p>Source: cross-coupling coefficients K_ip and K_io of IEEE Std 1293, whose text was not
checked.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>kp</td><td>1/({y})</td><td>relative change of axis i&#x27;s scale factor per force along
axis j</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end Vibropendulous;
