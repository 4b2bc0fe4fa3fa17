// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Signals;
package Time "Time since power-on"
  extends PyImu.Icons.SignalPackage;

  function timeSignal "time since power-on"
    extends Modelica.Icons.Function;
    input Real memory[1], h;
    output Real y;
  algorithm
    y := (memory[1] + 1)*h;
  end timeSignal;

  function timeSignalNextMemory "memory of the next sample"
    extends Modelica.Icons.Function;
    input Real memory[1];
    output Real following[1];
  algorithm
    following[1] := memory[1] + 1;
  end timeSignalNextMemory;

  block Signal "Time since power-on"
    extends PyImu.Interfaces.Sampled;
    Modelica.Blocks.Interfaces.RealOutput y(unit="s", start=0.0) "Time since power-on"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
  protected
    discrete Real memory[1](each start=0, each fixed=true);
  equation
    when sample(samplePeriod, samplePeriod) then
      y = timeSignal(pre(memory), samplePeriod);
      memory = timeSignalNextMemory(pre(memory));
    end when;
  end Signal;

  annotation(Documentation(info="<html>
<p>Time since power-on, sample by sample, from the number of the sample.</p>
</html>"));
end Time;
