// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package AngularAcceleration "Angular acceleration sensitivity"
  extends PyImu.Icons.EffectPackage;

  function angularAccelerationOutput "angular acceleration sensitivity"
    extends Modelica.Icons.Function;
    input Real x[3], c[3,3], acceleration[3];
    output Real y[3];
  algorithm
    y[1] := x[1] + (c[1,2]*acceleration[2] + c[1,3]*acceleration[3]);
    y[2] := x[2] + (c[2,1]*acceleration[1] + c[2,3]*acceleration[3]);
    y[3] := x[3] + (c[3,1]*acceleration[1] + c[3,2]*acceleration[2]);
  end angularAccelerationOutput;

  block Gyro "Angular acceleration sensitivity, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real c[3,3](each unit="s") = fill(0, 3, 3)
      "Output of axis i per angular acceleration about axis j";
    Modelica.Blocks.Interfaces.RealInput acceleration[3](each unit="rad/s2", start={0, 0, 0})
      "Rate of the angular rate, body axes"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    assert(abs(c[1,1]) + abs(c[2,2]) + abs(c[3,3]) <= 0,
      "angular_acceleration: c must have zeros on its diagonal");
    when sample(samplePeriod, samplePeriod) then
      y = angularAccelerationOutput(x, c, acceleration);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"), c(each unit="m/rad"))
    "Angular acceleration sensitivity, of an accelerometer";

  block GyroContinuous "Angular acceleration sensitivity, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real c[3,3](each unit="s") = fill(0, 3, 3)
      "Output of axis i per angular acceleration about axis j";
    Modelica.Blocks.Interfaces.RealInput acceleration[3](each unit="rad/s2", start={0, 0, 0})
      "Rate of the angular rate, body axes"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    assert(abs(c[1,1]) + abs(c[2,2]) + abs(c[3,3]) <= 0,
      "angular_acceleration: c must have zeros on its diagonal");
    y = angularAccelerationOutput(x, c, acceleration);
  end GyroContinuous;

  block AccelContinuous = GyroContinuous(x(each unit="m/s2"), y(each unit="m/s2"), c(each
    unit="m/rad")) "Angular acceleration sensitivity, of an accelerometer, without samples";

  annotation(Documentation(info="<html>
<p>Angular acceleration sensitivity; stage: gain.</p>
<p>Equation (LaTeX): <code>y_i = x_i + \\sum_{j \\ne i} c_{ij} \\dot\\omega_j</code></p>
<p>Source: IEEE Std 528-2001, 2.11, angular acceleration sensitivity; of an accelerometer the
angular-acceleration coefficient of IEEE Std 1293, whose text was not checked.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>c</td><td>{y}/(rad/s^2)</td><td>output of axis i per angular acceleration about axis
j</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
<p>It wants new inputs at every sample: the difference of held ones is zero.</p>
</html>"));
end AngularAcceleration;
