// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package BiasAsymmetry "Bias asymmetry"
  extends PyImu.Icons.EffectPackage;

  function biasAsymmetryOutput "bias asymmetry"
    extends Modelica.Icons.Function;
    input Real x[3], ba[3];
    output Real y[3];
  algorithm
    y[1] := x[1] + ba[1]/2*sign(x[1]);
    y[2] := x[2] + ba[2]/2*sign(x[2]);
    y[3] := x[3] + ba[3]/2*sign(x[3]);
  end biasAsymmetryOutput;

  block Accel "Bias asymmetry, of an accelerometer"
    extends PyImu.Interfaces.SampledEffect(x(each unit="m/s2"), y(each unit="m/s2"));
    parameter Real ba[3](each unit="m/s2") = fill(0, 3)
      "Bias for positive less bias for negative input, K0'";
  equation
    when sample(samplePeriod, samplePeriod) then
      y = biasAsymmetryOutput(x, ba);
    end when;
  end Accel;

  block AccelContinuous "Bias asymmetry, of an accelerometer, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="m/s2"), y(each unit="m/s2"));
    parameter Real ba[3](each unit="m/s2") = fill(0, 3)
      "Bias for positive less bias for negative input, K0'";
  equation
    y = biasAsymmetryOutput(x, ba);
  end AccelContinuous;

  annotation(Documentation(info="<html>
<p>Bias asymmetry; stage: gain.</p>
<p>Equation (LaTeX): <code>y = x + \\tfrac{b_a}{2}\\, \\mathrm{sign}\\, x</code></p>
<p>Source: coefficient K0&#x27; of IEEE Std 1293, whose text was not checked.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>ba</td><td>{y}</td><td>bias for positive less bias for negative input, K0&#x27;</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end BiasAsymmetry;
