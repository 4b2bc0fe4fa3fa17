within PyImu.UsersGuide;
class ImportOfUnits "The co-simulation units beside this library"
  extends Modelica.Icons.Information;
  annotation(DocumentationClass=true, Documentation(info="<html>
<p><code>pyimu build PART --out DIR</code> writes <code>ImuSensor.fmi2.fmu</code> and
<code>AttitudeUkf.fmi2.fmu</code>, co-simulation units of FMI 2.0. In Dymola: File, Import, FMU; in
OpenModelica: File, Import FMU. The sensor's inputs are rate[1..3], specific_force[1..3] and
temperature, its outputs gyro[1..3] and accel[1..3], its parameters
gyro_error.angle_random_walk.N[1] and so on, seed and sample_period; the filter takes gyro[1..3],
accel[1..3] and temperature and gives q[1..4], roll, pitch, yaw, gyro_bias[1..3] and std[1..6].</p>
<p>A tool may give these names another spelling in the class that it makes. What Dymola and OpenModelica make
of them was not tried: neither was at hand.</p>
<p>The attitude filter is not printed as Modelica: its step is a function of matrices with switches of
thousands of operations. It comes as a unit.</p>
</html>"));
end ImportOfUnits;
