// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Rover.Functions;
function turnOnSpotMotion "Turn on spot: attitude (4), rate (3), specific force (3), position (3) at the time t"
  extends Modelica.Icons.Function;
  input Real t, startTime, heading0, rampTime, latitude, gravity, spotTurnRate, angle, pause;
  output Real y[13];
protected
  Real v1, v2, v3, v4, v5, v6, v7, v8, v9, v10, v11, v12, v13, v14, v15, v16, v17, v18, v19,
    v20;
algorithm
  v1 := t - startTime;
  v2 := angle/spotTurnRate;
  v3 := v2 - rampTime;
  v4 := abs(1/rampTime);
  v5 := min(max(v1*v4, 0), 1);
  v6 := v5*v5*v5;
  v7 := v1 - v2;
  v8 := min(max(v7*v4, 0), 1);
  v9 := v8*v8*v8;
  v10 := v7 - rampTime - pause;
  v11 := min(max(v10*v4, 0), 1);
  v12 := v11*v11*v11;
  v13 := min(max((v10 - v2)*v4, 0), 1);
  v14 := v13*v13*v13;
  v15 := (heading0 + spotTurnRate*(min(max(v1 - rampTime, 0), v3) + rampTime*(v6*v5*(2.5 +
    v5*(v5 - 3)) + (v8 - v9*v8*(2.5 + v8*(v8 - 3)))) - (min(max(v10 - rampTime, 0), v3) +
    rampTime*(v12*v11*(2.5 + v11*(v11 - 3)) + (v13 - v14*v13*(2.5 + v13*(v13 - 3)))))))/2;
  v16 := cos(v15);
  v17 := sin(v15);
  v18 := 7.292115e-05*cos(latitude);
  v19 := 2*(v17*v18);
  v20 := 0.5*(spotTurnRate*(v6*(10 + v5*(6*v5 - 15)) - v9*(10 + v8*(6*v8 - 15)) - (v12*(10 +
    v11*(6*v11 - 15)) - v14*(10 + v13*(6*v13 - 15)))));
  y[1] := v16;
  y[2] := 0;
  y[3] := 0;
  y[4] := v17;
  y[5] := v16*v19;
  y[6] := v18 - v17*v19;
  y[7] := 2*(v16*(v16*v20) + v17*v20*v17) + 7.292115e-05*sin(latitude);
  y[8] := 0;
  y[9] := 0;
  y[10] := gravity;
  y[11] := 0;
  y[12] := 0;
  y[13] := 0;
  annotation(Documentation(info="<html>
<p>Hidalgo 2012, section 6.1. The speed rises and falls along 10 x^3 - 15 x^4 + 6 x^5. The rate
contains the Earth's rotation, the force gravity and Coriolis' force; printed from the unit
RoverDrive, on level ground and without vibration.</p>
</html>"));
end turnOnSpotMotion;
