// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package ScaleFactorGSensitivity "Scale factor acceleration sensitivity"
  extends PyImu.Icons.EffectPackage;

  function scaleFactorGSensitivityOutput "scale factor acceleration sensitivity"
    extends Modelica.Icons.Function;
    input Real x[3], P[3,3], f[3];
    output Real y[3];
  algorithm
    y[1] := x[1] + (P[1,1]*f[1] + P[1,2]*f[2] + P[1,3]*f[3])*x[1];
    y[2] := x[2] + (P[2,1]*f[1] + P[2,2]*f[2] + P[2,3]*f[3])*x[2];
    y[3] := x[3] + (P[3,1]*f[1] + P[3,2]*f[2] + P[3,3]*f[3])*x[3];
  end scaleFactorGSensitivityOutput;

  block Gyro "Scale factor acceleration sensitivity, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real P[3,3](each unit="s2/m") = fill(0, 3, 3)
      "Relative scale factor error of axis i per force along axis j";
    Modelica.Blocks.Interfaces.RealInput f[3](each unit="m/s2", start={0, 0, 9.80665})
      "Specific force, body axes" annotation(Placement(transformation(extent={{-20,-20},{20,20}},
      rotation=90, origin={0,-120})));
  equation
    when sample(samplePeriod, samplePeriod) then
      y = scaleFactorGSensitivityOutput(x, P, f);
    end when;
  end Gyro;

  block GyroContinuous "Scale factor acceleration sensitivity, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real P[3,3](each unit="s2/m") = fill(0, 3, 3)
      "Relative scale factor error of axis i per force along axis j";
    Modelica.Blocks.Interfaces.RealInput f[3](each unit="m/s2", start={0, 0, 9.80665})
      "Specific force, body axes" annotation(Placement(transformation(extent={{-20,-20},{20,20}},
      rotation=90, origin={0,-120})));
  equation
    y = scaleFactorGSensitivityOutput(x, P, f);
  end GyroContinuous;

  annotation(Documentation(info="<html>
<p>Scale factor acceleration sensitivity; stage: gain.</p>
<p>Equation (LaTeX): <code>y = (1 + P f)\\, x</code></p>
<p>Source: no source for the equation; data sheets state its coefficient in ppm/g (STIM300).</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>P</td><td>1/(m/s^2)</td><td>relative scale factor error of axis i per force along axis
j</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end ScaleFactorGSensitivity;
