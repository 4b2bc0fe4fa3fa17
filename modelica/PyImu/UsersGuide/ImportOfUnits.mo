within PyImu.UsersGuide;
class ImportOfUnits "The co-simulation units beside this library"
  extends Modelica.Icons.Information;
  annotation(DocumentationClass=true, Documentation(info="<html>
<p><code>pyimu build PART --out DIR</code> writes <code>ImuSensor.fmi2.fmu</code> and
<code>AttitudeUkf.fmi2.fmu</code>: units of FMI 2.0 for co-simulation, with scalar variables of
structured names. For another platform than the one at hand add <code>--platform</code>.</p>
<p><b>In any Modelica tool: the library Modelica-FMI 0.0.8</b> of the Modelica Association
(github.com/modelica/Modelica-FMI), which is written for co-simulation units of FMI 2.0 and 3.0. Its
command makes a class in a package of yours; then load its library FMI and that package:</p>
<pre>modelica-fmi ImuSensor.fmi2.fmu Units/ImuSensor.mo
modelica-fmi AttitudeUkf.fmi2.fmu Units/AttitudeUkf.mo</pre>
<p>Set <code>communicationStepSize</code> of both to the sample period; it is so at first.</p>
<p><b>Dymola's own import</b>: File, Open, or <code>importFMU(\"ImuSensor.fmi2.fmu\")</code>, as
co-simulation. With <i>Structured declaration of variables</i>, which needs the naming convention
&quot;structured&quot; that the units declare, vectors stay vectors and dots make records. Set
<code>fmi_CommunicationStepSize</code> to the sample period.</p>
<p><b>OpenModelica's own import</b> (File, Import FMU) takes units of FMI 2.0 for model exchange; so says
the chapter FMI Import of its users' guide, and names OMSimulator for all others. These are
co-simulation units: take Modelica-FMI, or OMSimulator, in which they are components of an SSP model
beside, not within, Modelica.</p>
<table>
<tr><th>in the unit</th><th>Modelica-FMI; OpenModelica</th><th>Dymola, structured</th></tr>
<tr><td>gyro[1]</td><td>gyro_1_</td><td>gyro[1]</td></tr>
<tr><td>specific_force[3]</td><td>specific_force_3_</td><td>specific_force[3]</td></tr>
<tr><td>gyro_error.angle_random_walk.N[1]</td><td>gyro_error_angle_random_walk_N_1_</td>
<td>gyro_error.angle_random_walk.N[1]</td></tr>
<tr><td>gyro_error.misalignment.m[1,2]</td><td>gyro_error_misalignment_m_1_2_</td>
<td>gyro_error.misalignment.m[1,2]</td></tr>
</table>
<p>The middle column follows from the tools' sources, whose replacement is compared in the tests with
the names of both units: no two of them become the same. The right one follows from Dymola's manual;
what it makes of a matrix without its diagonal was not seen. <code>Examples.ImportedUnits</code>
connects the classes of the middle column; for those of the right write <code>connect(drive.rate,
sensor.rate)</code> and so on.</p>
<p><b>Not run</b>: none of the three imports, as neither Dymola nor OpenModelica nor Modelica-FMI was
at hand. The wiring of the example was run, with this library's blocks in place of the units.</p>
<p>A unit keeps its seed under the name <code>seed</code>; 0, where it starts, stands for the name of the
instance, as a tool gives it. Each input of a unit must be given, also those that a model does not
have. Samples are made within a step: sample k of a unit that another feeds has that one's sample
k - 1.</p>
<p>Where no importer is at hand, <code>Attitude.AttitudeUkf</code> is the same filter by its C, and
<code>Sensors</code> are the same sensors as equations.</p>
</html>"));
end ImportOfUnits;
