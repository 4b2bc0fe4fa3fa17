// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package SecondGaussMarkov "Second exponentially correlated (Gauss-Markov) noise"
  extends PyImu.Icons.EffectPackage;

  function secondGaussMarkovOutput "second exponentially correlated (Gauss-Markov) noise"
    extends Modelica.Icons.Function;
    input Real x[3], b_next[3];
    output Real y[3];
  algorithm
    y[1] := x[1] + b_next[1];
    y[2] := x[2] + b_next[2];
    y[3] := x[3] + b_next[3];
  end secondGaussMarkovOutput;

  function secondGaussMarkovNextB "b of the next sample"
    extends Modelica.Icons.Function;
    input Real q[3], tau[3], b[3], started, w[3], h;
    output Real following[3];
  protected
    Real v1, v2, v3, v4, v5, v6;
  algorithm
    v1 := h/tau[1];
    v2 := q[1]*q[1]*tau[1]/2;
    v3 := h/tau[2];
    v4 := q[2]*q[2]*tau[2]/2;
    v5 := h/tau[3];
    v6 := q[3]*q[3]*tau[3]/2;
    following[1] := if started <> 0 then exp(-v1)*b[1] + sqrt(-v2*PyImu.Math.expm1(-2*v1))*w[1]
      else sqrt(v2)*w[1];
    following[2] := if started <> 0 then exp(-v3)*b[2] + sqrt(-v4*PyImu.Math.expm1(-2*v3))*w[2]
      else sqrt(v4)*w[2];
    following[3] := if started <> 0 then exp(-v5)*b[3] + sqrt(-v6*PyImu.Math.expm1(-2*v5))*w[3]
      else sqrt(v6)*w[3];
  end secondGaussMarkovNextB;

  block Gyro "Second exponentially correlated (Gauss-Markov) noise, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real q[3](each min=0) = fill(0, 3)
      "Root of the two-sided density of the noise that drives it [rad/s/sqrt(s)]";
    parameter Real tau[3](each unit="s", each min=1e-06) = fill(1, 3)
      "Correlation time, tau_c of the equation";
    Modelica.Blocks.Interfaces.RealInput w[3](each unit="1")
      "Standard normals, new ones at each sample"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=-90,
      origin={0,120})));
  protected
    discrete Real b[3](each start=0, each fixed=true);
    discrete Real started(start=0, fixed=true);
  equation
    assert(min(q) >= 0, "second_gauss_markov: q must not be below 0");
    assert(min(tau) >= 1e-06, "second_gauss_markov: tau must not be below 1e-06");
    when sample(samplePeriod, samplePeriod) then
      b = secondGaussMarkovNextB(q, tau, pre(b), pre(started), w, samplePeriod);
      y = secondGaussMarkovOutput(x, b);
      started = 1;
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"))
    "Second exponentially correlated (Gauss-Markov) noise, of an accelerometer";

  annotation(Documentation(info="<html>
<p>Second exponentially correlated (Gauss-Markov) noise; stage: noise.</p>
<p>Equation (LaTeX): <code>y = x + b,\\; \\dot b = -b / \\tau_c + q w</code></p>
<p>Source: as gauss_markov; two processes of different correlation times beside the random walk are
usual in models of accelerometers, no source for a second one.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>q</td><td>{y}/sqrt(s)</td><td>root of the two-sided density of the noise that drives
it</td></tr>
<tr><td>tau</td><td>s</td><td>correlation time, tau_c of the equation</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end SecondGaussMarkov;
