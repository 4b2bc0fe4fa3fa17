// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package Sculling "Sculling from undersampling"
  extends PyImu.Icons.EffectPackage;

  function scullingOutput "sculling from undersampling"
    extends Modelica.Icons.Function;
    input Real x[3], c, rate[3], acceleration[3], jerk[3], h;
    output Real y[3];
  protected
    Real v1;
  algorithm
    v1 := c*(h*h)/12;
    y[1] := x[1] + v1*(acceleration[2]*x[3] - acceleration[3]*x[2] + (jerk[2]*rate[3] -
      jerk[3]*rate[2]));
    y[2] := x[2] + v1*(acceleration[3]*x[1] - acceleration[1]*x[3] + (jerk[3]*rate[1] -
      jerk[1]*rate[3]));
    y[3] := x[3] + v1*(acceleration[1]*x[2] - acceleration[2]*x[1] + (jerk[1]*rate[2] -
      jerk[2]*rate[1]));
  end scullingOutput;

  block Accel "Sculling from undersampling, of an accelerometer"
    extends PyImu.Interfaces.SampledEffect(x(each unit="m/s2"), y(each unit="m/s2"));
    parameter Real c(unit="1") = 0 "Share of the sculling correction that is missing";
    Modelica.Blocks.Interfaces.RealInput rate[3](each unit="rad/s", start={0, 0, 0})
      "Angular rate against inertial space, body axes"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={-50,-120})));
    Modelica.Blocks.Interfaces.RealInput acceleration[3](each unit="rad/s2", start={0, 0, 0})
      "Rate of the angular rate, body axes"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
    Modelica.Blocks.Interfaces.RealInput jerk[3](each unit="m/s3", start={0, 0, 0})
      "Rate of the specific force, body axes"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={50,-120})));
  equation
    when sample(samplePeriod, samplePeriod) then
      y = scullingOutput(x, c, rate, acceleration, jerk, samplePeriod);
    end when;
  end Accel;

  annotation(Documentation(info="<html>
<p>Sculling from undersampling; stage: motion.</p>
<p>Equation (LaTeX): <code>y = x - c \\tfrac{h}{12} (\\omega_{k-1} \\times x_k + x_{k-1} \\times
\\omega_k) = x + c \\tfrac{h^2}{12} (\\dot\\omega \\times x + \\dot f \\times \\omega)</code></p>
<p>Source: two-sample correction of the velocity increment, as in Savage; no source checked for the
factor 1/12; c = 1 is a read-out without it.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>c</td><td>1</td><td>share of the sculling correction that is missing</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
<p>It wants new inputs at every sample: the difference of held ones is zero.</p>
</html>"));
end Sculling;
