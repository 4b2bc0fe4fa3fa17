// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package AngleRandomWalk "Angle (velocity) random walk"
  extends PyImu.Icons.EffectPackage;

  function angleRandomWalkOutput "angle (velocity) random walk"
    extends Modelica.Icons.Function;
    input Real x[3], N[3], w[3], h;
    output Real y[3];
  protected
    Real v1;
  algorithm
    v1 := sqrt(h);
    y[1] := x[1] + N[1]*w[1]/v1;
    y[2] := x[2] + N[2]*w[2]/v1;
    y[3] := x[3] + N[3]*w[3]/v1;
  end angleRandomWalkOutput;

  block Gyro "Angle (velocity) random walk, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real N[3](each min=0) = fill(0, 3)
      "Root of the two-sided white noise density [rad/sqrt(s)]";
    Modelica.Blocks.Interfaces.RealInput w[3](each unit="1")
      "Standard normals, new ones at each sample"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=-90,
      origin={0,120})));
  equation
    assert(min(N) >= 0, "angle_random_walk: N must not be below 0");
    when sample(samplePeriod, samplePeriod) then
      y = angleRandomWalkOutput(x, N, w, samplePeriod);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"))
    "Angle (velocity) random walk, of an accelerometer";

  annotation(Documentation(info="<html>
<p>Angle (velocity) random walk; stage: noise.</p>
<p>Equation (LaTeX): <code>y = x + N w / \\sqrt{h}</code></p>
<p>Source: Hidalgo 2012, section 3.2 and table 3; IEEE Std 528-2001, 2.10.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>N</td><td>{Y}/sqrt(s)</td><td>root of the two-sided white noise density</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end AngleRandomWalk;
