// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package RateRandomWalk "Rate (acceleration) random walk"
  extends PyImu.Icons.EffectPackage;

  function rateRandomWalkOutput "rate (acceleration) random walk"
    extends Modelica.Icons.Function;
    input Real x[3], b[3];
    output Real y[3];
  algorithm
    y[1] := x[1] + b[1];
    y[2] := x[2] + b[2];
    y[3] := x[3] + b[3];
  end rateRandomWalkOutput;

  function rateRandomWalkNextB "b of the next sample"
    extends Modelica.Icons.Function;
    input Real K[3], b[3], w[3], h;
    output Real following[3];
  protected
    Real v1;
  algorithm
    v1 := sqrt(h);
    following[1] := b[1] + K[1]*v1*w[1];
    following[2] := b[2] + K[2]*v1*w[2];
    following[3] := b[3] + K[3]*v1*w[3];
  end rateRandomWalkNextB;

  block Gyro "Rate (acceleration) random walk, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real K[3](each min=0) = fill(0, 3)
      "Root of the two-sided density of the bias's derivative [rad/s/sqrt(s)]";
    Modelica.Blocks.Interfaces.RealInput w[3](each unit="1")
      "Standard normals, new ones at each sample"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=-90,
      origin={0,120})));
  protected
    discrete Real b[3](each start=0, each fixed=true);
  equation
    assert(min(K) >= 0, "rate_random_walk: K must not be below 0");
    when sample(samplePeriod, samplePeriod) then
      y = rateRandomWalkOutput(x, pre(b));
      b = rateRandomWalkNextB(K, pre(b), w, samplePeriod);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"))
    "Rate (acceleration) random walk, of an accelerometer";

  annotation(Documentation(info="<html>
<p>Rate (acceleration) random walk; stage: noise.</p>
<p>Equation (LaTeX): <code>y = x + b,\\; \\dot b = K w</code></p>
<p>Source: Hidalgo 2012, section 3.2 and table 3.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>K</td><td>{y}/sqrt(s)</td><td>root of the two-sided density of the bias&#x27;s
derivative</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end RateRandomWalk;
