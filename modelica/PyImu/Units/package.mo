within PyImu;
package Units "Units of noise, which have roots"
  extends Modelica.Icons.Package;
  annotation(Documentation(info="<html>
<p>Modelica spells units with integer exponents only. The unit of a noise density's root is therefore said in words.</p>
</html>"));
end Units;
