// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package Lag "Bandwidth, second-order lag"
  extends PyImu.Icons.EffectPackage;

  function lagOutput "bandwidth, second-order lag"
    extends Modelica.Icons.Function;
    input Real x[3], wn, zeta, x1[3], x2[3], y1[3], y2[3];
    input Boolean started;
    input Real h;
    output Real y[3];
  protected
    Real v1, v2, v3, v4, v5, v6, v7, v8, v9, v10, v11, v12, v13, v14;
  algorithm
    v1 := wn*h;
    v2 := zeta*v1;
    v3 := if wn > 0 then sqrt(abs(zeta*zeta - 1))*v1 else 0;
    v4 := if zeta < 1 then 2*exp(-v2)*cos(v3) else exp(v3 - v2) + exp(-(v3 + v2));
    v5 := -2*zeta;
    v6 := exp(v5*v1);
    v7 := 1 - v4 + v6;
    v8 := 2*v6 - v4;
    v9 := if wn > 0 then v5/v1 else 0;
    v10 := v8 - v7*v9;
    v11 := if wn > 0 then 4*v6 - v4 - 2*v8*v9 + 2*v7*((4*zeta*zeta - 1)/(v1*v1)) - v10 else 0;
    v12 := v10 - v11;
    v13 := v11/2;
    v14 := v7 - v12 - v13;
    y[1] := if wn > 0 then v14*x[1] + v12*(if started then x1[1] else x[1]) + v13*(if started then
      x2[1] else x[1]) + v4*(if started then y1[1] else x[1]) - v6*(if started then y2[1] else
      x[1]) else x[1];
    y[2] := if wn > 0 then v14*x[2] + v12*(if started then x1[2] else x[2]) + v13*(if started then
      x2[2] else x[2]) + v4*(if started then y1[2] else x[2]) - v6*(if started then y2[2] else
      x[2]) else x[2];
    y[3] := if wn > 0 then v14*x[3] + v12*(if started then x1[3] else x[3]) + v13*(if started then
      x2[3] else x[3]) + v4*(if started then y1[3] else x[3]) - v6*(if started then y2[3] else
      x[3]) else x[3];
  end lagOutput;

  block Gyro "Bandwidth, second-order lag, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real wn(unit="rad/s", min=0) = 0 "Natural frequency; 0 switches the lag off";
    parameter Real zeta(unit="1", min=0.1, max=2) = 0.7071067811865476 "Damping ratio";
  protected
    discrete Real x1[3](each start=0, each fixed=true);
    discrete Real x2[3](each start=0, each fixed=true);
    discrete Real y1[3](each start=0, each fixed=true);
    discrete Real y2[3](each start=0, each fixed=true);
    Boolean started(start=false, fixed=true);
  equation
    assert(wn >= 0, "lag: wn must not be below 0");
    assert(zeta >= 0.1, "lag: zeta must not be below 0.1");
    assert(zeta <= 2, "lag: zeta must not be above 2");
    when sample(samplePeriod, samplePeriod) then
      y = lagOutput(x, wn, zeta, pre(x1), pre(x2), pre(y1), pre(y2), pre(started), samplePeriod);
      x1 = x;
      x2 = if pre(started) then pre(x1) else x;
      y1 = y;
      y2 = if pre(started) then pre(y1) else x;
      started = true;
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"))
    "Bandwidth, second-order lag, of an accelerometer";

  annotation(Documentation(info="<html>
<p>Bandwidth, second-order lag; stage: dynamics.</p>
<p>Equation (LaTeX): <code>y = \\frac{\\omega_n^2}{s^2 + 2 \\zeta \\omega_n s + \\omega_n^2} x</code></p>
<p>Source: no source for the coefficients; second-order low-pass of a read-out: its poles exactly,
its gain to second order in s.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>wn</td><td>rad/s</td><td>natural frequency; 0 switches the lag off</td></tr>
<tr><td>zeta</td><td>1</td><td>damping ratio</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end Lag;
