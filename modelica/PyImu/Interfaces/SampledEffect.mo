within PyImu.Interfaces;
partial block SampledEffect "An error of a triad that is sampled"
  extends PyImu.Interfaces.Sampled;
  parameter Real y0[3] = fill(0, 3) "Output before the first sample" annotation(Evaluate=true);
  Modelica.Blocks.Interfaces.RealInput x[3](start=y0) "Input, body axes"
    annotation(Placement(transformation(extent={{-140,-20},{-100,20}})));
  Modelica.Blocks.Interfaces.RealOutput y[3](start=y0, each fixed=true) "Output, body axes"
    annotation(Placement(transformation(extent={{100,-10},{120,10}})));
  annotation(Documentation(info="<html>
<p>Maps the input at a sample instant to an output that is held until the next. Of an input that
jumps at the instant itself the value after the jump counts.</p>
</html>"));
end SampledEffect;
