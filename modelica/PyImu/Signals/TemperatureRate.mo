// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Signals;
package TemperatureRate "Rate of the temperature"
  extends PyImu.Icons.SignalPackage;

  function temperatureRateSignal "rate of the temperature"
    extends Modelica.Icons.Function;
    input Real temperature, memory[4];
    input Boolean started;
    input Real h;
    output Real y;
  protected
    Real v1;
  algorithm
    v1 := if started then memory[1] else temperature;
    y := if temperature <> v1 then (temperature - v1)/(min(memory[2] + 1, max(1, floor(60/h)))*h)
      else if memory[4] > 0 then memory[3] else 0;
  end temperatureRateSignal;

  function temperatureRateSignalNextMemory "memory of the next sample"
    extends Modelica.Icons.Function;
    input Real temperature, memory[4];
    input Boolean started;
    input Real h;
    output Real following[4];
  protected
    Real v1;
    Boolean v2;
    Real v3, v4;
  algorithm
    v1 := if started then memory[1] else temperature;
    v2 := temperature <> v1;
    v3 := memory[2] + 1;
    v4 := min(v3, max(1, floor(60/h)));
    following[1] := if v2 then temperature else v1;
    following[2] := if not (v2 or not started) then v3 else 0;
    following[3] := if v2 then (temperature - v1)/(v4*h) else if memory[4] > 0 then memory[3] else
      0;
    following[4] := max((if v2 then v4 else memory[4]) - 1, 0);
  end temperatureRateSignalNextMemory;

  block Signal "Rate of the temperature"
    extends PyImu.Interfaces.Sampled;
    Modelica.Blocks.Interfaces.RealInput temperature(unit="degC", start=25.0)
      "Temperature of the part"
      annotation(Placement(transformation(extent={{-140,-20},{-100,20}})));
    Modelica.Blocks.Interfaces.RealOutput y(unit="K/s", start=0.0) "Rate of the temperature"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
  protected
    discrete Real memory[4](each start=0, each fixed=true);
    Boolean started(start=false, fixed=true);
  equation
    when sample(samplePeriod, samplePeriod) then
      y = temperatureRateSignal(temperature, pre(memory), pre(started), samplePeriod);
      memory = temperatureRateSignalNextMemory(temperature, pre(memory), pre(started),
        samplePeriod);
      started = true;
    end when;
  end Signal;

  annotation(Documentation(info="<html>
<p>Rate of the temperature, sample by sample, from temperature. A temperature that has rested for
more than 60 s changes as if it had rested so long.</p>
</html>"));
end TemperatureRate;
