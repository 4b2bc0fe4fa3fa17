// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package ThermalMisalignment "Misalignment temperature sensitivity"
  extends PyImu.Icons.EffectPackage;

  function thermalMisalignmentOutput "misalignment temperature sensitivity"
    extends Modelica.Icons.Function;
    input Real x[3], mT[3,3], T0, T;
    output Real y[3];
  protected
    Real v1;
  algorithm
    v1 := T - T0;
    y[1] := x[1] + v1*(mT[1,2]*x[2] + mT[1,3]*x[3]);
    y[2] := x[2] + v1*(mT[2,1]*x[1] + mT[2,3]*x[3]);
    y[3] := x[3] + v1*(mT[3,1]*x[1] + mT[3,2]*x[2]);
  end thermalMisalignmentOutput;

  block Gyro "Misalignment temperature sensitivity, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real mT[3,3](each unit="rad/K") = fill(0, 3, 3)
      "Part of axis j seen by axis i, per kelvin";
    parameter Real T0(unit="degC") = 25 "Temperature at which the thermal error is zero";
    Modelica.Blocks.Interfaces.RealInput T(unit="degC", start=25) "Temperature of the part"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    assert(abs(mT[1,1]) + abs(mT[2,2]) + abs(mT[3,3]) <= 0,
      "thermal_misalignment: mT must have zeros on its diagonal");
    when sample(samplePeriod, samplePeriod) then
      y = thermalMisalignmentOutput(x, mT, T0, T);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"))
    "Misalignment temperature sensitivity, of an accelerometer";

  block GyroContinuous "Misalignment temperature sensitivity, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real mT[3,3](each unit="rad/K") = fill(0, 3, 3)
      "Part of axis j seen by axis i, per kelvin";
    parameter Real T0(unit="degC") = 25 "Temperature at which the thermal error is zero";
    Modelica.Blocks.Interfaces.RealInput T(unit="degC", start=25) "Temperature of the part"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    assert(abs(mT[1,1]) + abs(mT[2,2]) + abs(mT[3,3]) <= 0,
      "thermal_misalignment: mT must have zeros on its diagonal");
    y = thermalMisalignmentOutput(x, mT, T0, T);
  end GyroContinuous;

  block AccelContinuous = GyroContinuous(x(each unit="m/s2"), y(each unit="m/s2"))
    "Misalignment temperature sensitivity, of an accelerometer, without samples";

  annotation(Documentation(info="<html>
<p>Misalignment temperature sensitivity; stage: gain.</p>
<p>Equation (LaTeX): <code>y = x + (T - T_0) M_T x,\\; \\mathrm{diag}\\, M_T = 0</code></p>
<p>Source: no source for the equation; the linear term of a misalignment that follows
temperature.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>mT</td><td>rad/K</td><td>part of axis j seen by axis i, per kelvin</td></tr>
<tr><td>T0</td><td>degC</td><td>temperature at which the thermal error is zero</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end ThermalMisalignment;
