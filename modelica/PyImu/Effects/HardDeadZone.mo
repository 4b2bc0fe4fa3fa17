// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package HardDeadZone "Dead band, hard"
  extends PyImu.Icons.EffectPackage;

  function hardDeadZoneOutput "dead band, hard"
    extends Modelica.Icons.Function;
    input Real x[3], d[3];
    output Real y[3];
  algorithm
    y[1] := if not (d[1] > 0 and abs(x[1]) <= d[1]) then x[1] else 0;
    y[2] := if not (d[2] > 0 and abs(x[2]) <= d[2]) then x[2] else 0;
    y[3] := if not (d[3] > 0 and abs(x[3]) <= d[3]) then x[3] else 0;
  end hardDeadZoneOutput;

  block Gyro "Dead band, hard, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real d[3](each unit="rad/s", each min=0) = fill(0, 3)
      "Largest input whose output is zero; larger ones pass as they are";
  equation
    assert(min(d) >= 0, "hard_dead_zone: d must not be below 0");
    when sample(samplePeriod, samplePeriod) then
      y = hardDeadZoneOutput(x, d);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"), d(each unit="m/s2"))
    "Dead band, hard, of an accelerometer";

  block GyroContinuous "Dead band, hard, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real d[3](each unit="rad/s", each min=0) = fill(0, 3)
      "Largest input whose output is zero; larger ones pass as they are";
  equation
    assert(min(d) >= 0, "hard_dead_zone: d must not be below 0");
    y = hardDeadZoneOutput(x, d);
  end GyroContinuous;

  block AccelContinuous = GyroContinuous(x(each unit="m/s2"), y(each unit="m/s2"), d(each
    unit="m/s2")) "Dead band, hard, of an accelerometer, without samples";

  annotation(Documentation(info="<html>
<p>Dead band, hard; stage: output.</p>
<p>Equation (LaTeX): <code>y = x\\ (|x| &gt; d),\\quad 0\\ (|x| \\le d)</code></p>
<p>Source: no source for the form; dead band and threshold of IEEE Std 528, whose text was not
checked, as firmware that suppresses small outputs leaves it.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>d</td><td>{y}</td><td>largest input whose output is zero; larger ones pass as they
are</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end HardDeadZone;
