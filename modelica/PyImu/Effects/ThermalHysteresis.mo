// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package ThermalHysteresis "Bias thermal hysteresis"
  extends PyImu.Icons.EffectPackage;

  function thermalHysteresisOutput "bias thermal hysteresis"
    extends Modelica.Icons.Function;
    input Real x[3], kh[3], width, T, played;
    input Boolean started;
    output Real y[3];
  protected
    Real v1;
  algorithm
    v1 := max(T - width, min(T + width, if started then played else T)) - T;
    y[1] := x[1] + kh[1]*v1;
    y[2] := x[2] + kh[2]*v1;
    y[3] := x[3] + kh[3]*v1;
  end thermalHysteresisOutput;

  function thermalHysteresisNextPlayed "played of the next sample"
    extends Modelica.Icons.Function;
    input Real width, T, played;
    input Boolean started;
    output Real following;
  algorithm
    following := max(T - width, min(T + width, if started then played else T));
  end thermalHysteresisNextPlayed;

  block Gyro "Bias thermal hysteresis, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real kh[3](each unit="rad/(s.K)") = fill(0, 3)
      "Bias per kelvin by which the play lags behind the temperature";
    parameter Real width(unit="K", min=0) = 1 "Half width of the play";
    Modelica.Blocks.Interfaces.RealInput T(unit="degC", start=25) "Temperature of the part"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  protected
    discrete Real played(start=0, fixed=true);
    Boolean started(start=false, fixed=true);
  equation
    assert(width >= 0, "thermal_hysteresis: width must not be below 0");
    when sample(samplePeriod, samplePeriod) then
      y = thermalHysteresisOutput(x, kh, width, T, pre(played), pre(started));
      played = thermalHysteresisNextPlayed(width, T, pre(played), pre(started));
      started = true;
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"), kh(each unit="m/(s2.K)"))
    "Bias thermal hysteresis, of an accelerometer";

  annotation(Documentation(info="<html>
<p>Bias thermal hysteresis; stage: bias.</p>
<p>Equation (LaTeX): <code>y = x + k_h (\\mathrm{play}_w(T) - T)</code></p>
<p>Source: no source for the play operator as a model of a sensor; the operator: Visintin,
Differential Models of Hysteresis, 1994.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>kh</td><td>{y}/K</td><td>bias per kelvin by which the play lags behind the
temperature</td></tr>
<tr><td>width</td><td>K</td><td>half width of the play</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end ThermalHysteresis;
