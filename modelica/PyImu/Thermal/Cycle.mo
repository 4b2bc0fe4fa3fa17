within PyImu.Thermal;
block Cycle "Temperature of a climatic chamber that goes up and down"
  extends PyImu.Icons.Sensor;
  parameter Real middle(unit="degC") = 25 "Middle";
  parameter Real swing(unit="K") = 10 "How far it goes to either side";
  parameter Modelica.Units.SI.Time period(min=1e-3) = 7200 "Of one cycle";
  Modelica.Blocks.Interfaces.RealOutput temperature(unit="degC") "Temperature"
    annotation(Placement(transformation(extent={{100,-10},{120,10}})));
equation
  assert(period >= 1e-3, "period must not be below 1e-3 s");
  temperature = middle + swing*sin(2*Modelica.Constants.pi*time/max(period, 1e-3));
  annotation(Documentation(info="<html>
<p>The default is the cycle of examples/imt30_thermal.py: 15 to 35 degC and back, twice in four
hours.</p>
</html>"));
end Cycle;
