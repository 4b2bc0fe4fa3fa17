// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package DeadZone "Dead zone, threshold"
  extends PyImu.Icons.EffectPackage;

  function deadZoneOutput "dead zone, threshold"
    extends Modelica.Icons.Function;
    input Real x[3], d[3];
    output Real y[3];
  algorithm
    y[1] := x[1] - max(-d[1], min(d[1], x[1]));
    y[2] := x[2] - max(-d[2], min(d[2], x[2]));
    y[3] := x[3] - max(-d[3], min(d[3], x[3]));
  end deadZoneOutput;

  block Gyro "Dead zone, threshold, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real d[3](each unit="rad/s", each min=0) = fill(0, 3)
      "Largest input without output";
  equation
    assert(min(d) >= 0, "dead_zone: d must not be below 0");
    when sample(samplePeriod, samplePeriod) then
      y = deadZoneOutput(x, d);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"), d(each unit="m/s2"))
    "Dead zone, threshold, of an accelerometer";

  block GyroContinuous "Dead zone, threshold, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real d[3](each unit="rad/s", each min=0) = fill(0, 3)
      "Largest input without output";
  equation
    assert(min(d) >= 0, "dead_zone: d must not be below 0");
    y = deadZoneOutput(x, d);
  end GyroContinuous;

  block AccelContinuous = GyroContinuous(x(each unit="m/s2"), y(each unit="m/s2"), d(each
    unit="m/s2")) "Dead zone, threshold, of an accelerometer, without samples";

  annotation(Documentation(info="<html>
<p>Dead zone, threshold; stage: output.</p>
<p>Equation (LaTeX): <code>y = x - \\max(-d, \\min(d, x))</code></p>
<p>Source: no source; threshold as mechanical stops and digital filters leave it.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>d</td><td>{y}</td><td>largest input without output</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end DeadZone;
