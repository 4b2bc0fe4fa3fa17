// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package SamplingJitter "Sampling jitter"
  extends PyImu.Icons.EffectPackage;

  function samplingJitterOutput "sampling jitter"
    extends Modelica.Icons.Function;
    input Real x[3], sj, slope[3], w[1];
    output Real y[3];
  algorithm
    y[1] := x[1] + sj*slope[1]*w[1];
    y[2] := x[2] + sj*slope[2]*w[1];
    y[3] := x[3] + sj*slope[3]*w[1];
  end samplingJitterOutput;

  block Gyro "Sampling jitter, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real sj(unit="s", min=0) = 0 "Standard deviation of the instant of sampling";
    Modelica.Blocks.Interfaces.RealInput slope[3](each unit="rad/s2", start={0, 0, 0})
      "Rate of the angular rate, body axes"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
    Modelica.Blocks.Interfaces.RealInput w[1](each unit="1")
      "Standard normals, new ones at each sample"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=-90,
      origin={0,120})));
  equation
    assert(sj >= 0, "sampling_jitter: sj must not be below 0");
    when sample(samplePeriod, samplePeriod) then
      y = samplingJitterOutput(x, sj, slope, w);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"))
    "Sampling jitter, of an accelerometer";

  annotation(Documentation(info="<html>
<p>Sampling jitter; stage: noise.</p>
<p>Equation (LaTeX): <code>y = x + s_j \\dot x w</code></p>
<p>Source: no source; first order in the jitter, one draw a sample for all axes.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>sj</td><td>s</td><td>standard deviation of the instant of sampling</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
<p>It wants new inputs at every sample: the difference of held ones is zero.</p>
</html>"));
end SamplingJitter;
