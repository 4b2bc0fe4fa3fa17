// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package Quantization "Resolution, quantization"
  extends PyImu.Icons.EffectPackage;

  function quantizationOutput "resolution, quantization"
    extends Modelica.Icons.Function;
    input Real x[3], q[3];
    output Real y[3];
  algorithm
    y[1] := if q[1] > 0 then q[1]*floor(x[1]/q[1] + 0.5) else x[1];
    y[2] := if q[2] > 0 then q[2]*floor(x[2]/q[2] + 0.5) else x[2];
    y[3] := if q[3] > 0 then q[3]*floor(x[3]/q[3] + 0.5) else x[3];
  end quantizationOutput;

  block Gyro "Resolution, quantization, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real q[3](each unit="rad/s", each min=0) = fill(0, 3)
      "Step of the output; 0 switches rounding off";
  equation
    assert(min(q) >= 0, "quantization: q must not be below 0");
    when sample(samplePeriod, samplePeriod) then
      y = quantizationOutput(x, q);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"), q(each unit="m/s2"))
    "Resolution, quantization, of an accelerometer";

  block GyroContinuous "Resolution, quantization, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real q[3](each unit="rad/s", each min=0) = fill(0, 3)
      "Step of the output; 0 switches rounding off";
  equation
    assert(min(q) >= 0, "quantization: q must not be below 0");
    y = quantizationOutput(x, q);
  end GyroContinuous;

  block AccelContinuous = GyroContinuous(x(each unit="m/s2"), y(each unit="m/s2"), q(each
    unit="m/s2")) "Resolution, quantization, of an accelerometer, without samples";

  annotation(Documentation(info="<html>
<p>Resolution, quantization; stage: output.</p>
<p>Equation (LaTeX): <code>y = q \\lfloor x / q + 1/2 \\rfloor</code></p>
<p>Source: no source; rounding of the rate to steps q.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>q</td><td>{y}</td><td>step of the output; 0 switches rounding off</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end Quantization;
