// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package ScaleFactorNonlinearity "Scale factor nonlinearity, second order"
  extends PyImu.Icons.EffectPackage;

  function scaleFactorNonlinearityOutput "scale factor nonlinearity, second order"
    extends Modelica.Icons.Function;
    input Real x[3], s2[3];
    output Real y[3];
  algorithm
    y[1] := x[1] + s2[1]*(x[1]*x[1]);
    y[2] := x[2] + s2[2]*(x[2]*x[2]);
    y[3] := x[3] + s2[3]*(x[3]*x[3]);
  end scaleFactorNonlinearityOutput;

  block Gyro "Scale factor nonlinearity, second order, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real s2[3](each unit="s/rad") = fill(0, 3)
      "Relative change of the scale factor per input, second order";
  equation
    when sample(samplePeriod, samplePeriod) then
      y = scaleFactorNonlinearityOutput(x, s2);
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"), s2(each unit="s2/m"))
    "Scale factor nonlinearity, second order, of an accelerometer";

  block GyroContinuous "Scale factor nonlinearity, second order, of a gyro, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real s2[3](each unit="s/rad") = fill(0, 3)
      "Relative change of the scale factor per input, second order";
  equation
    y = scaleFactorNonlinearityOutput(x, s2);
  end GyroContinuous;

  block AccelContinuous = GyroContinuous(x(each unit="m/s2"), y(each unit="m/s2"), s2(each
    unit="s2/m")) "Scale factor nonlinearity, second order, of an accelerometer, without samples";

  annotation(Documentation(info="<html>
<p>Scale factor nonlinearity, second order; stage: gain.</p>
<p>Equation (LaTeX): <code>y = x + s_2 x^2</code></p>
<p>Source: no source for a gyro; of an accelerometer K2 of IEEE Std 1293, whose text was not
checked.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>s2</td><td>1/({y})</td><td>relative change of the scale factor per input, second
order</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end ScaleFactorNonlinearity;
