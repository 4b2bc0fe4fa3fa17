// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package FirstOrderLag "Bandwidth, first-order lag"
  extends PyImu.Icons.EffectPackage;

  function firstOrderLagOutput "bandwidth, first-order lag"
    extends Modelica.Icons.Function;
    input Real x[3], tau, y1[3], y2[3], y3[3];
    input Boolean started;
    input Real h;
    output Real y[3];
  protected
    Real v1, v2;
  algorithm
    v1 := tau/h;
    v2 := 1 + 1.8333333333333333*tau/h;
    y[1] := (x[1] + v1*(18*(if started then y1[1] else x[1]) - 9*(if started then y2[1] else x[1])
      + 2*(if started then y3[1] else x[1]))/6)/v2;
    y[2] := (x[2] + v1*(18*(if started then y1[2] else x[2]) - 9*(if started then y2[2] else x[2])
      + 2*(if started then y3[2] else x[2]))/6)/v2;
    y[3] := (x[3] + v1*(18*(if started then y1[3] else x[3]) - 9*(if started then y2[3] else x[3])
      + 2*(if started then y3[3] else x[3]))/6)/v2;
  end firstOrderLagOutput;

  block Gyro "Bandwidth, first-order lag, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real tau(unit="s", min=0) = 0
      "Time constant of the single pole; 0 switches the lag off";
  protected
    discrete Real x1[3](each start=0, each fixed=true);
    discrete Real y1[3](each start=0, each fixed=true);
    discrete Real y2[3](each start=0, each fixed=true);
    discrete Real y3[3](each start=0, each fixed=true);
    Boolean started(start=false, fixed=true);
  equation
    assert(tau >= 0, "first_order_lag: tau must not be below 0");
    when sample(samplePeriod, samplePeriod) then
      y = firstOrderLagOutput(x, tau, pre(y1), pre(y2), pre(y3), pre(started), samplePeriod);
      x1 = x;
      y1 = y;
      y2 = if pre(started) then pre(y1) else x;
      y3 = if pre(started) then pre(y2) else x;
      started = true;
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"))
    "Bandwidth, first-order lag, of an accelerometer";

  annotation(Documentation(info="<html>
<p>Bandwidth, first-order lag; stage: dynamics.</p>
<p>Equation (LaTeX): <code>y = \\frac{1}{1 + \\tau s} x,\\quad s \\to \\frac{11 - 18 z^{-1} + 9 z^{-2} -
2 z^{-3}}{6 h}</code></p>
<p>Source: no source for the coefficient; single-pole low-pass, an exponential average in continuous
time, its derivative by the backward difference of third order.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>tau</td><td>s</td><td>time constant of the single pole; 0 switches the lag off</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end FirstOrderLag;
