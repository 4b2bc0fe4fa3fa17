// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package ScaleFactorAsymmetry "Scale factor asymmetry"
  extends PyImu.Icons.EffectPackage;

  function scaleFactorAsymmetryOutput "scale factor asymmetry"
    extends Modelica.Icons.Function;
    input Real x[3], sa[3];
    output Real y[3];
  algorithm
    y[1] := x[1] + sa[1]*abs(x[1]);
    y[2] := x[2] + sa[2]*abs(x[2]);
    y[3] := x[3] + sa[3]*abs(x[3]);
  end scaleFactorAsymmetryOutput;

  block Gyro "Scale factor asymmetry, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real sa[3](each unit="1") = fill(0, 3)
      "Half the difference of the slopes for positive and negative input";
  equation
    when sample(samplePeriod, samplePeriod) then
      y = scaleFactorAsymmetryOutput(x, sa);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"))
    "Scale factor asymmetry, of an accelerometer";

  block GyroContinuous "Scale factor asymmetry, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real sa[3](each unit="1") = fill(0, 3)
      "Half the difference of the slopes for positive and negative input";
  equation
    y = scaleFactorAsymmetryOutput(x, sa);
  end GyroContinuous;

  block AccelContinuous = GyroContinuous(x(each unit="m/s2"), y(each unit="m/s2"))
    "Scale factor asymmetry, of an accelerometer, without samples";

  annotation(Documentation(info="<html>
<p>Scale factor asymmetry; stage: gain.</p>
<p>Equation (LaTeX): <code>y = x + s_a |x|</code></p>
<p>Source: scale factor asymmetry of IEEE Std 528, whose text was not checked; here half the
difference of the slopes.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>sa</td><td>1</td><td>half the difference of the slopes for positive and negative
input</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end ScaleFactorAsymmetry;
