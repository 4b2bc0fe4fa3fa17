within PyImu.UsersGuide;
class Limits "What was run, and what was not"
  extends Modelica.Icons.Information;
  annotation(DocumentationClass=true, Documentation(info="<html>
<p>Every class was read by rumoca 0.10.2 and pymoca 0.12.0. rumoca compiled and ran the effects, the
signals, the parts, the noise, the filters, the drives and the kinematics, with a stand-in for the few
names of the Modelica Standard Library; their values are those of pyimu to the last bit, or to four
units in the last place where exp, log, sin or cos are in them. Dymola and OpenModelica have compiled
nothing of it yet.</p>
<p>rumoca has no external C, so that <code>Noise.drawNormalsC</code> was only compiled as C, and it has no
getInstanceName(): give each sensor a seed there.</p>
</html>"));
end Limits;
