within PyImu.Attitude;
block MrpError "Error of an attitude whose rate is wrong, as modified Rodrigues parameters"
  extends PyImu.Icons.Sensor;
  parameter Real p0[3](each unit="rad") = fill(0, 3) "Error at the start";
  Modelica.Blocks.Interfaces.RealInput rate[3](each unit="rad/s") "Estimated rate, body axes"
    annotation(Placement(transformation(extent={{-140,40},{-100,80}})));
  Modelica.Blocks.Interfaces.RealInput rateError[3](each unit="rad/s") "True rate less the estimated one"
    annotation(Placement(transformation(extent={{-140,-80},{-100,-40}})));
  Modelica.Blocks.Interfaces.RealOutput p[3](each unit="rad", start=p0, each fixed=true) "Error, in rad while it is small"
    annotation(Placement(transformation(extent={{100,-10},{120,10}})));
equation
  der(p) = Functions.mrpErrorDerivative(p, rate, rateError);
  annotation(Documentation(info="<html>
<p>Truth is estimate times p; exact for an error of any size. Crassidis, Markley 2003, section III,
has the linear part. With a = 1 and f = 4 the parameters are the rotation vector to second order.</p>
</html>"));
end MrpError;
