// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package ThermalBiasCubic "Bias temperature sensitivity, third order"
  extends PyImu.Icons.EffectPackage;

  function thermalBiasCubicOutput "bias temperature sensitivity, third order"
    extends Modelica.Icons.Function;
    input Real x[3], k3[3], T0, T;
    output Real y[3];
  protected
    Real v1, v2;
  algorithm
    v1 := T - T0;
    v2 := v1*(v1*v1);
    y[1] := x[1] + k3[1]*v2;
    y[2] := x[2] + k3[2]*v2;
    y[3] := x[3] + k3[3]*v2;
  end thermalBiasCubicOutput;

  block Gyro "Bias temperature sensitivity, third order, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real k3[3](each unit="rad/(s.K3)") = fill(0, 3) "Bias per kelvin cubed";
    parameter Real T0(unit="degC") = 25 "Temperature at which the thermal error is zero";
    Modelica.Blocks.Interfaces.RealInput T(unit="degC", start=25) "Temperature of the part"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    when sample(samplePeriod, samplePeriod) then
      y = thermalBiasCubicOutput(x, k3, T0, T);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"), k3(each unit="m/(s2.K3)"))
    "Bias temperature sensitivity, third order, of an accelerometer";

  block GyroContinuous "Bias temperature sensitivity, third order, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real k3[3](each unit="rad/(s.K3)") = fill(0, 3) "Bias per kelvin cubed";
    parameter Real T0(unit="degC") = 25 "Temperature at which the thermal error is zero";
    Modelica.Blocks.Interfaces.RealInput T(unit="degC", start=25) "Temperature of the part"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    y = thermalBiasCubicOutput(x, k3, T0, T);
  end GyroContinuous;

  block AccelContinuous = GyroContinuous(x(each unit="m/s2"), y(each unit="m/s2"), k3(each
    unit="m/(s2.K3)"))
    "Bias temperature sensitivity, third order, of an accelerometer, without samples";

  annotation(Documentation(info="<html>
<p>Bias temperature sensitivity, third order; stage: bias.</p>
<p>Equation (LaTeX): <code>y = x + k_3 (T - T_0)^3</code></p>
<p>Source: polynomial of third order as autopilots fit it (ArduPilot, pull request 16262; PX4,
parameters TC_G).</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>k3</td><td>{y}/K^3</td><td>bias per kelvin cubed</td></tr>
<tr><td>T0</td><td>degC</td><td>temperature at which the thermal error is zero</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end ThermalBiasCubic;
