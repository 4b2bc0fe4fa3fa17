// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package Misalignment "Misalignment, nonorthogonality"
  extends PyImu.Icons.EffectPackage;

  function misalignmentOutput "misalignment, nonorthogonality"
    extends Modelica.Icons.Function;
    input Real x[3], m[3,3];
    output Real y[3];
  algorithm
    y[1] := x[1] + (m[1,2]*x[2] + m[1,3]*x[3]);
    y[2] := x[2] + (m[2,1]*x[1] + m[2,3]*x[3]);
    y[3] := x[3] + (m[3,1]*x[1] + m[3,2]*x[2]);
  end misalignmentOutput;

  block Gyro "Misalignment, nonorthogonality, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real m[3,3](each unit="rad") = fill(0, 3, 3)
      "Small angle: part of axis j seen by axis i";
  equation
    assert(abs(m[1,1]) + abs(m[2,2]) + abs(m[3,3]) <= 0,
      "misalignment: m must have zeros on its diagonal");
    when sample(samplePeriod, samplePeriod) then
      y = misalignmentOutput(x, m);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"))
    "Misalignment, nonorthogonality, of an accelerometer";

  block GyroContinuous "Misalignment, nonorthogonality, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real m[3,3](each unit="rad") = fill(0, 3, 3)
      "Small angle: part of axis j seen by axis i";
  equation
    assert(abs(m[1,1]) + abs(m[2,2]) + abs(m[3,3]) <= 0,
      "misalignment: m must have zeros on its diagonal");
    y = misalignmentOutput(x, m);
  end GyroContinuous;

  block AccelContinuous = GyroContinuous(x(each unit="m/s2"), y(each unit="m/s2"))
    "Misalignment, nonorthogonality, of an accelerometer, without samples";

  annotation(Documentation(info="<html>
<p>Misalignment, nonorthogonality; stage: gain.</p>
<p>Equation (LaTeX): <code>y = x + M x,\\; \\mathrm{diag}\\, M = 0</code></p>
<p>Source: Hidalgo 2012, section 3.2, matrix M; Groves 2013, eqs. 4.16 and 4.17, M_a and M_g.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>m</td><td>rad</td><td>small angle: part of axis j seen by axis i</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end Misalignment;
