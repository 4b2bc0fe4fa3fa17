// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package EarthRate "Earth rate not modelled"
  extends PyImu.Icons.EffectPackage;

  function earthRateOutput "Earth rate not modelled"
    extends Modelica.Icons.Function;
    input Real x[3], k, earth[3];
    output Real y[3];
  algorithm
    y[1] := x[1] + k*earth[1];
    y[2] := x[2] + k*earth[2];
    y[3] := x[3] + k*earth[3];
  end earthRateOutput;

  block Gyro "Earth rate not modelled, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real k(unit="1") = 0
      "Share of the Earth rate that is added; 1 where it had been left out";
    Modelica.Blocks.Interfaces.RealInput earth[3](each unit="rad/s", start={0, 0, 0})
      "The Earth's rotation, body axes"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    when sample(samplePeriod, samplePeriod) then
      y = earthRateOutput(x, k, earth);
    end when;
  end Gyro;

  block GyroContinuous "Earth rate not modelled, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real k(unit="1") = 0
      "Share of the Earth rate that is added; 1 where it had been left out";
    Modelica.Blocks.Interfaces.RealInput earth[3](each unit="rad/s", start={0, 0, 0})
      "The Earth's rotation, body axes"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90,
      origin={0,-120})));
  equation
    y = earthRateOutput(x, k, earth);
  end GyroContinuous;

  annotation(Documentation(info="<html>
<p>Earth rate not modelled; stage: motion.</p>
<p>Equation (LaTeX): <code>y = x + k\\, R_{nb}^T \\Omega_n(\\varphi)</code></p>
<p>Source: Hidalgo 2012, Earth rotation vector; Groves 2013, eq. 2.123.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>k</td><td>1</td><td>share of the Earth rate that is added; 1 where it had been left
out</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end EarthRate;
