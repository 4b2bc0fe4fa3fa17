// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package Saturation "Input range, saturation"
  extends PyImu.Icons.EffectPackage;

  function saturationOutput "input range, saturation"
    extends Modelica.Icons.Function;
    input Real x[3], limit[3];
    output Real y[3];
  algorithm
    y[1] := if limit[1] > 0 and limit[1] < abs(x[1]) then sign(x[1])*limit[1] else x[1];
    y[2] := if limit[2] > 0 and limit[2] < abs(x[2]) then sign(x[2])*limit[2] else x[2];
    y[3] := if limit[3] > 0 and limit[3] < abs(x[3]) then sign(x[3])*limit[3] else x[3];
  end saturationOutput;

  block Gyro "Input range, saturation, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real limit[3](each unit="rad/s", each min=0) = fill(0, 3)
      "Largest output; 0 switches the limit off";
  equation
    assert(min(limit) >= 0, "saturation: limit must not be below 0");
    when sample(samplePeriod, samplePeriod) then
      y = saturationOutput(x, limit);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"), limit(each unit="m/s2"))
    "Input range, saturation, of an accelerometer";

  block GyroContinuous "Input range, saturation, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real limit[3](each unit="rad/s", each min=0) = fill(0, 3)
      "Largest output; 0 switches the limit off";
  equation
    assert(min(limit) >= 0, "saturation: limit must not be below 0");
    y = saturationOutput(x, limit);
  end GyroContinuous;

  block AccelContinuous = GyroContinuous(x(each unit="m/s2"), y(each unit="m/s2"), limit(each
    unit="m/s2")) "Input range, saturation, of an accelerometer, without samples";

  annotation(Documentation(info="<html>
<p>Input range, saturation; stage: output.</p>
<p>Equation (LaTeX): <code>y = \\max(-L, \\min(L, x))</code></p>
<p>Source: no source; clipping at the ends of the input range.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>limit</td><td>{y}</td><td>largest output; 0 switches the limit off</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end Saturation;
