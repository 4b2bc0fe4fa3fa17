// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Signals;
package TransportRate "Rotation of east-north-up along the way over the Earth, body axes"
  extends PyImu.Icons.SignalPackage;

  function transportRateSignal "rotation of east-north-up along the way over the Earth, body axes"
    extends Modelica.Icons.Function;
    input Real attitude[4], latitude, velocity[3];
    output Real y[3];
  protected
    Real v1, v2, v3, v4, v5, v6, v7, v8, v9, v10, v11;
  algorithm
    v1 := sqrt(attitude[1]*attitude[1] + attitude[2]*attitude[2] + attitude[3]*attitude[3] +
      attitude[4]*attitude[4]);
    v2 := attitude[1]/v1;
    v3 := attitude[4]/v1;
    v4 := velocity[1]/6371008.8;
    v5 := attitude[3]/v1;
    v6 := v4*tan(latitude);
    v7 := 2*(v3*v4 - v5*v6);
    v8 := velocity[2]/6371008.8;
    v9 := attitude[2]/v1;
    v10 := 2*(v3*v8 + v9*v6);
    v11 := 2*(-(v9*v4 + v5*v8));
    y[1] := v2*v7 - v8 + (v3*v10 - v5*v11);
    y[2] := v4 + v2*v10 + (v9*v11 - v3*v7);
    y[3] := v6 + v2*v11 + (v5*v7 - v9*v10);
  end transportRateSignal;

  block Signal "Rotation of east-north-up along the way over the Earth, body axes"
    extends PyImu.Interfaces.Sampled;
    Modelica.Blocks.Interfaces.RealInput attitude[4](each unit="1", start={1, 0, 0, 0})
      "Attitude, body to world (east-north-up), Hamilton, scalar first"
      annotation(Placement(transformation(extent={{-140,30},{-100,70}})));
    Modelica.Blocks.Interfaces.RealInput latitude(unit="rad", start=0.0) "Geographic latitude"
      annotation(Placement(transformation(extent={{-140,-20},{-100,20}})));
    Modelica.Blocks.Interfaces.RealInput velocity[3](each unit="m/s", start={0, 0, 0})
      "Velocity over the ground, east-north-up"
      annotation(Placement(transformation(extent={{-140,-70},{-100,-30}})));
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="rad/s", start={0, 0, 0})
      "Rotation of east-north-up along the way over the Earth, body axes"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
  equation
    when sample(samplePeriod, samplePeriod) then
      y = transportRateSignal(attitude, latitude, velocity);
    end when;
  end Signal;

  annotation(Documentation(info="<html>
<p>Rotation of east-north-up along the way over the Earth, body axes, sample by sample, from
attitude, latitude, velocity.</p>
</html>"));
end TransportRate;
