package PyImu "Inertial sensors with their errors, printed from the definitions of pyimu"
  extends Modelica.Icons.Package;
  annotation(
    version="0.1.0",
    uses(Modelica(version="4.0.0")),
    conversion(noneFromVersion=""),
    Documentation(info="<html>
<p>Gyros, accelerometers and inertial measurement units with their errors, as equations that can be
opened. The functions of the effects are printed from the same definitions as the C code of the
co-simulation units that <code>pyimu build</code> makes, operation by operation, and give the same
bits.</p>
<p>Licence: BSD-3-Clause, the file LICENSE of pyimu.</p>
</html>"));
end PyImu;
