within PyImu.Thermal;
block Ramp "Temperature that rises steadily from one to another"
  extends PyImu.Icons.Sensor;
  parameter Real from(unit="degC") = 15 "Temperature at the start";
  parameter Real to(unit="degC") = 35 "Temperature in the end";
  parameter Modelica.Units.SI.Time duration(min=1e-3) = 3600 "Of the rise";
  Modelica.Blocks.Interfaces.RealOutput temperature(unit="degC") "Temperature"
    annotation(Placement(transformation(extent={{100,-10},{120,10}})));
equation
  assert(duration >= 1e-3, "duration must not be below 1e-3 s");
  temperature = from + (to - from)*min(time/max(duration, 1e-3), 1);
  annotation(Documentation(info="<html>
<p>T = from + (to - from) min(t/duration, 1): the ramp of a climatic chamber.</p>
</html>"));
end Ramp;
