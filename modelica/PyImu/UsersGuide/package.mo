within PyImu;
package UsersGuide "How to use this library"
  extends Modelica.Icons.Information;
  annotation(DocumentationClass=true, Documentation(info="<html>
<p>Drag <code>Sensors.Imu</code> into a model, set <code>part</code> and <code>seed</code>, connect
rate, specific force and temperature or bind them in the declaration, as in
<code>Examples.ImuAtRest</code>. To change a coefficient, open the part:
<code>imu(imt30(gyroscope(angleRandomWalk(N={1e-4, 1e-4, 1e-4}))))</code>. A part of your own is
printed by <code>pyimu modelica PART --out DIR</code>.</p>
</html>"));
end UsersGuide;
