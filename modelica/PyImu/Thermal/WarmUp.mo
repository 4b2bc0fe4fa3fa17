within PyImu.Thermal;
block WarmUp "Temperature of a part that warms up after power-on"
  extends PyImu.Icons.Sensor;
  parameter Modelica.Units.SI.Time tau(min=1e-3) = 500 "Time constant";
  parameter Real rise(unit="K") = 6 "Rise by the part's own heat";
  parameter Real start(unit="degC") = 20 "Temperature at power-on";
  Modelica.Blocks.Interfaces.RealOutput temperature(unit="degC") "Temperature of the part"
    annotation(Placement(transformation(extent={{100,-10},{120,10}})));
equation
  assert(tau >= 1e-3, "tau must not be below 1e-3 s");
  temperature = start + rise*(1 - exp(-time/max(tau, 1e-3)));
  annotation(Documentation(info="<html>
<p>T = start + rise (1 - exp(-t/tau)): Heating in closed form, in surroundings that stay at
start.</p>
</html>"));
end WarmUp;
