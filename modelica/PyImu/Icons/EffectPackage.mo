within PyImu.Icons;
partial package EffectPackage "Icon of the functions and blocks of one effect"
  annotation(Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100,-100},{100,100}}),
    graphics={
      Rectangle(extent={{-100,100},{100,-100}}, lineColor={128,128,128}, radius=20),
      Line(points={{-70,-70},{70,70}}, color={192,192,192}),
      Line(points={{-70,-45},{70,65}}, color={0,0,127}, thickness=0.5)}),
    Documentation(info="<html>
<p>Drawn for this library.</p>
</html>"));
end EffectPackage;
