within PyImu.Attitude;
block Alignment "Attitude of a body at rest, by its specific force"
  extends PyImu.Icons.Sensor;
  parameter Modelica.Units.SI.Angle yaw = 0 "Yaw, counter-clockwise from east, which gravity does not show";
  Modelica.Blocks.Interfaces.RealInput specificForce[3](each unit="m/s2", start={0, 0, 9.80665}) "Specific force, body axes"
    annotation(Placement(transformation(extent={{-140,-20},{-100,20}})));
  Modelica.Blocks.Interfaces.RealOutput q[4](each unit="1") "Attitude, body to world"
    annotation(Placement(transformation(extent={{100,-10},{120,10}})));
equation
  q = Functions.levelled(specificForce, yaw);
  annotation(Documentation(info="<html>
<p>Roll and pitch of a body at rest from the direction of its specific force, with the yaw that is
given. Groves 2013, section 5.6.2 (levelling), in the axes of this library.</p>
</html>"));
end Alignment;
