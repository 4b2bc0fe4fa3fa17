within PyImu.UsersGuide;
class Limits "What was run, and what was not"
  extends Modelica.Icons.Information;
  annotation(DocumentationClass=true, Documentation(info="<html>
<p>Every class was read by rumoca 0.10.2 and pymoca 0.12.0. rumoca compiled and ran the effects, the
signals, the parts, the noise, the filters, the drives and the kinematics, with a stand-in for the few
names of the Modelica Standard Library; their values are those of pyimu to the last bit, or to four
units in the last place where exp, log, sin or cos are in them. Dymola and OpenModelica have compiled
nothing of it yet.</p>
<p>rumoca 0.10.2 has no external C and no external objects: of <code>Noise.drawNormalsC</code> and
<code>Attitude.AttitudeUkf</code> the C was compiled by a C compiler and called as a tool calls it, which
gave the units' samples to the last bit, and the block around the filter was run with a function in
Modelica in its place. rumoca has no getInstanceName(): give each sensor a seed there. pymoca 0.12.0
reads every file and runs none of this.</p>
<p>OpenModelica's verdict on every class is asked for by <code>modelica/check.py</code>, which needs
<code>omc</code>.</p>
</html>"));
end Limits;
