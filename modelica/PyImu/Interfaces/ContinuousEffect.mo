within PyImu.Interfaces;
partial block ContinuousEffect "An error of a triad without memory, in continuous time"
  extends PyImu.Icons.Effect;
  Modelica.Blocks.Interfaces.RealInput x[3] "Input, body axes"
    annotation(Placement(transformation(extent={{-140,-20},{-100,20}})));
  Modelica.Blocks.Interfaces.RealOutput y[3] "Output, body axes"
    annotation(Placement(transformation(extent={{100,-10},{120,10}})));
  annotation(Documentation(info="<html>
<p>The output follows from the input at every instant; no sample is taken and no event made.</p>
</html>"));
end ContinuousEffect;
