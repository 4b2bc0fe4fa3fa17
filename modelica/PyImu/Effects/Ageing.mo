// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package Ageing "Ageing of bias and scale factor"
  extends PyImu.Icons.EffectPackage;

  function ageingOutput "ageing of bias and scale factor"
    extends Modelica.Icons.Function;
    input Real x[3], kb[3], ks[3], age, t;
    output Real y[3];
  protected
    Real v1;
  algorithm
    v1 := age + t;
    y[1] := x[1] + v1*(kb[1] + ks[1]*x[1]);
    y[2] := x[2] + v1*(kb[2] + ks[2]*x[2]);
    y[3] := x[3] + v1*(kb[3] + ks[3]*x[3]);
  end ageingOutput;

  block Gyro "Ageing of bias and scale factor, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real kb[3](each unit="rad/s2") = fill(0, 3) "Bias per time since calibration";
    parameter Real ks[3](each unit="1/s") = fill(0, 3)
      "Relative scale factor error per time since calibration";
    parameter Real age(unit="s") = 0 "Time from calibration to power-on";
    Modelica.Blocks.Interfaces.RealInput t(unit="s", start=0) "Time since power-on"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    when sample(samplePeriod, samplePeriod) then
      y = ageingOutput(x, kb, ks, age, t);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"), kb(each unit="m/s3"))
    "Ageing of bias and scale factor, of an accelerometer";

  block GyroContinuous "Ageing of bias and scale factor, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real kb[3](each unit="rad/s2") = fill(0, 3) "Bias per time since calibration";
    parameter Real ks[3](each unit="1/s") = fill(0, 3)
      "Relative scale factor error per time since calibration";
    parameter Real age(unit="s") = 0 "Time from calibration to power-on";
    Modelica.Blocks.Interfaces.RealInput t(unit="s", start=0) "Time since power-on"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    y = ageingOutput(x, kb, ks, age, t);
  end GyroContinuous;

  block AccelContinuous = GyroContinuous(x(each unit="m/s2"), y(each unit="m/s2"), kb(each
    unit="m/s3")) "Ageing of bias and scale factor, of an accelerometer, without samples";

  annotation(Documentation(info="<html>
<p>Ageing of bias and scale factor; stage: bias.</p>
<p>Equation (LaTeX): <code>y = x + (a + t)(k_b + k_s x)</code></p>
<p>Source: no source for the form; IEEE Std 528-2019, long-term stability.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>kb</td><td>{y}/s</td><td>bias per time since calibration</td></tr>
<tr><td>ks</td><td>1/s</td><td>relative scale factor error per time since calibration</td></tr>
<tr><td>age</td><td>s</td><td>time from calibration to power-on</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end Ageing;
