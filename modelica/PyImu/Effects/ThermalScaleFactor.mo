// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package ThermalScaleFactor "Scale factor temperature sensitivity"
  extends PyImu.Icons.EffectPackage;

  function thermalScaleFactorOutput "scale factor temperature sensitivity"
    extends Modelica.Icons.Function;
    input Real x[3], kS[3], T0, T;
    output Real y[3];
  protected
    Real v1;
  algorithm
    v1 := T - T0;
    y[1] := x[1] + kS[1]*v1*x[1];
    y[2] := x[2] + kS[2]*v1*x[2];
    y[3] := x[3] + kS[3]*v1*x[3];
  end thermalScaleFactorOutput;

  block Gyro "Scale factor temperature sensitivity, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real kS[3](each unit="1/K") = fill(0, 3) "Relative scale factor error per kelvin";
    parameter Real T0(unit="degC") = 25 "Temperature at which the thermal error is zero";
    Modelica.Blocks.Interfaces.RealInput T(unit="degC", start=25) "Temperature of the part"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    when sample(samplePeriod, samplePeriod) then
      y = thermalScaleFactorOutput(x, kS, T0, T);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"))
    "Scale factor temperature sensitivity, of an accelerometer";

  block GyroContinuous "Scale factor temperature sensitivity, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real kS[3](each unit="1/K") = fill(0, 3) "Relative scale factor error per kelvin";
    parameter Real T0(unit="degC") = 25 "Temperature at which the thermal error is zero";
    Modelica.Blocks.Interfaces.RealInput T(unit="degC", start=25) "Temperature of the part"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    y = thermalScaleFactorOutput(x, kS, T0, T);
  end GyroContinuous;

  block AccelContinuous = GyroContinuous(x(each unit="m/s2"), y(each unit="m/s2"))
    "Scale factor temperature sensitivity, of an accelerometer, without samples";

  annotation(Documentation(info="<html>
<p>Scale factor temperature sensitivity; stage: gain.</p>
<p>Equation (LaTeX): <code>y = (1 + k_S (T - T_0))\\, x</code></p>
<p>Source: no source for the equation; data sheets state its coefficient per K (ADIS16460 rev. B,
table 1).</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>kS</td><td>1/K</td><td>relative scale factor error per kelvin</td></tr>
<tr><td>T0</td><td>degC</td><td>temperature at which the thermal error is zero</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end ThermalScaleFactor;
