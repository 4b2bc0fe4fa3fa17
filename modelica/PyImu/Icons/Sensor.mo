within PyImu.Icons;
partial block Sensor "Icon of a sensor"
  annotation(Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100,-100},{100,100}}),
    graphics={
      Rectangle(extent={{-100,100},{100,-100}}, lineColor={0,0,127}, fillColor={240,248,255},
        fillPattern=FillPattern.Solid),
      Line(points={{-60,-60},{40,-60}}, color={0,0,127}, arrow={Arrow.None,Arrow.Filled}),
      Line(points={{-60,-60},{-60,50}}, color={0,0,127}, arrow={Arrow.None,Arrow.Filled}),
      Line(points={{-60,-60},{0,0}}, color={0,0,127}, arrow={Arrow.None,Arrow.Filled}),
      Ellipse(extent={{0,60},{60,0}}, lineColor={0,0,127}),
      Text(extent={{-150,150},{150,110}}, textString="%name", textColor={0,0,255})}),
    Documentation(info="<html>
<p>Three axes and what turns about them.</p>
</html>"));
end Sensor;
