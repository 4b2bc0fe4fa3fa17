// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package CrossAxisNonlinearity "Cross-axis nonlinearity, second order"
  extends PyImu.Icons.EffectPackage;

  function crossAxisNonlinearityOutput "cross-axis nonlinearity, second order"
    extends Modelica.Icons.Function;
    input Real x[3], k[3,3], kx[3];
    output Real y[3];
  protected
    Real v1, v2, v3;
  algorithm
    v1 := x[2]*x[2];
    v2 := x[3]*x[3];
    v3 := x[1]*x[1];
    y[1] := x[1] + (k[1,2]*v1 + k[1,3]*v2) + kx[1]*(x[2]*x[3]);
    y[2] := x[2] + (k[2,1]*v3 + k[2,3]*v2) + kx[2]*(x[3]*x[1]);
    y[3] := x[3] + (k[3,1]*v3 + k[3,2]*v1) + kx[3]*(x[1]*x[2]);
  end crossAxisNonlinearityOutput;

  block Accel "Cross-axis nonlinearity, second order, of an accelerometer"
    extends PyImu.Interfaces.SampledEffect(x(each unit="m/s2"), y(each unit="m/s2"));
    parameter Real k[3,3](each unit="s2/m") = fill(0, 3, 3)
      "Output of axis i per squared force along axis j: K_pp, K_oo";
    parameter Real kx[3](each unit="s2/m") = fill(0, 3)
      "Output per product of the forces along the two other axes: K_po";
  equation
    assert(abs(k[1,1]) + abs(k[2,2]) + abs(k[3,3]) <= 0,
      "cross_axis_nonlinearity: k must have zeros on its diagonal");
    when sample(samplePeriod, samplePeriod) then
      y = crossAxisNonlinearityOutput(x, k, kx);
    end when;
  end Accel;

  block AccelContinuous "Cross-axis nonlinearity, second order, of an accelerometer, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="m/s2"), y(each unit="m/s2"));
    parameter Real k[3,3](each unit="s2/m") = fill(0, 3, 3)
      "Output of axis i per squared force along axis j: K_pp, K_oo";
    parameter Real kx[3](each unit="s2/m") = fill(0, 3)
      "Output per product of the forces along the two other axes: K_po";
  equation
    assert(abs(k[1,1]) + abs(k[2,2]) + abs(k[3,3]) <= 0,
      "cross_axis_nonlinearity: k must have zeros on its diagonal");
    y = crossAxisNonlinearityOutput(x, k, kx);
  end AccelContinuous;

  annotation(Documentation(info="<html>
<p>Cross-axis nonlinearity, second order; stage: gain.</p>
<p>Equation (LaTeX): <code>y_i = x_i + \\sum_{j \\ne i} k_{ij} x_j^2 + k_{x,i} x_j x_k</code></p>
<p>Source: coefficients K_pp, K_oo and K_po of IEEE Std 1293, whose text was not checked.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>k</td><td>1/({y})</td><td>output of axis i per squared force along axis j: K_pp,
K_oo</td></tr>
<tr><td>kx</td><td>1/({y})</td><td>output per product of the forces along the two other axes:
K_po</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end CrossAxisNonlinearity;
