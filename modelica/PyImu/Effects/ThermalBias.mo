// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package ThermalBias "Bias temperature sensitivity"
  extends PyImu.Icons.EffectPackage;

  function thermalBiasOutput "bias temperature sensitivity"
    extends Modelica.Icons.Function;
    input Real x[3], kT[3], T0, T;
    output Real y[3];
  protected
    Real v1;
  algorithm
    v1 := T - T0;
    y[1] := x[1] + kT[1]*v1;
    y[2] := x[2] + kT[2]*v1;
    y[3] := x[3] + kT[3]*v1;
  end thermalBiasOutput;

  block Gyro "Bias temperature sensitivity, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real kT[3](each unit="rad/(s.K)") = fill(0, 3) "Bias per kelvin";
    parameter Real T0(unit="degC") = 25 "Temperature at which the thermal error is zero";
    Modelica.Blocks.Interfaces.RealInput T(unit="degC", start=25) "Temperature of the part"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    when sample(samplePeriod, samplePeriod) then
      y = thermalBiasOutput(x, kT, T0, T);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"), kT(each unit="m/(s2.K)"))
    "Bias temperature sensitivity, of an accelerometer";

  block GyroContinuous "Bias temperature sensitivity, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real kT[3](each unit="rad/(s.K)") = fill(0, 3) "Bias per kelvin";
    parameter Real T0(unit="degC") = 25 "Temperature at which the thermal error is zero";
    Modelica.Blocks.Interfaces.RealInput T(unit="degC", start=25) "Temperature of the part"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    y = thermalBiasOutput(x, kT, T0, T);
  end GyroContinuous;

  block AccelContinuous = GyroContinuous(x(each unit="m/s2"), y(each unit="m/s2"), kT(each
    unit="m/(s2.K)")) "Bias temperature sensitivity, of an accelerometer, without samples";

  annotation(Documentation(info="<html>
<p>Bias temperature sensitivity; stage: bias.</p>
<p>Equation (LaTeX): <code>y = x + k_T (T - T_0)</code></p>
<p>Source: Hidalgo 2012, table 1.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>kT</td><td>{y}/K</td><td>bias per kelvin</td></tr>
<tr><td>T0</td><td>degC</td><td>temperature at which the thermal error is zero</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end ThermalBias;
