within PyImu.Icons;
partial block Effect "Icon of an error of a sensor"
  annotation(Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100,-100},{100,100}}),
    graphics={
      Rectangle(extent={{-100,100},{100,-100}}, lineColor={0,0,127}, fillColor={255,255,255},
        fillPattern=FillPattern.Solid),
      Line(points={{-80,0},{80,0}}, color={192,192,192}),
      Line(points={{0,-80},{0,80}}, color={192,192,192}),
      Line(points={{-80,-80},{80,80}}, color={192,192,192}),
      Line(points={{-80,-55},{80,75}}, color={0,0,127}, thickness=0.5),
      Text(extent={{-150,150},{150,110}}, textString="%name", textColor={0,0,255})}),
    Documentation(info="<html>
<p>The line of a perfect sensor in grey, that of the erroneous one in blue.</p>
</html>"));
end Effect;
