// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Signals;
package Jerk "Rate of the specific force, body axes"
  extends PyImu.Icons.SignalPackage;

  function jerkSignal "rate of the specific force, body axes"
    extends Modelica.Icons.Function;
    input Real specificForce[3], memory[3];
    input Boolean started;
    input Real h;
    output Real y[3];
  algorithm
    y[1] := (specificForce[1] - (if started then memory[1] else specificForce[1]))/h;
    y[2] := (specificForce[2] - (if started then memory[2] else specificForce[2]))/h;
    y[3] := (specificForce[3] - (if started then memory[3] else specificForce[3]))/h;
  end jerkSignal;

  block Signal "Rate of the specific force, body axes"
    extends PyImu.Interfaces.Sampled;
    Modelica.Blocks.Interfaces.RealInput specificForce[3](each unit="m/s2", start={0, 0, 9.80665})
      "Specific force, body axes"
      annotation(Placement(transformation(extent={{-140,-20},{-100,20}})));
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="m/s3", start={0, 0, 0})
      "Rate of the specific force, body axes"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
  protected
    discrete Real memory[3](each start=0, each fixed=true);
    Boolean started(start=false, fixed=true);
  equation
    when sample(samplePeriod, samplePeriod) then
      y = jerkSignal(specificForce, pre(memory), pre(started), samplePeriod);
      memory = specificForce;
      started = true;
    end when;
  end Signal;

  annotation(Documentation(info="<html>
<p>Rate of the specific force, body axes, sample by sample, from specificForce. At the first sample
it is zero.</p>
</html>"));
end Jerk;
