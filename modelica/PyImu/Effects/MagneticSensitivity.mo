// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package MagneticSensitivity "Magnetic sensitivity"
  extends PyImu.Icons.EffectPackage;

  function magneticSensitivityOutput "magnetic sensitivity"
    extends Modelica.Icons.Function;
    input Real x[3], C[3,3], B[3];
    output Real y[3];
  algorithm
    y[1] := x[1] + (C[1,1]*B[1] + C[1,2]*B[2] + C[1,3]*B[3]);
    y[2] := x[2] + (C[2,1]*B[1] + C[2,2]*B[2] + C[2,3]*B[3]);
    y[3] := x[3] + (C[3,1]*B[1] + C[3,2]*B[2] + C[3,3]*B[3]);
  end magneticSensitivityOutput;

  block Gyro "Magnetic sensitivity, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real C[3,3](each unit="rad/(s.T)") = fill(0, 3, 3)
      "Bias of axis i per flux density along axis j";
    Modelica.Blocks.Interfaces.RealInput B[3](each unit="T", start={0, 0, 0})
      "Magnetic flux density, body axes"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    when sample(samplePeriod, samplePeriod) then
      y = magneticSensitivityOutput(x, C, B);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"), C(each unit="m/(s2.T)"))
    "Magnetic sensitivity, of an accelerometer";

  block GyroContinuous "Magnetic sensitivity, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real C[3,3](each unit="rad/(s.T)") = fill(0, 3, 3)
      "Bias of axis i per flux density along axis j";
    Modelica.Blocks.Interfaces.RealInput B[3](each unit="T", start={0, 0, 0})
      "Magnetic flux density, body axes"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    y = magneticSensitivityOutput(x, C, B);
  end GyroContinuous;

  block AccelContinuous = GyroContinuous(x(each unit="m/s2"), y(each unit="m/s2"), C(each
    unit="m/(s2.T)")) "Magnetic sensitivity, of an accelerometer, without samples";

  annotation(Documentation(info="<html>
<p>Magnetic sensitivity; stage: bias.</p>
<p>Equation (LaTeX): <code>y = x + C B</code></p>
<p>Source: IEEE Std 528-2019, acceleration-insensitive drift rate, note on magnetic influences; no
source for the linear form.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>C</td><td>{y}/T</td><td>bias of axis i per flux density along axis j</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end MagneticSensitivity;
