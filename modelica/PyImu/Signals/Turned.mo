// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Signals;
package Turned "Angle turned about each body axis since power-on"
  extends PyImu.Icons.SignalPackage;

  function turnedSignal "angle turned about each body axis since power-on"
    extends Modelica.Icons.Function;
    input Real rate[3], memory[3], h;
    output Real y[3];
  algorithm
    y[1] := memory[1] + h*rate[1];
    y[2] := memory[2] + h*rate[2];
    y[3] := memory[3] + h*rate[3];
  end turnedSignal;

  function turnedSignalNextMemory "memory of the next sample"
    extends Modelica.Icons.Function;
    input Real rate[3], memory[3], h;
    output Real following[3];
  algorithm
    following[1] := memory[1] + h*rate[1];
    following[2] := memory[2] + h*rate[2];
    following[3] := memory[3] + h*rate[3];
  end turnedSignalNextMemory;

  block Signal "Angle turned about each body axis since power-on"
    extends PyImu.Interfaces.Sampled;
    Modelica.Blocks.Interfaces.RealInput rate[3](each unit="rad/s", start={0, 0, 0})
      "Angular rate against inertial space, body axes"
      annotation(Placement(transformation(extent={{-140,-20},{-100,20}})));
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="rad", start={0, 0, 0})
      "Angle turned about each body axis since power-on"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
  protected
    discrete Real memory[3](each start=0, each fixed=true);
  equation
    when sample(samplePeriod, samplePeriod) then
      y = turnedSignal(rate, pre(memory), samplePeriod);
      memory = turnedSignalNextMemory(rate, pre(memory), samplePeriod);
    end when;
  end Signal;

  annotation(Documentation(info="<html>
<p>Angle turned about each body axis since power-on, sample by sample, from rate.</p>
</html>"));
end Turned;
