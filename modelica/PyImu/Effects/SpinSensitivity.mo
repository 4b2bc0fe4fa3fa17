// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package SpinSensitivity "Spin-rate sensitivity, anisoinertia"
  extends PyImu.Icons.EffectPackage;

  function spinSensitivityOutput "spin-rate sensitivity, anisoinertia"
    extends Modelica.Icons.Function;
    input Real x[3], s[3,3], rate[3];
    output Real y[3];
  algorithm
    y[1] := x[1] + rate[1]*(s[1,1]*rate[1] + s[1,2]*rate[2] + s[1,3]*rate[3]);
    y[2] := x[2] + rate[2]*(s[2,1]*rate[1] + s[2,2]*rate[2] + s[2,3]*rate[3]);
    y[3] := x[3] + rate[3]*(s[3,1]*rate[1] + s[3,2]*rate[2] + s[3,3]*rate[3]);
  end spinSensitivityOutput;

  block Accel "Spin-rate sensitivity, anisoinertia, of an accelerometer"
    extends PyImu.Interfaces.SampledEffect(x(each unit="m/s2"), y(each unit="m/s2"));
    parameter Real s[3,3](each unit="m/rad2") = fill(0, 3, 3)
      "Output of axis i per product of the rates about axes i and j; i = j: spin";
    Modelica.Blocks.Interfaces.RealInput rate[3](each unit="rad/s", start={0, 0, 0})
      "Angular rate against inertial space, body axes"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    when sample(samplePeriod, samplePeriod) then
      y = spinSensitivityOutput(x, s, rate);
    end when;
  end Accel;

  block AccelContinuous "Spin-rate sensitivity, anisoinertia, of an accelerometer, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="m/s2"), y(each unit="m/s2"));
    parameter Real s[3,3](each unit="m/rad2") = fill(0, 3, 3)
      "Output of axis i per product of the rates about axes i and j; i = j: spin";
    Modelica.Blocks.Interfaces.RealInput rate[3](each unit="rad/s", start={0, 0, 0})
      "Angular rate against inertial space, body axes"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    y = spinSensitivityOutput(x, s, rate);
  end AccelContinuous;

  annotation(Documentation(info="<html>
<p>Spin-rate sensitivity, anisoinertia; stage: gain.</p>
<p>Equation (LaTeX): <code>y_i = x_i + \\omega_i \\sum_j s_{ij} \\omega_j</code></p>
<p>Source: IEEE Std 528-2019, anisoinertia (A), the product of the rates about input and pendulous
axis, and spin-rate terms of IEEE Std 1293, whose text was not checked; no source for the
square.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>s</td><td>{y}/(rad/s)^2</td><td>output of axis i per product of the rates about axes i and
j; i = j: spin</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end SpinSensitivity;
