// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package TransportRate "Transport rate not modelled"
  extends PyImu.Icons.EffectPackage;

  function transportRateOutput "transport rate not modelled"
    extends Modelica.Icons.Function;
    input Real x[3], k, transport[3];
    output Real y[3];
  algorithm
    y[1] := x[1] + k*transport[1];
    y[2] := x[2] + k*transport[2];
    y[3] := x[3] + k*transport[3];
  end transportRateOutput;

  block Gyro "Transport rate not modelled, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real k(unit="1") = 0
      "Share of the transport rate that is added; 1 where it had been left out";
    Modelica.Blocks.Interfaces.RealInput transport[3](each unit="rad/s", start={0, 0, 0})
      "Rotation of east-north-up along the way over the Earth, body axes"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    when sample(samplePeriod, samplePeriod) then
      y = transportRateOutput(x, k, transport);
    end when;
  end Gyro;

  block GyroContinuous "Transport rate not modelled, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real k(unit="1") = 0
      "Share of the transport rate that is added; 1 where it had been left out";
    Modelica.Blocks.Interfaces.RealInput transport[3](each unit="rad/s", start={0, 0, 0})
      "Rotation of east-north-up along the way over the Earth, body axes"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    y = transportRateOutput(x, k, transport);
  end GyroContinuous;

  annotation(Documentation(info="<html>
<p>Transport rate not modelled; stage: motion.</p>
<p>Equation (LaTeX): <code>y = x + k\\, R_{nb}^T [-v_N, v_E, v_E \\tan\\varphi] / R</code></p>
<p>Source: Groves 2013, eq. 5.44, for a sphere.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>k</td><td>1</td><td>share of the transport rate that is added; 1 where it had been left
out</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end TransportRate;
