// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package GSensitivity "Acceleration-sensitive drift (g-sensitivity)"
  extends PyImu.Icons.EffectPackage;

  function gSensitivityOutput "acceleration-sensitive drift (g-sensitivity)"
    extends Modelica.Icons.Function;
    input Real x[3], G[3,3], f[3];
    output Real y[3];
  algorithm
    y[1] := x[1] + (G[1,1]*f[1] + G[1,2]*f[2] + G[1,3]*f[3]);
    y[2] := x[2] + (G[2,1]*f[1] + G[2,2]*f[2] + G[2,3]*f[3]);
    y[3] := x[3] + (G[3,1]*f[1] + G[3,2]*f[2] + G[3,3]*f[3]);
  end gSensitivityOutput;

  block Gyro "Acceleration-sensitive drift (g-sensitivity), of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real G[3,3](each unit="rad.s/m") = fill(0, 3, 3)
      "Drift of axis i per specific force along axis j";
    Modelica.Blocks.Interfaces.RealInput f[3](each unit="m/s2", start={0, 0, 9.80665})
      "Specific force, body axes" annotation(Placement(transformation(extent={{-20,-20},{20,20}},
      rotation=90, origin={0,-120})));
  equation
    when sample(samplePeriod, samplePeriod) then
      y = gSensitivityOutput(x, G, f);
    end when;
  end Gyro;

  block GyroContinuous "Acceleration-sensitive drift (g-sensitivity), of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real G[3,3](each unit="rad.s/m") = fill(0, 3, 3)
      "Drift of axis i per specific force along axis j";
    Modelica.Blocks.Interfaces.RealInput f[3](each unit="m/s2", start={0, 0, 9.80665})
      "Specific force, body axes" annotation(Placement(transformation(extent={{-20,-20},{20,20}},
      rotation=90, origin={0,-120})));
  equation
    y = gSensitivityOutput(x, G, f);
  end GyroContinuous;

  annotation(Documentation(info="<html>
<p>Acceleration-sensitive drift (g-sensitivity); stage: bias.</p>
<p>Equation (LaTeX): <code>y = x + G f</code></p>
<p>Source: IEEE Std 528-2019, acceleration-sensitive drift rate; Groves 2013, eq. 4.17, G_g f.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>G</td><td>{y}/(m/s^2)</td><td>drift of axis i per specific force along axis j</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end GSensitivity;
