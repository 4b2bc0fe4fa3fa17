// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Attitude.Functions;
function mrpErrorDerivative "Derivative of the attitude error p of an estimate whose rate is wrong by rateError"
  extends Modelica.Icons.Function;
  input Real p[3], rate[3], rateError[3];
  output Real y[3];
protected
  Real v1, v2, v3, v4;
algorithm
  v1 := p[1]*p[1] + p[2]*p[2] + p[3]*p[3];
  v2 := (16 - v1)/(16 + v1);
  v3 := 4*v2/(1 + v2);
  v4 := p[1]*rateError[1] + p[2]*rateError[2] + p[3]*rateError[3];
  y[1] := (v3*rateError[1] + (p[2]*rateError[3] - p[3]*rateError[2]) + p[1]*v4/4)/2 -
    (rate[2]*p[3] - rate[3]*p[2]);
  y[2] := (v3*rateError[2] + (p[3]*rateError[1] - p[1]*rateError[3]) + p[2]*v4/4)/2 -
    (rate[3]*p[1] - rate[1]*p[3]);
  y[3] := (v3*rateError[3] + (p[1]*rateError[2] - p[2]*rateError[1]) + p[3]*v4/4)/2 -
    (rate[1]*p[2] - rate[2]*p[1]);
  annotation(Documentation(info="<html>
<p>p' (3,) of the attitude error p (3,) in body axes, truth = estimate p.</p>
<p>The estimate turns at rate (3,) rad/s.</p>
<p>rateError (3,) is the true rate less rate. Exact for an error of any size; to first order p' =
-rate x p + share(a, f) rateError (Crassidis and Markley 2003, section III, has the linear part).
With rates against inertial space it holds in any turning frame, because a known Earth rate turns
truth and estimate alike.</p>
</html>"));
end mrpErrorDerivative;
