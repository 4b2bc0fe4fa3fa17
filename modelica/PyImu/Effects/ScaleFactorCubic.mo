// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package ScaleFactorCubic "Scale factor nonlinearity, third order"
  extends PyImu.Icons.EffectPackage;

  function scaleFactorCubicOutput "scale factor nonlinearity, third order"
    extends Modelica.Icons.Function;
    input Real x[3], s3[3];
    output Real y[3];
  algorithm
    y[1] := x[1] + s3[1]*(x[1]*(x[1]*x[1]));
    y[2] := x[2] + s3[2]*(x[2]*(x[2]*x[2]));
    y[3] := x[3] + s3[3]*(x[3]*(x[3]*x[3]));
  end scaleFactorCubicOutput;

  block Gyro "Scale factor nonlinearity, third order, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real s3[3](each unit="s2/rad2") = fill(0, 3)
      "Relative change of the scale factor per squared input";
  equation
    when sample(samplePeriod, samplePeriod) then
      y = scaleFactorCubicOutput(x, s3);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"), s3(each unit="s4/m2"))
    "Scale factor nonlinearity, third order, of an accelerometer";

  block GyroContinuous "Scale factor nonlinearity, third order, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real s3[3](each unit="s2/rad2") = fill(0, 3)
      "Relative change of the scale factor per squared input";
  equation
    y = scaleFactorCubicOutput(x, s3);
  end GyroContinuous;

  block AccelContinuous = GyroContinuous(x(each unit="m/s2"), y(each unit="m/s2"), s3(each
    unit="s4/m2")) "Scale factor nonlinearity, third order, of an accelerometer, without samples";

  annotation(Documentation(info="<html>
<p>Scale factor nonlinearity, third order; stage: gain.</p>
<p>Equation (LaTeX): <code>y = x + s_3 x^3</code></p>
<p>Source: no source for a gyro; of an accelerometer K3 of IEEE Std 1293, whose text was not
checked.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>s3</td><td>1/({y})^2</td><td>relative change of the scale factor per squared input</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end ScaleFactorCubic;
