// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package ClockSkew "Clock skew"
  extends PyImu.Icons.EffectPackage;

  function clockSkewOutput "clock skew"
    extends Modelica.Icons.Function;
    input Real x[3], eps, t, slope[3];
    output Real y[3];
  protected
    Real v1;
  algorithm
    v1 := eps*t;
    y[1] := x[1] + v1*slope[1];
    y[2] := x[2] + v1*slope[2];
    y[3] := x[3] + v1*slope[3];
  end clockSkewOutput;

  block Gyro "Clock skew, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real eps(unit="1") = 0
      "Relative error of the clock's rate; eps t must stay short against the motion";
    Modelica.Blocks.Interfaces.RealInput t(unit="s", start=0) "Time since power-on"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={-33,-120})));
    Modelica.Blocks.Interfaces.RealInput slope[3](each unit="rad/s2", start={0, 0, 0})
      "Rate of the angular rate, body axes"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={33,-120})));
  equation
    when sample(samplePeriod, samplePeriod) then
      y = clockSkewOutput(x, eps, t, slope);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2")) "Clock skew, of an accelerometer";

  block GyroContinuous "Clock skew, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real eps(unit="1") = 0
      "Relative error of the clock's rate; eps t must stay short against the motion";
    Modelica.Blocks.Interfaces.RealInput t(unit="s", start=0) "Time since power-on"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={-33,-120})));
    Modelica.Blocks.Interfaces.RealInput slope[3](each unit="rad/s2", start={0, 0, 0})
      "Rate of the angular rate, body axes"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={33,-120})));
  equation
    y = clockSkewOutput(x, eps, t, slope);
  end GyroContinuous;

  block AccelContinuous = GyroContinuous(x(each unit="m/s2"), y(each unit="m/s2"))
    "Clock skew, of an accelerometer, without samples";

  annotation(Documentation(info="<html>
<p>Clock skew; stage: gain.</p>
<p>Equation (LaTeX): <code>y = x + \\epsilon t \\dot x</code></p>
<p>Source: no source; first order in the time by which the clock is off, short against the
motion.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>eps</td><td>1</td><td>relative error of the clock&#x27;s rate; eps t must stay short against
the motion</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
<p>It wants new inputs at every sample: the difference of held ones is zero.</p>
</html>"));
end ClockSkew;
