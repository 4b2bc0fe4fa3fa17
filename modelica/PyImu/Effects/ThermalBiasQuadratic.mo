// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package ThermalBiasQuadratic "Bias temperature sensitivity, second order"
  extends PyImu.Icons.EffectPackage;

  function thermalBiasQuadraticOutput "bias temperature sensitivity, second order"
    extends Modelica.Icons.Function;
    input Real x[3], k2[3], T0, T;
    output Real y[3];
  protected
    Real v1;
  algorithm
    v1 := PyImu.Math.square(T - T0);
    y[1] := x[1] + k2[1]*v1;
    y[2] := x[2] + k2[2]*v1;
    y[3] := x[3] + k2[3]*v1;
  end thermalBiasQuadraticOutput;

  block Gyro "Bias temperature sensitivity, second order, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real k2[3](each unit="rad/(s.K2)") = fill(0, 3) "Bias per kelvin squared";
    parameter Real T0(unit="degC") = 25 "Temperature at which the thermal error is zero";
    Modelica.Blocks.Interfaces.RealInput T(unit="degC", start=25) "Temperature of the part"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    when sample(samplePeriod, samplePeriod) then
      y = thermalBiasQuadraticOutput(x, k2, T0, T);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"), k2(each unit="m/(s2.K2)"))
    "Bias temperature sensitivity, second order, of an accelerometer";

  block GyroContinuous "Bias temperature sensitivity, second order, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real k2[3](each unit="rad/(s.K2)") = fill(0, 3) "Bias per kelvin squared";
    parameter Real T0(unit="degC") = 25 "Temperature at which the thermal error is zero";
    Modelica.Blocks.Interfaces.RealInput T(unit="degC", start=25) "Temperature of the part"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    y = thermalBiasQuadraticOutput(x, k2, T0, T);
  end GyroContinuous;

  block AccelContinuous = GyroContinuous(x(each unit="m/s2"), y(each unit="m/s2"), k2(each
    unit="m/(s2.K2)"))
    "Bias temperature sensitivity, second order, of an accelerometer, without samples";

  annotation(Documentation(info="<html>
<p>Bias temperature sensitivity, second order; stage: bias.</p>
<p>Equation (LaTeX): <code>y = x + k_2 (T - T_0)^2</code></p>
<p>Source: polynomial of third order as autopilots fit it (ArduPilot, pull request 16262; PX4,
parameters TC_G).</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>k2</td><td>{y}/K^2</td><td>bias per kelvin squared</td></tr>
<tr><td>T0</td><td>degC</td><td>temperature at which the thermal error is zero</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end ThermalBiasQuadratic;
