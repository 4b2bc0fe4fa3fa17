// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package Anisoinertia "Anisoinertia, product of the cross-axis rates"
  extends PyImu.Icons.EffectPackage;

  function anisoinertiaOutput "anisoinertia, product of the cross-axis rates"
    extends Modelica.Icons.Function;
    input Real x[3], c[3];
    output Real y[3];
  algorithm
    y[1] := x[1] + c[1]*(x[2]*x[3]);
    y[2] := x[2] + c[2]*(x[3]*x[1]);
    y[3] := x[3] + c[3]*(x[1]*x[2]);
  end anisoinertiaOutput;

  block Gyro "Anisoinertia, product of the cross-axis rates, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real c[3](each unit="s/rad") = fill(0, 3)
      "Drift per product of the rates about the two other axes";
  equation
    when sample(samplePeriod, samplePeriod) then
      y = anisoinertiaOutput(x, c);
    end when;
  end Gyro;

  block GyroContinuous "Anisoinertia, product of the cross-axis rates, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real c[3](each unit="s/rad") = fill(0, 3)
      "Drift per product of the rates about the two other axes";
  equation
    y = anisoinertiaOutput(x, c);
  end GyroContinuous;

  annotation(Documentation(info="<html>
<p>Anisoinertia, product of the cross-axis rates; stage: gain.</p>
<p>Equation (LaTeX): <code>y_i = x_i + c_i x_j x_k</code></p>
<p>Source: IEEE Std 528-2019, anisoinertia (B), defined there for mechanical gyros.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>c</td><td>1/({y})</td><td>drift per product of the rates about the two other axes</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end Anisoinertia;
