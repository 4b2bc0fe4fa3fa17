// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package ScaleFactor "Scale factor error"
  extends PyImu.Icons.EffectPackage;

  function scaleFactorOutput "scale factor error"
    extends Modelica.Icons.Function;
    input Real x[3], s[3];
    output Real y[3];
  algorithm
    y[1] := x[1] + s[1]*x[1];
    y[2] := x[2] + s[2]*x[2];
    y[3] := x[3] + s[3]*x[3];
  end scaleFactorOutput;

  block Gyro "Scale factor error, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real s[3](each unit="1") = fill(0, 3) "Relative scale factor error";
  equation
    when sample(samplePeriod, samplePeriod) then
      y = scaleFactorOutput(x, s);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"))
    "Scale factor error, of an accelerometer";

  block GyroContinuous "Scale factor error, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real s[3](each unit="1") = fill(0, 3) "Relative scale factor error";
  equation
    y = scaleFactorOutput(x, s);
  end GyroContinuous;

  block AccelContinuous = GyroContinuous(x(each unit="m/s2"), y(each unit="m/s2"))
    "Scale factor error, of an accelerometer, without samples";

  annotation(Documentation(info="<html>
<p>Scale factor error; stage: gain.</p>
<p>Equation (LaTeX): <code>y = (1 + s) x</code></p>
<p>Source: Hidalgo 2012, section 3.2, matrix M; Groves 2013, eqs. 4.16 and 4.17.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>s</td><td>1</td><td>relative scale factor error</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end ScaleFactor;
