// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Effects;
package BiasInstability "Bias instability, flicker noise"
  extends PyImu.Icons.EffectPackage;

  function biasInstabilityOutput "bias instability, flicker noise"
    extends Modelica.Icons.Function;
    input Real x[3], b_next[6,3];
    output Real y[3];
  algorithm
    y[1] := x[1] + (b_next[1,1] + b_next[2,1] + b_next[3,1] + b_next[4,1] + b_next[5,1] +
      b_next[6,1]);
    y[2] := x[2] + (b_next[1,2] + b_next[2,2] + b_next[3,2] + b_next[4,2] + b_next[5,2] +
      b_next[6,2]);
    y[3] := x[3] + (b_next[1,3] + b_next[2,3] + b_next[3,3] + b_next[4,3] + b_next[5,3] +
      b_next[6,3]);
  end biasInstabilityOutput;

  function biasInstabilityNextB "b of the next sample"
    extends Modelica.Icons.Function;
    input Real B[3], f_low, f_high, b[6,3], started, w[18], h;
    output Real following[6,3];
  protected
    Real v1, v2, v3, v4, v5, v6, v7, v8, v9, v10, v11, v12, v13, v14, v15, v16, v17, v18, v19,
      v20, v21, v22, v23, v24, v25, v26, v27, v28, v29, v30, v31, v32, v33, v34, v35, v36, v37,
      v38;
  algorithm
    v1 := 6.283185307179586*f_low;
    v2 := v1*h;
    v3 := exp(-v2);
    v4 := log(min(max(f_high/f_low, 100), 100000.0));
    v5 := v4/5;
    v6 := (0.535 + 1.363/v5)*v5/3.141592653589793;
    v7 := B[1]*B[1];
    v8 := v6*v7;
    v9 := PyImu.Math.expm1(-2*v2);
    v10 := if not started <> 0 then sqrt(v8) else 0;
    v11 := v1*exp(v5)*h;
    v12 := exp(-v11);
    v13 := v5/3.141592653589793;
    v14 := v13*v7;
    v15 := PyImu.Math.expm1(-2*v11);
    v16 := if not started <> 0 then sqrt(v14) else 0;
    v17 := v1*exp(2*v5)*h;
    v18 := exp(-v17);
    v19 := PyImu.Math.expm1(-2*v17);
    v20 := v1*exp(3*v5)*h;
    v21 := exp(-v20);
    v22 := PyImu.Math.expm1(-2*v20);
    v23 := v1*exp(4*v5)*h;
    v24 := exp(-v23);
    v25 := PyImu.Math.expm1(-2*v23);
    v26 := v1*exp(v4)*h;
    v27 := exp(-v26);
    v28 := PyImu.Math.expm1(-2*v26);
    v29 := B[2]*B[2];
    v30 := v6*v29;
    v31 := if not started <> 0 then sqrt(v30) else 0;
    v32 := v13*v29;
    v33 := if not started <> 0 then sqrt(v32) else 0;
    v34 := B[3]*B[3];
    v35 := v6*v34;
    v36 := if not started <> 0 then sqrt(v35) else 0;
    v37 := v13*v34;
    v38 := if not started <> 0 then sqrt(v37) else 0;
    following[1,1] := if started <> 0 then v3*b[1,1] + sqrt(-v8*v9)*w[1] else v10*w[1];
    following[2,1] := if started <> 0 then v12*b[2,1] + sqrt(-v14*v15)*w[4] else v16*w[4];
    following[3,1] := if started <> 0 then v18*b[3,1] + sqrt(-v14*v19)*w[7] else v16*w[7];
    following[4,1] := if started <> 0 then v21*b[4,1] + sqrt(-v14*v22)*w[10] else v16*w[10];
    following[5,1] := if started <> 0 then v24*b[5,1] + sqrt(-v14*v25)*w[13] else v16*w[13];
    following[6,1] := if started <> 0 then v27*b[6,1] + sqrt(-v8*v28)*w[16] else v10*w[16];
    following[1,2] := if started <> 0 then v3*b[1,2] + sqrt(-v30*v9)*w[2] else v31*w[2];
    following[2,2] := if started <> 0 then v12*b[2,2] + sqrt(-v32*v15)*w[5] else v33*w[5];
    following[3,2] := if started <> 0 then v18*b[3,2] + sqrt(-v32*v19)*w[8] else v33*w[8];
    following[4,2] := if started <> 0 then v21*b[4,2] + sqrt(-v32*v22)*w[11] else v33*w[11];
    following[5,2] := if started <> 0 then v24*b[5,2] + sqrt(-v32*v25)*w[14] else v33*w[14];
    following[6,2] := if started <> 0 then v27*b[6,2] + sqrt(-v30*v28)*w[17] else v31*w[17];
    following[1,3] := if started <> 0 then v3*b[1,3] + sqrt(-v35*v9)*w[3] else v36*w[3];
    following[2,3] := if started <> 0 then v12*b[2,3] + sqrt(-v37*v15)*w[6] else v38*w[6];
    following[3,3] := if started <> 0 then v18*b[3,3] + sqrt(-v37*v19)*w[9] else v38*w[9];
    following[4,3] := if started <> 0 then v21*b[4,3] + sqrt(-v37*v22)*w[12] else v38*w[12];
    following[5,3] := if started <> 0 then v24*b[5,3] + sqrt(-v37*v25)*w[15] else v38*w[15];
    following[6,3] := if started <> 0 then v27*b[6,3] + sqrt(-v35*v28)*w[18] else v36*w[18];
  end biasInstabilityNextB;

  function biasInstabilityBroken1 "True unless f_high does lie 2 to 5 decades above f_low"
    extends Modelica.Icons.Function;
    input Real f_low, f_high;
    output Boolean broken;
  protected
    Real v1;
  algorithm
    v1 := f_high/f_low;
    broken := v1 < 99.9999999 or v1 > 100000.0001;
  end biasInstabilityBroken1;

  block Gyro "Bias instability, flicker noise, of a gyro"
    extends PyImu.Interfaces.SampledEffect(x(each unit="rad/s"), y(each unit="rad/s"));
    parameter Real B[3](each unit="rad/s", each min=0) = fill(0, 3)
      "Coefficient of the 1/f noise; the Allan deviation's floor is 0.664 B";
    parameter Real f_low(unit="Hz", min=1e-12) = 1e-05
      "Lower end of the band in which the density is 1/f";
    parameter Real f_high(unit="Hz", min=1e-12) = 1
      "Upper end of that band, 2 to 5 decades above";
    Modelica.Blocks.Interfaces.RealInput w[18](each unit="1")
      "Standard normals, new ones at each sample"
      annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=-90,
      origin={0,120})));
  protected
    discrete Real b[6,3](each start=0, each fixed=true);
    discrete Real started(start=0, fixed=true);
  equation
    assert(min(B) >= 0, "bias_instability: B must not be below 0");
    assert(f_low >= 1e-12, "bias_instability: f_low must not be below 1e-12");
    assert(f_high >= 1e-12, "bias_instability: f_high must not be below 1e-12");
    assert(not biasInstabilityBroken1(f_low, f_high),
      "bias_instability: f_high must lie 2 to 5 decades above f_low");
    when sample(samplePeriod, samplePeriod) then
      b = biasInstabilityNextB(B, f_low, f_high, pre(b), pre(started), w, samplePeriod);
      y = biasInstabilityOutput(x, b);
      started = 1;
    end when;
  end Gyro;

  block Accel = Gyro(x(each unit="m/s2"), y(each unit="m/s2"), B(each unit="m/s2"))
    "Bias instability, flicker noise, of an accelerometer";

  annotation(Documentation(info="<html>
<p>Bias instability, flicker noise; stage: noise.</p>
<p>Equation (LaTeX): <code>y = x + \\sum_k b_k,\\; S(f) \\approx \\frac{B^2}{2 \\pi f}</code></p>
<p>Source: Hidalgo 2012, table 3 for the density; no source for this sum of Gauss-Markov processes,
one a decade.</p>
<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>
<tr><td>B</td><td>{y}</td><td>coefficient of the 1/f noise; the Allan deviation&#x27;s floor is
0.664 B</td></tr>
<tr><td>f_low</td><td>Hz</td><td>lower end of the band in which the density is 1/f</td></tr>
<tr><td>f_high</td><td>Hz</td><td>upper end of that band, 2 to 5 decades above</td></tr>
</table>
<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values of its
coefficients the effect is the identity.</p>
</html>"));
end BiasInstability;
