// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package Coning "Coning from undersampling"
  extends PyImu.Icons.EffectPackage;

  function coningOutput "coning from undersampling"
    extends Modelica.Icons.Function;
    input Real x[3], c, acceleration[3], h;
    output Real y[3];
  protected
    Real v1;
  algorithm
    v1 := c*(h*h)/12;
    y[1] := x[1] - v1*(x[2]*acceleration[3] - x[3]*acceleration[2]);
    y[2] := x[2] - v1*(x[3]*acceleration[1] - x[1]*acceleration[3]);
    y[3] := x[3] - v1*(x[1]*acceleration[2] - x[2]*acceleration[1]);
  end coningOutput;

  block Gyro "Coning from undersampling, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real c(unit="1") = 0 "Share of the coning correction that is missing";
    Modelica.Blocks.Interfaces.RealInput acceleration[3](each unit="rad/s2", start={0, 0, 0})
      "Rate of the angular rate, body axes"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    when sample(samplePeriod, samplePeriod) then
      y = coningOutput(x, c, acceleration, samplePeriod);
    end when;
  end Gyro;

  annotation(Documentation(info="<html>
<p>Coning from undersampling; stage: motion.</p>
<p>Equation (LaTeX): <code>y = x - c \\tfrac{h}{12}\\, x_{k-1} \\times x_k = x - c \\tfrac{h^2}{12}\\, x
\\times \\dot\\omega</code></p>
<p>Source: two-sample correction of the rotation vector, as in Savage; no source checked for the
factor 1/12; c = 1 is a read-out without it.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>c</td><td>1</td><td>share of the coning correction that is missing</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
<p>It wants new inputs at every sample: the difference of held ones is zero.</p>
</html>"));
end Coning;
