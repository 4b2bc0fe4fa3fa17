within PyImu.Interfaces;
partial block Imu "Gyroscope and accelerometer"
  extends PyImu.Interfaces.Triad;
  Modelica.Blocks.Interfaces.RealOutput gyro[3](each unit="rad/s") "Measured rate"
    annotation(Placement(transformation(extent={{100,40},{120,60}})));
  Modelica.Blocks.Interfaces.RealOutput accel[3](each unit="m/s2") "Measured specific force"
    annotation(Placement(transformation(extent={{100,-60},{120,-40}})));
  Modelica.Blocks.Interfaces.RealOutput measuredTemperature(unit="degC", start=25)
    "Temperature of the part, sampled like its axes"
    annotation(Placement(transformation(extent={{100,-10},{120,10}})));
  annotation(Documentation(info="<html>
<p>A gyroscope and an accelerometer with the inputs of Triad; the measured temperature is the input
at the last sample.</p>
</html>"));
end Imu;
