// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package G2Sensitivity "Acceleration-squared-sensitive drift, anisoelastic"
  extends PyImu.Icons.EffectPackage;

  function g2SensitivityOutput "acceleration-squared-sensitive drift, anisoelastic"
    extends Modelica.Icons.Function;
    input Real x[3], Q[3,6], f[3];
    output Real y[3];
  protected
    Real v1, v2, v3, v4, v5, v6;
  algorithm
    v1 := f[1]*f[1];
    v2 := f[2]*f[2];
    v3 := f[3]*f[3];
    v4 := f[2]*f[3];
    v5 := f[3]*f[1];
    v6 := f[1]*f[2];
    y[1] := x[1] + (Q[1,1]*v1 + Q[1,2]*v2 + Q[1,3]*v3 + Q[1,4]*v4 + Q[1,5]*v5 + Q[1,6]*v6);
    y[2] := x[2] + (Q[2,1]*v1 + Q[2,2]*v2 + Q[2,3]*v3 + Q[2,4]*v4 + Q[2,5]*v5 + Q[2,6]*v6);
    y[3] := x[3] + (Q[3,1]*v1 + Q[3,2]*v2 + Q[3,3]*v3 + Q[3,4]*v4 + Q[3,5]*v5 + Q[3,6]*v6);
  end g2SensitivityOutput;

  block Gyro "Acceleration-squared-sensitive drift, anisoelastic, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real Q[3,6](each unit="rad.s3/m2") = fill(0, 3, 6)
      "Drift of axis i per product of forces: xx, yy, zz, yz, zx, xy";
    Modelica.Blocks.Interfaces.RealInput f[3](each unit="m/s2", start={0, 0, 9.80665})
      "Specific force, body axes" annotation(Placement(transformation(extent={{-20,-20},{20,20}},
      rotation=90, origin={0,-120})));
  equation
    when sample(samplePeriod, samplePeriod) then
      y = g2SensitivityOutput(x, Q, f);
    end when;
  end Gyro;

  block GyroContinuous "Acceleration-squared-sensitive drift, anisoelastic, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real Q[3,6](each unit="rad.s3/m2") = fill(0, 3, 6)
      "Drift of axis i per product of forces: xx, yy, zz, yz, zx, xy";
    Modelica.Blocks.Interfaces.RealInput f[3](each unit="m/s2", start={0, 0, 9.80665})
      "Specific force, body axes" annotation(Placement(transformation(extent={{-20,-20},{20,20}},
      rotation=90, origin={0,-120})));
  equation
    y = g2SensitivityOutput(x, Q, f);
  end GyroContinuous;

  annotation(Documentation(info="<html>
<p>Acceleration-squared-sensitive drift, anisoelastic; stage: bias.</p>
<p>Equation (LaTeX): <code>y = x + Q\\, [f_x^2, f_y^2, f_z^2, f_y f_z, f_z f_x, f_x f_y]^T</code></p>
<p>Source: IEEE Std 528-2019, acceleration-squared-sensitive drift rate: squares and products of
components.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>Q</td><td>{y}/(m/s^2)^2</td><td>drift of axis i per product of forces: xx, yy, zz, yz, zx,
xy</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end G2Sensitivity;
