// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package RateDependentNoise "Rate-dependent noise, scale factor noise"
  extends PyImu.Icons.EffectPackage;

  function rateDependentNoiseOutput "rate-dependent noise, scale factor noise"
    extends Modelica.Icons.Function;
    input Real x[3], k[3], w[3], h;
    output Real y[3];
  protected
    Real v1;
  algorithm
    v1 := sqrt(h);
    y[1] := x[1] + k[1]*x[1]*w[1]/v1;
    y[2] := x[2] + k[2]*x[2]*w[2]/v1;
    y[3] := x[3] + k[3]*x[3]*w[3]/v1;
  end rateDependentNoiseOutput;

  block Gyro "Rate-dependent noise, scale factor noise, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real k[3](each min=0) = fill(0, 3)
      "Root of the two-sided density of the relative error [sqrt(s)]";
    Modelica.Blocks.Interfaces.RealInput w[3](each unit="1")
      "Standard normals, new ones at each sample"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=-90,
      origin={0,120})));
  equation
    assert(min(k) >= 0, "rate_dependent_noise: k must not be below 0");
    when sample(samplePeriod, samplePeriod) then
      y = rateDependentNoiseOutput(x, k, w, samplePeriod);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"))
    "Rate-dependent noise, scale factor noise, of an accelerometer";

  annotation(Documentation(info="<html>
<p>Rate-dependent noise, scale factor noise; stage: noise.</p>
<p>Equation (LaTeX): <code>y = x + k x w / \\sqrt{h}</code></p>
<p>Source: no source; white noise whose root density grows with the input.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>k</td><td>sqrt(s)</td><td>root of the two-sided density of the relative error</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end RateDependentNoise;
