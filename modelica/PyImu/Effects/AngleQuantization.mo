// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package AngleQuantization "Quantization of angle (velocity) increments"
  extends PyImu.Icons.EffectPackage;

  function angleQuantizationOutput "quantization of angle (velocity) increments"
    extends Modelica.Icons.Function;
    input Real x[3], q[3], left[3], h;
    output Real y[3];
  algorithm
    y[1] := if q[1] > 0 then q[1]*floor((left[1] + h*x[1])/q[1] + 0.5)/h else x[1];
    y[2] := if q[2] > 0 then q[2]*floor((left[2] + h*x[2])/q[2] + 0.5)/h else x[2];
    y[3] := if q[3] > 0 then q[3]*floor((left[3] + h*x[3])/q[3] + 0.5)/h else x[3];
  end angleQuantizationOutput;

  function angleQuantizationNextLeft "left of the next sample"
    extends Modelica.Icons.Function;
    input Real x[3], q[3], left[3], h;
    output Real following[3];
  protected
    Real v1, v2, v3;
  algorithm
    v1 := left[1] + h*x[1];
    v2 := left[2] + h*x[2];
    v3 := left[3] + h*x[3];
    following[1] := if q[1] > 0 then v1 - q[1]*floor(v1/q[1] + 0.5) else 0;
    following[2] := if q[2] > 0 then v2 - q[2]*floor(v2/q[2] + 0.5) else 0;
    following[3] := if q[3] > 0 then v3 - q[3]*floor(v3/q[3] + 0.5) else 0;
  end angleQuantizationNextLeft;

  block Gyro "Quantization of angle (velocity) increments, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real q[3](each unit="rad", each min=0) = fill(0, 3)
      "Step of the integrated output; 0 switches rounding off";
  protected
    discrete Real left[3](each start=0, each fixed=true);
  equation
    assert(min(q) >= 0, "angle_quantization: q must not be below 0");
    when sample(samplePeriod, samplePeriod) then
      y = angleQuantizationOutput(x, q, pre(left), samplePeriod);
      left = angleQuantizationNextLeft(x, q, pre(left), samplePeriod);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"), q(each unit="m/s"))
    "Quantization of angle (velocity) increments, of an accelerometer";

  annotation(Documentation(info="<html>
<p>Quantization of angle (velocity) increments; stage: output.</p>
<p>Equation (LaTeX): <code>y = q\\, (\\lfloor \\theta_k / q + 1/2 \\rfloor - \\lfloor \\theta_{k-1} / q +
1/2 \\rfloor) / h,\\; \\dot\\theta = x</code></p>
<p>Source: Hidalgo 2012, table 3, quantization noise with Q = q / sqrt(12).</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>q</td><td>{Y}</td><td>step of the integrated output; 0 switches rounding off</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end AngleQuantization;
