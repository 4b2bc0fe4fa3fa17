// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Attitude.Functions;
function quaternionDerivative "Derivative of q of a body that turns at a rate in body axes"
  extends Modelica.Icons.Function;
  input Real q[4], rate[3];
  output Real y[4];
algorithm
  y[1] := -(q[2]*rate[1] + q[3]*rate[2] + q[4]*rate[3])/2;
  y[2] := (q[1]*rate[1] + (q[3]*rate[3] - q[4]*rate[2]))/2;
  y[3] := (q[1]*rate[2] + (q[4]*rate[1] - q[2]*rate[3]))/2;
  y[4] := (q[1]*rate[3] + (q[2]*rate[2] - q[3]*rate[1]))/2;
  annotation(Documentation(info="<html>
<p>q' (4,) of a body that turns at rate (3,) rad/s in body axes: q (0, rate) / 2.</p>
<p>Hidalgo 2012, section 4.1, there with the vector part first.</p>
</html>"));
end quaternionDerivative;
