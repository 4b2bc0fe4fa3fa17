// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Signals;
package AngularAcceleration "Rate of the angular rate, body axes"
  extends PyImu.Icons.SignalPackage;

  function angularAccelerationSignal "rate of the angular rate, body axes"
    extends Modelica.Icons.Function;
    input Real rate[3], memory[3];
    input Boolean started;
    input Real h;
    output Real y[3];
  algorithm
    y[1] := (rate[1] - (if started then memory[1] else rate[1]))/h;
    y[2] := (rate[2] - (if started then memory[2] else rate[2]))/h;
    y[3] := (rate[3] - (if started then memory[3] else rate[3]))/h;
  end angularAccelerationSignal;

  block Signal "Rate of the angular rate, body axes"
    extends PyImu.Interfaces.Sampled;
    Modelica.Blocks.Interfaces.RealInput rate[3](each unit="rad/s", start={0, 0, 0})
      "Angular rate against inertial space, body axes"
      annotation(Placement(transformation(extent={{-140,-20},{-100,20}})));
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="rad/s2", start={0, 0, 0})
      "Rate of the angular rate, body axes"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
  protected
    discrete Real memory[3](each start=0, each fixed=true);
    Boolean started(start=false, fixed=true);
  equation
    when sample(samplePeriod, samplePeriod) then
      y = angularAccelerationSignal(rate, pre(memory), pre(started), samplePeriod);
      memory = rate;
      started = true;
    end when;
  end Signal;

  annotation(Documentation(info="<html>
<p>Rate of the angular rate, body axes, sample by sample, from rate. At the first sample it is
zero.</p>
</html>"));
end AngularAcceleration;
