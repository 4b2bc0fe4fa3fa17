within PyImu.Thermal;
block Heating "Temperature of a part in surroundings of another, with its own heat"
  extends PyImu.Icons.Sensor;
  parameter Modelica.Units.SI.Time tau(min=1e-3) = 500 "Time constant";
  parameter Real rise(unit="K") = 6 "By which the part is warmer in the end";
  parameter Real start(unit="degC") = 20 "Temperature of the part at power-on";
  Modelica.Blocks.Interfaces.RealInput ambient(unit="degC", start=20) "Temperature of the surroundings"
    annotation(Placement(transformation(extent={{-140,-20},{-100,20}})));
  Modelica.Blocks.Interfaces.RealOutput temperature(unit="degC", start=start, fixed=true) "Temperature of the part"
    annotation(Placement(transformation(extent={{100,-10},{120,10}})));
equation
  assert(tau >= 1e-3, "tau must not be below 1e-3 s");
  der(temperature) = (ambient + rise - temperature)/max(tau, 1e-3);
  annotation(Documentation(info="<html>
<p>tau dT/dt = ambient + rise - T: a body of one heat capacity (Newton's law of cooling) that heats
itself by as much as makes it rise K warmer in the end.</p>
</html>"));
end Heating;
