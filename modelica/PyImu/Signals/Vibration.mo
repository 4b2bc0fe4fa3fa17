// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Signals;
package Vibration "Mean square of the specific force's vibration, body axes"
  extends PyImu.Icons.SignalPackage;

  function vibrationSignal "mean square of the specific force's vibration, body axes"
    extends Modelica.Icons.Function;
    input Real specificForce[3], memory[6];
    input Boolean started;
    input Real h;
    output Real y[3];
  protected
    Real v1, v2, v3, v4;
  algorithm
    v1 := 1 - exp(-h);
    v2 := if started then memory[1] else specificForce[1];
    v3 := if started then memory[2] else specificForce[2];
    v4 := if started then memory[3] else specificForce[3];
    y[1] := memory[4] + v1*(PyImu.Math.square(specificForce[1] - (v2 + v1*(specificForce[1] -
      v2))) - memory[4]);
    y[2] := memory[5] + v1*(PyImu.Math.square(specificForce[2] - (v3 + v1*(specificForce[2] -
      v3))) - memory[5]);
    y[3] := memory[6] + v1*(PyImu.Math.square(specificForce[3] - (v4 + v1*(specificForce[3] -
      v4))) - memory[6]);
  end vibrationSignal;

  function vibrationSignalNextMemory "memory of the next sample"
    extends Modelica.Icons.Function;
    input Real specificForce[3], memory[6];
    input Boolean started;
    input Real h;
    output Real following[6];
  protected
    Real v1, v2, v3, v4, v5, v6, v7;
  algorithm
    v1 := if started then memory[1] else specificForce[1];
    v2 := 1 - exp(-h);
    v3 := v1 + v2*(specificForce[1] - v1);
    v4 := if started then memory[2] else specificForce[2];
    v5 := v4 + v2*(specificForce[2] - v4);
    v6 := if started then memory[3] else specificForce[3];
    v7 := v6 + v2*(specificForce[3] - v6);
    following[1] := v3;
    following[2] := v5;
    following[3] := v7;
    following[4] := memory[4] + v2*(PyImu.Math.square(specificForce[1] - v3) - memory[4]);
    following[5] := memory[5] + v2*(PyImu.Math.square(specificForce[2] - v5) - memory[5]);
    following[6] := memory[6] + v2*(PyImu.Math.square(specificForce[3] - v7) - memory[6]);
  end vibrationSignalNextMemory;

  block Signal "Mean square of the specific force's vibration, body axes"
    extends PyImu.Interfaces.Sampled;
    Modelica.Blocks.Interfaces.RealInput specificForce[3](each unit="m/s2", start={0, 0, 9.80665})
      "Specific force, body axes"
      annotation(Placement(transformation(extent={{-140,-20},{-100,20}})));
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="m2/s4", start={0, 0, 0})
      "Mean square of the specific force's vibration, body axes"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
  protected
    discrete Real memory[6](each start=0, each fixed=true);
    Boolean started(start=false, fixed=true);
  equation
    when sample(samplePeriod, samplePeriod) then
      y = vibrationSignal(specificForce, pre(memory), pre(started), samplePeriod);
      memory = vibrationSignalNextMemory(specificForce, pre(memory), pre(started), samplePeriod);
      started = true;
    end when;
  end Signal;

  annotation(Documentation(info="<html>
<p>Mean square of the specific force's vibration, body axes, sample by sample, from specificForce.
Both means have a time constant of 1 s.</p>
</html>"));
end Vibration;
