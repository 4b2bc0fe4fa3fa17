// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Signals;
package EarthRate "The Earth's rotation, body axes"
  extends PyImu.Icons.SignalPackage;

  function earthRateSignal "the Earth's rotation, body axes"
    extends Modelica.Icons.Function;
    input Real attitude[4], latitude;
    output Real y[3];
  protected
    Real v1, v2, v3, v4, v5, v6, v7, v8, v9, v10;
  algorithm
    v1 := sqrt(attitude[1]*attitude[1] + attitude[2]*attitude[2] + attitude[3]*attitude[3] +
      attitude[4]*attitude[4]);
    v2 := attitude[1]/v1;
    v3 := attitude[4]/v1;
    v4 := 7.292115e-05*cos(latitude);
    v5 := attitude[3]/v1;
    v6 := 7.292115e-05*sin(latitude);
    v7 := 2*(v3*v4 - v5*v6);
    v8 := attitude[2]/v1;
    v9 := 2*(v8*v6);
    v10 := 2*(-v8*v4);
    y[1] := v2*v7 + (v3*v9 - v5*v10);
    y[2] := v4 + v2*v9 + (v8*v10 - v3*v7);
    y[3] := v6 + v2*v10 + (v5*v7 - v8*v9);
  end earthRateSignal;

  block Signal "The Earth's rotation, body axes"
    extends PyImu.Interfaces.Sampled;
    Modelica.Blocks.Interfaces.RealInput attitude[4](each unit="1", start={1, 0, 0, 0})
      "Attitude, body to world (east-north-up), Hamilton, scalar first"
      annotation(Placement(transformation(extent={{-140,13},{-100,53}})));
    Modelica.Blocks.Interfaces.RealInput latitude(unit="rad", start=0.0) "Geographic latitude"
      annotation(Placement(transformation(extent={{-140,-53},{-100,-13}})));
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="rad/s", start={0, 0, 0})
      "The Earth's rotation, body axes"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
  equation
    when sample(samplePeriod, samplePeriod) then
      y = earthRateSignal(attitude, latitude);
    end when;
  end Signal;

  annotation(Documentation(info="<html>
<p>The Earth's rotation, body axes, sample by sample, from attitude, latitude.</p>
</html>"));
end EarthRate;
