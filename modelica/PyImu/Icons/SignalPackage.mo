within PyImu.Icons;
partial package SignalPackage "Icon of the functions and the block of one derived signal"
  annotation(Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100,-100},{100,100}}),
    graphics={
      Rectangle(extent={{-100,100},{100,-100}}, lineColor={128,128,128}, radius=20),
      Line(points={{-80,-40},{-40,40},{0,-20},{40,50},{80,0}}, color={0,0,127}, thickness=0.5)}),
    Documentation(info="<html>
<p>A course in time.</p>
</html>"));
end SignalPackage;
