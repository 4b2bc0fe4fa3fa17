// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package TimeDelay "Time delay, timestamp offset"
  extends PyImu.Icons.EffectPackage;

  function timeDelayOutput "time delay, timestamp offset"
    extends Modelica.Icons.Function;
    input Real x[3], td, past[32,3];
    input Boolean started;
    input Real h, past_next[32,3];
    output Real y[3];
  protected
    Real v1;
    Boolean v2;
    Real v3, v4, v5, v6, v7, v8, v9, v10, v11, v12, v13, v14, v15, v16, v17, v18, v19, v20, v21,
      v22, v23, v24, v25, v26, v27, v28, v29, v30, v31, v32, v33, v34, v35, v36, v37, v38, v39,
      v40, v41, v42, v43, v44, v45, v46, v47, v48, v49, v50, v51, v52, v53, v54, v55, v56, v57,
      v58, v59, v60, v61, v62, v63, v64, v65, v66, v67, v68, v69, v70, v71, v72, v73, v74, v75,
      v76, v77, v78, v79, v80, v81, v82, v83, v84, v85, v86, v87, v88, v89, v90, v91, v92, v93,
      v94, v95, v96, v97, v98, v99, v100, v101, v102, v103, v104, v105, v106, v107, v108, v109,
      v110, v111, v112, v113, v114, v115, v116, v117, v118, v119, v120, v121, v122, v123, v124,
      v125, v126, v127, v128, v129, v130, v131, v132, v133;
  algorithm
    v1 := min(max(td/h, 0), 30);
    v2 := v1 < 1;
    v3 := v1 - 1;
    v4 := v1 - 2;
    v5 := v1 - 3;
    v6 := abs(v1);
    v7 := 2 - v6;
    v8 := if v2 then -v3*v4/(-2)*v5/(-3) else if v6 < 1 then (1 - v1*v1)*v7/2 else if v6 < 2 then
      (1 - v6)*v7*(3 - v6)/6 else 0;
    v9 := abs(v3);
    v10 := 2 - v9;
    v11 := if v2 then -v1*v4*v5/(-2) else if v9 < 1 then (1 - v3*v3)*v10/2 else if v9 < 2 then (1
      - v9)*v10*(3 - v9)/6 else 0;
    v12 := abs(v4);
    v13 := 2 - v12;
    v14 := if v2 then -v1/2*v3*v5 else if v12 < 1 then (1 - v4*v4)*v13/2 else if v12 < 2 then (1 -
      v12)*v13*(3 - v12)/6 else 0;
    v15 := abs(v5);
    v16 := 2 - v15;
    v17 := if v2 then v1/3*v3/2*v4 else if v15 < 1 then (1 - v5*v5)*v16/2 else if v15 < 2 then (1
      - v15)*v16*(3 - v15)/6 else 0;
    v18 := v1 - 4;
    v19 := abs(v18);
    v20 := 2 - v19;
    v21 := if v19 < 1 then (1 - v18*v18)*v20/2 else if v19 < 2 then (1 - v19)*v20*(3 - v19)/6 else
      0;
    v22 := v1 - 5;
    v23 := abs(v22);
    v24 := 2 - v23;
    v25 := if v23 < 1 then (1 - v22*v22)*v24/2 else if v23 < 2 then (1 - v23)*v24*(3 - v23)/6 else
      0;
    v26 := v1 - 6;
    v27 := abs(v26);
    v28 := 2 - v27;
    v29 := if v27 < 1 then (1 - v26*v26)*v28/2 else if v27 < 2 then (1 - v27)*v28*(3 - v27)/6 else
      0;
    v30 := v1 - 7;
    v31 := abs(v30);
    v32 := 2 - v31;
    v33 := if v31 < 1 then (1 - v30*v30)*v32/2 else if v31 < 2 then (1 - v31)*v32*(3 - v31)/6 else
      0;
    v34 := v1 - 8;
    v35 := abs(v34);
    v36 := 2 - v35;
    v37 := if v35 < 1 then (1 - v34*v34)*v36/2 else if v35 < 2 then (1 - v35)*v36*(3 - v35)/6 else
      0;
    v38 := v1 - 9;
    v39 := abs(v38);
    v40 := 2 - v39;
    v41 := if v39 < 1 then (1 - v38*v38)*v40/2 else if v39 < 2 then (1 - v39)*v40*(3 - v39)/6 else
      0;
    v42 := v1 - 10;
    v43 := abs(v42);
    v44 := 2 - v43;
    v45 := if v43 < 1 then (1 - v42*v42)*v44/2 else if v43 < 2 then (1 - v43)*v44*(3 - v43)/6 else
      0;
    v46 := v1 - 11;
    v47 := abs(v46);
    v48 := 2 - v47;
    v49 := if v47 < 1 then (1 - v46*v46)*v48/2 else if v47 < 2 then (1 - v47)*v48*(3 - v47)/6 else
      0;
    v50 := v1 - 12;
    v51 := abs(v50);
    v52 := 2 - v51;
    v53 := if v51 < 1 then (1 - v50*v50)*v52/2 else if v51 < 2 then (1 - v51)*v52*(3 - v51)/6 else
      0;
    v54 := v1 - 13;
    v55 := abs(v54);
    v56 := 2 - v55;
    v57 := if v55 < 1 then (1 - v54*v54)*v56/2 else if v55 < 2 then (1 - v55)*v56*(3 - v55)/6 else
      0;
    v58 := v1 - 14;
    v59 := abs(v58);
    v60 := 2 - v59;
    v61 := if v59 < 1 then (1 - v58*v58)*v60/2 else if v59 < 2 then (1 - v59)*v60*(3 - v59)/6 else
      0;
    v62 := v1 - 15;
    v63 := abs(v62);
    v64 := 2 - v63;
    v65 := if v63 < 1 then (1 - v62*v62)*v64/2 else if v63 < 2 then (1 - v63)*v64*(3 - v63)/6 else
      0;
    v66 := v1 - 16;
    v67 := abs(v66);
    v68 := 2 - v67;
    v69 := if v67 < 1 then (1 - v66*v66)*v68/2 else if v67 < 2 then (1 - v67)*v68*(3 - v67)/6 else
      0;
    v70 := v1 - 17;
    v71 := abs(v70);
    v72 := 2 - v71;
    v73 := if v71 < 1 then (1 - v70*v70)*v72/2 else if v71 < 2 then (1 - v71)*v72*(3 - v71)/6 else
      0;
    v74 := v1 - 18;
    v75 := abs(v74);
    v76 := 2 - v75;
    v77 := if v75 < 1 then (1 - v74*v74)*v76/2 else if v75 < 2 then (1 - v75)*v76*(3 - v75)/6 else
      0;
    v78 := v1 - 19;
    v79 := abs(v78);
    v80 := 2 - v79;
    v81 := if v79 < 1 then (1 - v78*v78)*v80/2 else if v79 < 2 then (1 - v79)*v80*(3 - v79)/6 else
      0;
    v82 := v1 - 20;
    v83 := abs(v82);
    v84 := 2 - v83;
    v85 := if v83 < 1 then (1 - v82*v82)*v84/2 else if v83 < 2 then (1 - v83)*v84*(3 - v83)/6 else
      0;
    v86 := v1 - 21;
    v87 := abs(v86);
    v88 := 2 - v87;
    v89 := if v87 < 1 then (1 - v86*v86)*v88/2 else if v87 < 2 then (1 - v87)*v88*(3 - v87)/6 else
      0;
    v90 := v1 - 22;
    v91 := abs(v90);
    v92 := 2 - v91;
    v93 := if v91 < 1 then (1 - v90*v90)*v92/2 else if v91 < 2 then (1 - v91)*v92*(3 - v91)/6 else
      0;
    v94 := v1 - 23;
    v95 := abs(v94);
    v96 := 2 - v95;
    v97 := if v95 < 1 then (1 - v94*v94)*v96/2 else if v95 < 2 then (1 - v95)*v96*(3 - v95)/6 else
      0;
    v98 := v1 - 24;
    v99 := abs(v98);
    v100 := 2 - v99;
    v101 := if v99 < 1 then (1 - v98*v98)*v100/2 else if v99 < 2 then (1 - v99)*v100*(3 - v99)/6
      else 0;
    v102 := v1 - 25;
    v103 := abs(v102);
    v104 := 2 - v103;
    v105 := if v103 < 1 then (1 - v102*v102)*v104/2 else if v103 < 2 then (1 - v103)*v104*(3 -
      v103)/6 else 0;
    v106 := v1 - 26;
    v107 := abs(v106);
    v108 := 2 - v107;
    v109 := if v107 < 1 then (1 - v106*v106)*v108/2 else if v107 < 2 then (1 - v107)*v108*(3 -
      v107)/6 else 0;
    v110 := v1 - 27;
    v111 := abs(v110);
    v112 := 2 - v111;
    v113 := if v111 < 1 then (1 - v110*v110)*v112/2 else if v111 < 2 then (1 - v111)*v112*(3 -
      v111)/6 else 0;
    v114 := v1 - 28;
    v115 := abs(v114);
    v116 := 2 - v115;
    v117 := if v115 < 1 then (1 - v114*v114)*v116/2 else if v115 < 2 then (1 - v115)*v116*(3 -
      v115)/6 else 0;
    v118 := v1 - 29;
    v119 := abs(v118);
    v120 := 2 - v119;
    v121 := if v119 < 1 then (1 - v118*v118)*v120/2 else if v119 < 2 then (1 - v119)*v120*(3 -
      v119)/6 else 0;
    v122 := v1 - 30;
    v123 := abs(v122);
    v124 := 2 - v123;
    v125 := if v123 < 1 then (1 - v122*v122)*v124/2 else if v123 < 2 then (1 - v123)*v124*(3 -
      v123)/6 else 0;
    v126 := v1 - 31;
    v127 := abs(v126);
    v128 := 2 - v127;
    v129 := if v127 < 1 then (1 - v126*v126)*v128/2 else if v127 < 2 then (1 - v127)*v128*(3 -
      v127)/6 else 0;
    v130 := v1 - 32;
    v131 := abs(v130);
    v132 := 2 - v131;
    v133 := if v131 < 1 then (1 - v130*v130)*v132/2 else if v131 < 2 then (1 - v131)*v132*(3 -
      v131)/6 else 0;
    y[1] := if td > 0 then v8*x[1] + v11*past_next[2,1] + v14*past_next[3,1] + v17*past_next[4,1]
      + v21*past_next[5,1] + v25*past_next[6,1] + v29*past_next[7,1] + v33*past_next[8,1] +
      v37*past_next[9,1] + v41*past_next[10,1] + v45*past_next[11,1] + v49*past_next[12,1] +
      v53*past_next[13,1] + v57*past_next[14,1] + v61*past_next[15,1] + v65*past_next[16,1] +
      v69*past_next[17,1] + v73*past_next[18,1] + v77*past_next[19,1] + v81*past_next[20,1] +
      v85*past_next[21,1] + v89*past_next[22,1] + v93*past_next[23,1] + v97*past_next[24,1] +
      v101*past_next[25,1] + v105*past_next[26,1] + v109*past_next[27,1] + v113*past_next[28,1] +
      v117*past_next[29,1] + v121*past_next[30,1] + v125*past_next[31,1] + v129*past_next[32,1] +
      v133*(if started then past[32,1] else x[1]) else x[1];
    y[2] := if td > 0 then v8*x[2] + v11*past_next[2,2] + v14*past_next[3,2] + v17*past_next[4,2]
      + v21*past_next[5,2] + v25*past_next[6,2] + v29*past_next[7,2] + v33*past_next[8,2] +
      v37*past_next[9,2] + v41*past_next[10,2] + v45*past_next[11,2] + v49*past_next[12,2] +
      v53*past_next[13,2] + v57*past_next[14,2] + v61*past_next[15,2] + v65*past_next[16,2] +
      v69*past_next[17,2] + v73*past_next[18,2] + v77*past_next[19,2] + v81*past_next[20,2] +
      v85*past_next[21,2] + v89*past_next[22,2] + v93*past_next[23,2] + v97*past_next[24,2] +
      v101*past_next[25,2] + v105*past_next[26,2] + v109*past_next[27,2] + v113*past_next[28,2] +
      v117*past_next[29,2] + v121*past_next[30,2] + v125*past_next[31,2] + v129*past_next[32,2] +
      v133*(if started then past[32,2] else x[2]) else x[2];
    y[3] := if td > 0 then v8*x[3] + v11*past_next[2,3] + v14*past_next[3,3] + v17*past_next[4,3]
      + v21*past_next[5,3] + v25*past_next[6,3] + v29*past_next[7,3] + v33*past_next[8,3] +
      v37*past_next[9,3] + v41*past_next[10,3] + v45*past_next[11,3] + v49*past_next[12,3] +
      v53*past_next[13,3] + v57*past_next[14,3] + v61*past_next[15,3] + v65*past_next[16,3] +
      v69*past_next[17,3] + v73*past_next[18,3] + v77*past_next[19,3] + v81*past_next[20,3] +
      v85*past_next[21,3] + v89*past_next[22,3] + v93*past_next[23,3] + v97*past_next[24,3] +
      v101*past_next[25,3] + v105*past_next[26,3] + v109*past_next[27,3] + v113*past_next[28,3] +
      v117*past_next[29,3] + v121*past_next[30,3] + v125*past_next[31,3] + v129*past_next[32,3] +
      v133*(if started then past[32,3] else x[3]) else x[3];
  end timeDelayOutput;

  function timeDelayNextPast "past of the next sample"
    extends Modelica.Icons.Function;
    input Real x[3], past[32,3];
    input Boolean started;
    output Real following[32,3];
  algorithm
    following[1,1] := x[1];
    following[2,1] := if started then past[1,1] else x[1];
    following[3,1] := if started then past[2,1] else x[1];
    following[4,1] := if started then past[3,1] else x[1];
    following[5,1] := if started then past[4,1] else x[1];
    following[6,1] := if started then past[5,1] else x[1];
    following[7,1] := if started then past[6,1] else x[1];
    following[8,1] := if started then past[7,1] else x[1];
    following[9,1] := if started then past[8,1] else x[1];
    following[10,1] := if started then past[9,1] else x[1];
    following[11,1] := if started then past[10,1] else x[1];
    following[12,1] := if started then past[11,1] else x[1];
    following[13,1] := if started then past[12,1] else x[1];
    following[14,1] := if started then past[13,1] else x[1];
    following[15,1] := if started then past[14,1] else x[1];
    following[16,1] := if started then past[15,1] else x[1];
    following[17,1] := if started then past[16,1] else x[1];
    following[18,1] := if started then past[17,1] else x[1];
    following[19,1] := if started then past[18,1] else x[1];
    following[20,1] := if started then past[19,1] else x[1];
    following[21,1] := if started then past[20,1] else x[1];
    following[22,1] := if started then past[21,1] else x[1];
    following[23,1] := if started then past[22,1] else x[1];
    following[24,1] := if started then past[23,1] else x[1];
    following[25,1] := if started then past[24,1] else x[1];
    following[26,1] := if started then past[25,1] else x[1];
    following[27,1] := if started then past[26,1] else x[1];
    following[28,1] := if started then past[27,1] else x[1];
    following[29,1] := if started then past[28,1] else x[1];
    following[30,1] := if started then past[29,1] else x[1];
    following[31,1] := if started then past[30,1] else x[1];
    following[32,1] := if started then past[31,1] else x[1];
    following[1,2] := x[2];
    following[2,2] := if started then past[1,2] else x[2];
    following[3,2] := if started then past[2,2] else x[2];
    following[4,2] := if started then past[3,2] else x[2];
    following[5,2] := if started then past[4,2] else x[2];
    following[6,2] := if started then past[5,2] else x[2];
    following[7,2] := if started then past[6,2] else x[2];
    following[8,2] := if started then past[7,2] else x[2];
    following[9,2] := if started then past[8,2] else x[2];
    following[10,2] := if started then past[9,2] else x[2];
    following[11,2] := if started then past[10,2] else x[2];
    following[12,2] := if started then past[11,2] else x[2];
    following[13,2] := if started then past[12,2] else x[2];
    following[14,2] := if started then past[13,2] else x[2];
    following[15,2] := if started then past[14,2] else x[2];
    following[16,2] := if started then past[15,2] else x[2];
    following[17,2] := if started then past[16,2] else x[2];
    following[18,2] := if started then past[17,2] else x[2];
    following[19,2] := if started then past[18,2] else x[2];
    following[20,2] := if started then past[19,2] else x[2];
    following[21,2] := if started then past[20,2] else x[2];
    following[22,2] := if started then past[21,2] else x[2];
    following[23,2] := if started then past[22,2] else x[2];
    following[24,2] := if started then past[23,2] else x[2];
    following[25,2] := if started then past[24,2] else x[2];
    following[26,2] := if started then past[25,2] else x[2];
    following[27,2] := if started then past[26,2] else x[2];
    following[28,2] := if started then past[27,2] else x[2];
    following[29,2] := if started then past[28,2] else x[2];
    following[30,2] := if started then past[29,2] else x[2];
    following[31,2] := if started then past[30,2] else x[2];
    following[32,2] := if started then past[31,2] else x[2];
    following[1,3] := x[3];
    following[2,3] := if started then past[1,3] else x[3];
    following[3,3] := if started then past[2,3] else x[3];
    following[4,3] := if started then past[3,3] else x[3];
    following[5,3] := if started then past[4,3] else x[3];
    following[6,3] := if started then past[5,3] else x[3];
    following[7,3] := if started then past[6,3] else x[3];
    following[8,3] := if started then past[7,3] else x[3];
    following[9,3] := if started then past[8,3] else x[3];
    following[10,3] := if started then past[9,3] else x[3];
    following[11,3] := if started then past[10,3] else x[3];
    following[12,3] := if started then past[11,3] else x[3];
    following[13,3] := if started then past[12,3] else x[3];
    following[14,3] := if started then past[13,3] else x[3];
    following[15,3] := if started then past[14,3] else x[3];
    following[16,3] := if started then past[15,3] else x[3];
    following[17,3] := if started then past[16,3] else x[3];
    following[18,3] := if started then past[17,3] else x[3];
    following[19,3] := if started then past[18,3] else x[3];
    following[20,3] := if started then past[19,3] else x[3];
    following[21,3] := if started then past[20,3] else x[3];
    following[22,3] := if started then past[21,3] else x[3];
    following[23,3] := if started then past[22,3] else x[3];
    following[24,3] := if started then past[23,3] else x[3];
    following[25,3] := if started then past[24,3] else x[3];
    following[26,3] := if started then past[25,3] else x[3];
    following[27,3] := if started then past[26,3] else x[3];
    following[28,3] := if started then past[27,3] else x[3];
    following[29,3] := if started then past[28,3] else x[3];
    following[30,3] := if started then past[29,3] else x[3];
    following[31,3] := if started then past[30,3] else x[3];
    following[32,3] := if started then past[31,3] else x[3];
  end timeDelayNextPast;

  function timeDelayBroken1 "True unless td does not be above 30 sample periods"
    extends Modelica.Icons.Function;
    input Real td, h;
    output Boolean broken;
  algorithm
    broken := 30.000000030000002*h < td;
  end timeDelayBroken1;

  block Gyro "Time delay, timestamp offset, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real td(unit="s", min=0) = 0
      "Delay of the output behind the motion, at most 30 sample periods";
  protected
    discrete Real past[32,3](each start=0, each fixed=true);
    Boolean started(start=false, fixed=true);
  equation
    assert(td >= 0, "time_delay: td must not be below 0");
    assert(not timeDelayBroken1(td, samplePeriod),
      "time_delay: td must not be above 30 sample periods");
    when sample(samplePeriod, samplePeriod) then
      past = timeDelayNextPast(x, pre(past), pre(started));
      y = timeDelayOutput(x, td, pre(past), pre(started), samplePeriod, past);
      started = true;
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"))
    "Time delay, timestamp offset, of an accelerometer";

  annotation(Documentation(info="<html>
<p>Time delay, timestamp offset; stage: dynamics.</p>
<p>Equation (LaTeX): <code>y(t) = x(t - t_d)</code></p>
<p>Source: no source for the coefficient; third-order Lagrange interpolation between samples.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>td</td><td>s</td><td>delay of the output behind the motion, at most 30 sample
periods</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end TimeDelay;
