// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package BiasStep "Bias steps, shock shifts"
  extends PyImu.Icons.EffectPackage;

  function biasStepOutput "bias steps, shock shifts"
    extends Modelica.Icons.Function;
    input Real x[3], A[3,4], t0[4], t;
    output Real y[3];
  algorithm
    y[1] := x[1] + (A[1,1]*(if t0[1] <= t then 1 else 0) + A[1,2]*(if t0[2] <= t then 1 else 0) +
      A[1,3]*(if t0[3] <= t then 1 else 0) + A[1,4]*(if t0[4] <= t then 1 else 0));
    y[2] := x[2] + (A[2,1]*(if t0[1] <= t then 1 else 0) + A[2,2]*(if t0[2] <= t then 1 else 0) +
      A[2,3]*(if t0[3] <= t then 1 else 0) + A[2,4]*(if t0[4] <= t then 1 else 0));
    y[3] := x[3] + (A[3,1]*(if t0[1] <= t then 1 else 0) + A[3,2]*(if t0[2] <= t then 1 else 0) +
      A[3,3]*(if t0[3] <= t then 1 else 0) + A[3,4]*(if t0[4] <= t then 1 else 0));
  end biasStepOutput;

  block Gyro "Bias steps, shock shifts, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real A[3,4](each unit="rad/s") = fill(0, 3, 4) "Change of axis i's bias at event k";
    parameter Real t0[4](each unit="s") = fill(0, 4) "Time of event k since power-on";
    Modelica.Blocks.Interfaces.RealInput t(unit="s", start=0) "Time since power-on"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    when sample(samplePeriod, samplePeriod) then
      y = biasStepOutput(x, A, t0, t);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"), A(each unit="m/s2"))
    "Bias steps, shock shifts, of an accelerometer";

  block GyroContinuous "Bias steps, shock shifts, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real A[3,4](each unit="rad/s") = fill(0, 3, 4) "Change of axis i's bias at event k";
    parameter Real t0[4](each unit="s") = fill(0, 4) "Time of event k since power-on";
    Modelica.Blocks.Interfaces.RealInput t(unit="s", start=0) "Time since power-on"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    y = biasStepOutput(x, A, t0, t);
  end GyroContinuous;

  block AccelContinuous = GyroContinuous(x(each unit="m/s2"), y(each unit="m/s2"), A(each
    unit="m/s2")) "Bias steps, shock shifts, of an accelerometer, without samples";

  annotation(Documentation(info="<html>
<p>Bias steps, shock shifts; stage: bias.</p>
<p>Equation (LaTeX): <code>y = x + \\sum_k A_k\\, 1(t \\ge t_k)</code></p>
<p>Source: no source; steps as shock or remounting leaves them.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>A</td><td>{y}</td><td>change of axis i&#x27;s bias at event k</td></tr>
<tr><td>t0</td><td>s</td><td>time of event k since power-on</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end BiasStep;
