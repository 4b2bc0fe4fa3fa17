within PyImu;
package Icons "Icons"
  extends Modelica.Icons.IconsPackage;
  annotation(Documentation(info="<html>
<p>Icons of this library's classes.</p>
</html>"));
end Icons;
