// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Rover.Functions;
function straightMotion "Straight: attitude (4), rate (3), specific force (3), position (3) at the time t"
  extends Modelica.Icons.Function;
  input Real t, startTime, heading0, rampTime, latitude, gravity, cruiseSpeed, length;
  output Real y[13];
protected
  Real v1, v2, v3, v4, v5, v6, v7, v8, v9, v10, v11, v12, v13, v14, v15, v16, v17, v18, v19,
    v20, v21, v22, v23, v24, v25;
algorithm
  v1 := heading0/2;
  v2 := cos(v1);
  v3 := sin(v1);
  v4 := 7.292115e-05*cos(latitude);
  v5 := 2*(v3*v4);
  v6 := 7.292115e-05*sin(latitude);
  v7 := t - startTime;
  v8 := abs(1/rampTime);
  v9 := min(max(v7*v8, 0), 1);
  v10 := 1 - v9;
  v11 := length/cruiseSpeed;
  v12 := min(max((v7 - v11)*v8, 0), 1);
  v13 := 1 - v12;
  v14 := cruiseSpeed*((30*v9*v9*v10*v10 - 30*v12*v12*v13*v13)*v8);
  v15 := cos(heading0);
  v16 := v9*v9*v9;
  v17 := v12*v12*v12;
  v18 := cruiseSpeed*(v16*(10 + v9*(6*v9 - 15)) - v17*(10 + v12*(6*v12 - 15)));
  v19 := sin(heading0);
  v20 := v14*v15 + 2*(-v6*(v18*v19));
  v21 := v18*v15;
  v22 := v14*v19 + 2*(v6*v21);
  v23 := 2*(v3*v22);
  v24 := 2*(-v3*v20);
  v25 := cruiseSpeed*(min(max(v7 - rampTime, 0), v11 - rampTime) + rampTime*(v16*v9*(2.5 +
    v9*(v9 - 3)) + (v12 - v17*v12*(2.5 + v12*(v12 - 3)))));
  y[1] := v2;
  y[2] := 0;
  y[3] := 0;
  y[4] := v3;
  y[5] := v2*v5;
  y[6] := v4 - v3*v5;
  y[7] := v6;
  y[8] := v20 + v2*v23 + v3*v24;
  y[9] := v22 + v2*v24 - v3*v23;
  y[10] := 2*(-v4*v21) + gravity;
  y[11] := v25*v15;
  y[12] := v25*v19;
  y[13] := 0;
end straightMotion;
