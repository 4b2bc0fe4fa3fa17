// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package VibrationLine "Sinusoidal noise, vibration line"
  extends PyImu.Icons.EffectPackage;

  function vibrationLineOutput "sinusoidal noise, vibration line"
    extends Modelica.Icons.Function;
    input Real x[3], A[3], f0, phase[3], t;
    output Real y[3];
  protected
    Real v1;
  algorithm
    v1 := 6.283185307179586*f0*t;
    y[1] := x[1] + A[1]*sin(v1 + phase[1]);
    y[2] := x[2] + A[2]*sin(v1 + phase[2]);
    y[3] := x[3] + A[3]*sin(v1 + phase[3]);
  end vibrationLineOutput;

  block Gyro "Sinusoidal noise, vibration line, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real A[3](each unit="rad/s") = fill(0, 3) "Amplitude";
    parameter Real f0(unit="Hz", min=0) = 20 "Frequency";
    parameter Real phase[3](each unit="rad") = fill(0, 3) "Phase at power-on";
    Modelica.Blocks.Interfaces.RealInput t(unit="s", start=0) "Time since power-on"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    assert(f0 >= 0, "vibration_line: f0 must not be below 0");
    when sample(samplePeriod, samplePeriod) then
      y = vibrationLineOutput(x, A, f0, phase, t);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"), A(each unit="m/s2"))
    "Sinusoidal noise, vibration line, of an accelerometer";

  block GyroContinuous "Sinusoidal noise, vibration line, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real A[3](each unit="rad/s") = fill(0, 3) "Amplitude";
    parameter Real f0(unit="Hz", min=0) = 20 "Frequency";
    parameter Real phase[3](each unit="rad") = fill(0, 3) "Phase at power-on";
    Modelica.Blocks.Interfaces.RealInput t(unit="s", start=0) "Time since power-on"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    assert(f0 >= 0, "vibration_line: f0 must not be below 0");
    y = vibrationLineOutput(x, A, f0, phase, t);
  end GyroContinuous;

  block AccelContinuous = GyroContinuous(x(each unit="m/s2"), y(each unit="m/s2"), A(each
    unit="m/s2")) "Sinusoidal noise, vibration line, of an accelerometer, without samples";

  annotation(Documentation(info="<html>
<p>Sinusoidal noise, vibration line; stage: bias.</p>
<p>Equation (LaTeX): <code>y = x + A \\sin(2 \\pi f_0 t + \\varphi)</code></p>
<p>Source: sinusoidal noise of IEEE Std 952; its text was not checked.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>A</td><td>{y}</td><td>amplitude</td></tr>
<tr><td>f0</td><td>Hz</td><td>frequency</td></tr>
<tr><td>phase</td><td>rad</td><td>phase at power-on</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end VibrationLine;
