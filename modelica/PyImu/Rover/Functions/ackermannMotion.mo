// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Rover.Functions;
function ackermannMotion "Ackermann: attitude (4), rate (3), specific force (3), position (3) at the time t"
  extends Modelica.Icons.Function;
  input Real t, startTime, heading0, rampTime, latitude, gravity, cruiseSpeed, radius, angle;
  output Real y[13];
protected
  Real v1, v2, v3, v4, v5, v6, v7, v8, v9, v10, v11, v12, v13, v14, v15, v16, v17, v18, v19,
    v20, v21, v22, v23, v24, v25, v26, v27, v28, v29, v30, v31, v32, v33;
  Boolean v34;
  Real v35, v36, v37;
algorithm
  v1 := cruiseSpeed/radius;
  v2 := t - startTime;
  v3 := angle*radius/cruiseSpeed;
  v4 := abs(1/rampTime);
  v5 := min(max(v2*v4, 0), 1);
  v6 := v5*v5*v5;
  v7 := min(max((v2 - v3)*v4, 0), 1);
  v8 := v7*v7*v7;
  v9 := min(max(v2 - rampTime, 0), v3 - rampTime) + rampTime*(v6*v5*(2.5 + v5*(v5 - 3)) + (v7 -
    v8*v7*(2.5 + v7*(v7 - 3))));
  v10 := v1*v9;
  v11 := heading0 + v10;
  v12 := v11/2;
  v13 := cos(v12);
  v14 := sin(v12);
  v15 := 7.292115e-05*cos(latitude);
  v16 := 2*(v14*v15);
  v17 := v6*(10 + v5*(6*v5 - 15)) - v8*(10 + v7*(6*v7 - 15));
  v18 := v1*v17;
  v19 := 0.5*v18;
  v20 := 7.292115e-05*sin(latitude);
  v21 := 1 - v5;
  v22 := 1 - v7;
  v23 := cruiseSpeed*((30*v5*v5*v21*v21 - 30*v7*v7*v22*v22)*v4);
  v24 := cos(v11);
  v25 := cruiseSpeed*v17;
  v26 := v25*v18;
  v27 := sin(v11);
  v28 := v23*v24 - v26*v27 + 2*(-v20*(v25*v27));
  v29 := v25*v24;
  v30 := v23*v27 + v26*v24 + 2*(v20*v29);
  v31 := 2*(v14*v30);
  v32 := 2*(-v14*v28);
  v33 := v10*v10/4;
  v34 := v33 < 0.001;
  v35 := if not v34 then sqrt(if v34 then 1 else v33) else 0;
  v36 := cruiseSpeed*v9*(if v34 then 1 - v33/6*(1 - v33/20*(1 - v33/42)) else sin(v35)/v35);
  v37 := heading0 + v10/2;
  y[1] := v13;
  y[2] := 0;
  y[3] := 0;
  y[4] := v14;
  y[5] := v13*v16;
  y[6] := v15 - v14*v16;
  y[7] := 2*(v13*(v13*v19) + v14*v19*v14) + v20;
  y[8] := v28 + v13*v31 + v14*v32;
  y[9] := v30 + v13*v32 - v14*v31;
  y[10] := 2*(-v15*v29) + gravity;
  y[11] := v36*cos(v37);
  y[12] := v36*sin(v37);
  y[13] := 0;
end ackermannMotion;
