// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package SupplySensitivity "Supply sensitivity"
  extends PyImu.Icons.EffectPackage;

  function supplySensitivityOutput "supply sensitivity"
    extends Modelica.Icons.Function;
    input Real x[3], kV[3], V0, V;
    output Real y[3];
  protected
    Real v1;
  algorithm
    v1 := V - V0;
    y[1] := x[1] + kV[1]*v1;
    y[2] := x[2] + kV[2]*v1;
    y[3] := x[3] + kV[3]*v1;
  end supplySensitivityOutput;

  block Gyro "Supply sensitivity, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real kV[3](each unit="rad/(s.V)") = fill(0, 3) "Bias per volt";
    parameter Real V0(unit="V") = 3.3 "Supply at which the error is zero";
    Modelica.Blocks.Interfaces.RealInput V(unit="V", start=3.3) "Supply voltage"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    when sample(samplePeriod, samplePeriod) then
      y = supplySensitivityOutput(x, kV, V0, V);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"), kV(each unit="m/(s2.V)"))
    "Supply sensitivity, of an accelerometer";

  block GyroContinuous "Supply sensitivity, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real kV[3](each unit="rad/(s.V)") = fill(0, 3) "Bias per volt";
    parameter Real V0(unit="V") = 3.3 "Supply at which the error is zero";
    Modelica.Blocks.Interfaces.RealInput V(unit="V", start=3.3) "Supply voltage"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    y = supplySensitivityOutput(x, kV, V0, V);
  end GyroContinuous;

  block AccelContinuous = GyroContinuous(x(each unit="m/s2"), y(each unit="m/s2"), kV(each
    unit="m/(s2.V)")) "Supply sensitivity, of an accelerometer, without samples";

  annotation(Documentation(info="<html>
<p>Supply sensitivity; stage: bias.</p>
<p>Equation (LaTeX): <code>y = x + k_V (V - V_0)</code></p>
<p>Source: no source for the equation; data sheets state its coefficient per volt (ADIS16460 rev. B,
table 1).</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>kV</td><td>{y}/V</td><td>bias per volt</td></tr>
<tr><td>V0</td><td>V</td><td>supply at which the error is zero</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end SupplySensitivity;
