within PyImu;
package Attitude "Kinematics of attitude"
  extends Modelica.Icons.Package;
  annotation(Documentation(info="<html>
<p>Attitude is the quaternion from body axes (forward, left, up) to world axes (east, north, up), Hamilton's, scalar first.</p>
</html>"));
end Attitude;
