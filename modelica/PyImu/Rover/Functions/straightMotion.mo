// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Rover.Functions;
function straightMotion "Straight: attitude (4), rate (3), specific force (3), position (3) at the time t"
  extends Modelica.Icons.Function;
  input Real t, startTime, heading0, rampTime, latitude, gravity, cruiseSpeed, length;
  output Real y[13];
protected
  Real v1, v2, v3, v4, v5, v6, v7, v8, v9, v10, v11, v12, v13, v14, v15, v16, v17, v18, v19,
    v20, v21, v22, v23, v24, v25, v26, v27, v28, v29, v30, v31, v32;
algorithm
  v1 := heading0/2;
  v2 := cos(v1);
  v3 := sin(v1);
  v4 := 7.292115e-05*cos(latitude);
  v5 := 2*(v3*v4);
  v6 := v2*v5;
  v7 := v4 - v3*v5;
  v8 := 7.292115e-05*sin(latitude);
  v9 := t - startTime;
  v10 := abs(1/rampTime);
  v11 := min(max(v9*v10, 0), 1);
  v12 := 1 - v11;
  v13 := length/cruiseSpeed;
  v14 := min(max((v9 - v13)*v10, 0), 1);
  v15 := 1 - v14;
  v16 := cruiseSpeed*((30*v11*v11*v12*v12 - 30*v14*v14*v15*v15)*v10);
  v17 := cos(heading0);
  v18 := v16*v17;
  v19 := sin(heading0);
  v20 := v16*v19;
  v21 := 2*(v3*v20);
  v22 := 2*(-v3*v18);
  v23 := v11*v11*v11;
  v24 := v14*v14*v14;
  v25 := cruiseSpeed*(v23*(10 + v11*(6*v11 - 15)) - v24*(10 + v14*(6*v14 - 15)));
  v26 := v25*v19;
  v27 := v25*v17;
  v28 := 2*(-v3*v27);
  v29 := 2*(v3*v26);
  v30 := v26 + v2*v28 - v3*v29;
  v31 := v27 + v2*v29 + v3*v28;
  v32 := cruiseSpeed*(min(max(v9 - rampTime, 0), v13 - rampTime) + rampTime*(v23*v11*(2.5 +
    v11*(v11 - 3)) + (v14 - v24*v14*(2.5 + v14*(v14 - 3)))));
  y[1] := v2;
  y[2] := 0;
  y[3] := 0;
  y[4] := v3;
  y[5] := v6;
  y[6] := v7;
  y[7] := v8;
  y[8] := v18 + v2*v21 + v3*v22 + 2*(-v8*v30);
  y[9] := v20 + v2*v22 - v3*v21 + 2*(v8*v31);
  y[10] := gravity + 2*(v6*v30 - v7*v31);
  y[11] := v32*v17;
  y[12] := v32*v19;
  y[13] := 0;
  annotation(Documentation(info="<html>
<p>Hidalgo 2012, section 6.1. The speed rises and falls along 10 x^3 - 15 x^4 + 6 x^5. The rate
contains the Earth's rotation, the force gravity and Coriolis' force; printed from the unit
RoverDrive, on level ground and without vibration.</p>
</html>"));
end straightMotion;
