// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package VibrationRectification "Vibration rectification error"
  extends PyImu.Icons.EffectPackage;

  function vibrationRectificationOutput "vibration rectification error"
    extends Modelica.Icons.Function;
    input Real x[3], V[3,3], square[3];
    output Real y[3];
  algorithm
    y[1] := x[1] + (V[1,1]*square[1] + V[1,2]*square[2] + V[1,3]*square[3]);
    y[2] := x[2] + (V[2,1]*square[1] + V[2,2]*square[2] + V[2,3]*square[3]);
    y[3] := x[3] + (V[3,1]*square[1] + V[3,2]*square[2] + V[3,3]*square[3]);
  end vibrationRectificationOutput;

  block Gyro "Vibration rectification error, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real V[3,3](each unit="rad.s3/m2") = fill(0, 3, 3)
      "Bias of axis i per mean square vibration along axis j";
    Modelica.Blocks.Interfaces.RealInput square[3](each unit="m2/s4", start={0, 0, 0})
      "Mean square of the specific force's vibration, body axes"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    when sample(samplePeriod, samplePeriod) then
      y = vibrationRectificationOutput(x, V, square);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"), V(each unit="s2/m"))
    "Vibration rectification error, of an accelerometer";

  block GyroContinuous "Vibration rectification error, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real V[3,3](each unit="rad.s3/m2") = fill(0, 3, 3)
      "Bias of axis i per mean square vibration along axis j";
    Modelica.Blocks.Interfaces.RealInput square[3](each unit="m2/s4", start={0, 0, 0})
      "Mean square of the specific force's vibration, body axes"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    y = vibrationRectificationOutput(x, V, square);
  end GyroContinuous;

  block AccelContinuous = GyroContinuous(x(each unit="m/s2"), y(each unit="m/s2"), V(each
    unit="s2/m")) "Vibration rectification error, of an accelerometer, without samples";

  annotation(Documentation(info="<html>
<p>Vibration rectification error; stage: bias.</p>
<p>Equation (LaTeX): <code>y = x + V \\langle f_\\mathrm{vib}^2 \\rangle</code></p>
<p>Source: no source for the equation; data sheets state its coefficient per g^2 (ADIS16460 rev. B,
table 1).</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>V</td><td>{y}/(m/s^2)^2</td><td>bias of axis i per mean square vibration along axis
j</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end VibrationRectification;
