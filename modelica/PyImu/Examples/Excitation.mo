within PyImu.Examples;
block Excitation "Values of both signs that change at each sample and are exact in any tool"
  extends PyImu.Interfaces.Sampled;
  parameter Integer n = 3 "Number of values";
  parameter Integer shift = 0 "What makes one source differ from another";
  parameter Real offset[n] = fill(0, n) "Middle of each value";
  parameter Real amplitude[n] = fill(1, n) "Largest departure from the middle";
  Modelica.Blocks.Interfaces.RealOutput y[n](start=offset, each fixed=true) "The values"
    annotation(Placement(transformation(extent={{100,-10},{120,10}})));
protected
  discrete Real k(start=0, fixed=true) "Number of the sample";
equation
  when sample(samplePeriod, samplePeriod) then
    k = pre(k) + 1;
    y = excitationValues(k, shift, offset, amplitude);
  end when;
  annotation(Documentation(info="<html>
<p>Value i of sample k is offset[i] + amplitude[i] (((i + shift) k + 5 i) mod 19 - 9)/9: whole
numbers, one product and one quotient.</p>
</html>"));
end Excitation;
