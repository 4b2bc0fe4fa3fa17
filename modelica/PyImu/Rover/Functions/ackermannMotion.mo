// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Rover.Functions;
function ackermannMotion "Ackermann: attitude (4), rate (3), specific force (3), position (3) at the time t"
  extends Modelica.Icons.Function;
  input Real t, startTime, heading0, rampTime, latitude, gravity, cruiseSpeed, radius, angle;
  output Real y[13];
protected
  Real v1, v2, v3, v4, v5, v6, v7, v8, v9, v10, v11, v12, v13, v14, v15, v16, v17, v18, v19,
    v20, v21, v22, v23, v24, v25, v26, v27, v28, v29, v30, v31, v32, v33, v34, v35, v36, v37,
    v38, v39, v40;
  Boolean v41;
  Real v42, v43, v44;
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
  v17 := v13*v16;
  v18 := v15 - v14*v16;
  v19 := v6*(10 + v5*(6*v5 - 15)) - v8*(10 + v7*(6*v7 - 15));
  v20 := v1*v19;
  v21 := 0.5*v20;
  v22 := 7.292115e-05*sin(latitude);
  v23 := 1 - v5;
  v24 := 1 - v7;
  v25 := cruiseSpeed*((30*v5*v5*v23*v23 - 30*v7*v7*v24*v24)*v4);
  v26 := cos(v11);
  v27 := cruiseSpeed*v19;
  v28 := v27*v20;
  v29 := sin(v11);
  v30 := v25*v26 - v28*v29;
  v31 := v25*v29 + v28*v26;
  v32 := 2*(v14*v31);
  v33 := 2*(-v14*v30);
  v34 := v27*v29;
  v35 := v27*v26;
  v36 := 2*(-v14*v35);
  v37 := 2*(v14*v34);
  v38 := v34 + v13*v36 - v14*v37;
  v39 := v35 + v13*v37 + v14*v36;
  v40 := v10*v10/4;
  v41 := v40 < 0.001;
  v42 := if not v41 then sqrt(if v41 then 1 else v40) else 0;
  v43 := cruiseSpeed*v9*(if v41 then 1 - v40/6*(1 - v40/20*(1 - v40/42)) else sin(v42)/v42);
  v44 := heading0 + v10/2;
  y[1] := v13;
  y[2] := 0;
  y[3] := 0;
  y[4] := v14;
  y[5] := v17;
  y[6] := v18;
  y[7] := 2*(v13*(v13*v21) + v14*v21*v14) + v22;
  y[8] := v30 + v13*v32 + v14*v33 + 2*(-v22*v38);
  y[9] := v31 + v13*v33 - v14*v32 + 2*(v22*v39);
  y[10] := gravity + 2*(v17*v38 - v18*v39);
  y[11] := v43*cos(v44);
  y[12] := v43*sin(v44);
  y[13] := 0;
  annotation(Documentation(info="<html>
<p>Hidalgo 2012, section 6.1. The speed rises and falls along 10 x^3 - 15 x^4 + 6 x^5. The rate
contains the Earth's rotation, the force gravity and Coriolis' force; printed from the unit
RoverDrive, on level ground and without vibration.</p>
</html>"));
end ackermannMotion;
