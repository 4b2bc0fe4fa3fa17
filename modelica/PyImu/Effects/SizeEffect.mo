// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package SizeEffect "Size effect, lever arm"
  extends PyImu.Icons.EffectPackage;

  function sizeEffectOutput "size effect, lever arm"
    extends Modelica.Icons.Function;
    input Real x[3], r[3,3], rate[3], acceleration[3];
    output Real y[3];
  algorithm
    y[1] := x[1] + (acceleration[2]*r[1,3] - acceleration[3]*r[1,2] + (rate[2]*(rate[1]*r[1,2] -
      rate[2]*r[1,1]) - rate[3]*(rate[3]*r[1,1] - rate[1]*r[1,3])));
    y[2] := x[2] + (acceleration[3]*r[2,1] - acceleration[1]*r[2,3] + (rate[3]*(rate[2]*r[2,3] -
      rate[3]*r[2,2]) - rate[1]*(rate[1]*r[2,2] - rate[2]*r[2,1])));
    y[3] := x[3] + (acceleration[1]*r[3,2] - acceleration[2]*r[3,1] + (rate[1]*(rate[3]*r[3,1] -
      rate[1]*r[3,3]) - rate[2]*(rate[2]*r[3,3] - rate[3]*r[3,2])));
  end sizeEffectOutput;

  block Accel "Size effect, lever arm, of an accelerometer"
    extends PyImu.Interfaces.SampledEffect(x(each unit="m/s2"), y(each unit="m/s2"));
    parameter Real r[3,3](each unit="m") = fill(0, 3, 3)
      "Position of element i from the point whose force is meant, along axis j";
    Modelica.Blocks.Interfaces.RealInput rate[3](each unit="rad/s", start={0, 0, 0})
      "Angular rate against inertial space, body axes"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={-33,-120})));
    Modelica.Blocks.Interfaces.RealInput acceleration[3](each unit="rad/s2", start={0, 0, 0})
      "Rate of the angular rate, body axes"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={33,-120})));
  equation
    when sample(samplePeriod, samplePeriod) then
      y = sizeEffectOutput(x, r, rate, acceleration);
    end when;
  end Accel;

  block AccelContinuous "Size effect, lever arm, of an accelerometer, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="m/s2"), y(each unit="m/s2"));
    parameter Real r[3,3](each unit="m") = fill(0, 3, 3)
      "Position of element i from the point whose force is meant, along axis j";
    Modelica.Blocks.Interfaces.RealInput rate[3](each unit="rad/s", start={0, 0, 0})
      "Angular rate against inertial space, body axes"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={-33,-120})));
    Modelica.Blocks.Interfaces.RealInput acceleration[3](each unit="rad/s2", start={0, 0, 0})
      "Rate of the angular rate, body axes"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={33,-120})));
  equation
    y = sizeEffectOutput(x, r, rate, acceleration);
  end AccelContinuous;

  annotation(Documentation(info="<html>
<p>Size effect, lever arm; stage: motion.</p>
<p>Equation (LaTeX): <code>y_i = x_i + e_i \\cdot (\\alpha \\times r_i + \\omega \\times (\\omega \\times
r_i))</code></p>
<p>Source: rigid-body kinematics.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>r</td><td>m</td><td>position of element i from the point whose force is meant, along axis
j</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
<p>It wants new inputs at every sample: the difference of held ones is zero.</p>
</html>"));
end SizeEffect;
