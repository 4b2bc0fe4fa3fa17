// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package WarmUp "Warm-up transient"
  extends PyImu.Icons.EffectPackage;

  function warmUpOutput "warm-up transient"
    extends Modelica.Icons.Function;
    input Real x[3], A[3], tau, t;
    output Real y[3];
  protected
    Real v1;
  algorithm
    v1 := exp(-t/tau);
    y[1] := x[1] + A[1]*v1;
    y[2] := x[2] + A[2]*v1;
    y[3] := x[3] + A[3]*v1;
  end warmUpOutput;

  block Gyro "Warm-up transient, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real A[3](each unit="rad/s") = fill(0, 3) "Bias at power-on that dies away";
    parameter Real tau(unit="s", min=1e-06) = 300 "Time constant";
    Modelica.Blocks.Interfaces.RealInput t(unit="s", start=0) "Time since power-on"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    assert(tau >= 1e-06, "warm_up: tau must not be below 1e-06");
    when sample(samplePeriod, samplePeriod) then
      y = warmUpOutput(x, A, tau, t);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"), A(each unit="m/s2"))
    "Warm-up transient, of an accelerometer";

  block GyroContinuous "Warm-up transient, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real A[3](each unit="rad/s") = fill(0, 3) "Bias at power-on that dies away";
    parameter Real tau(unit="s", min=1e-06) = 300 "Time constant";
    Modelica.Blocks.Interfaces.RealInput t(unit="s", start=0) "Time since power-on"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    assert(tau >= 1e-06, "warm_up: tau must not be below 1e-06");
    y = warmUpOutput(x, A, tau, t);
  end GyroContinuous;

  block AccelContinuous = GyroContinuous(x(each unit="m/s2"), y(each unit="m/s2"), A(each
    unit="m/s2")) "Warm-up transient, of an accelerometer, without samples";

  annotation(Documentation(info="<html>
<p>Warm-up transient; stage: bias.</p>
<p>Equation (LaTeX): <code>y = x + A e^{-t / \\tau}</code></p>
<p>Source: no source.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>A</td><td>{y}</td><td>bias at power-on that dies away</td></tr>
<tr><td>tau</td><td>s</td><td>time constant</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end WarmUp;
