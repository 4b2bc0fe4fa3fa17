/* Generated from the block LowPass; do not edit. */
#include "model.h"

/* The functions as casadi writes them are private to this file. */
#ifndef CASADI_SYMBOL_EXPORT
#define CASADI_SYMBOL_EXPORT static
#endif
#ifdef __GNUC__
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#endif

/* How to prefix internal symbols */
#ifdef CASADI_CODEGEN_PREFIX
  #define CASADI_NAMESPACE_CONCAT(NS, ID) _CASADI_NAMESPACE_CONCAT(NS, ID)
  #define _CASADI_NAMESPACE_CONCAT(NS, ID) NS ## ID
  #define CASADI_PREFIX(ID) CASADI_NAMESPACE_CONCAT(CODEGEN_PREFIX, ID)
#else
  #define CASADI_PREFIX(ID) LowPass_ ## ID
#endif

#include <math.h>

#ifndef casadi_real
#define casadi_real double
#endif

#ifndef casadi_int
#define casadi_int long long int
#endif

/* Add prefix to internal symbols */
#define casadi_f0 CASADI_PREFIX(f0)
#define casadi_f1 CASADI_PREFIX(f1)
#define casadi_f2 CASADI_PREFIX(f2)
#define casadi_fabs CASADI_PREFIX(fabs)
#define casadi_fmax CASADI_PREFIX(fmax)
#define casadi_s0 CASADI_PREFIX(s0)
#define casadi_s1 CASADI_PREFIX(s1)
#define casadi_s2 CASADI_PREFIX(s2)
#define casadi_s3 CASADI_PREFIX(s3)
#define casadi_sq CASADI_PREFIX(sq)

/* Symbol visibility in DLLs */
#ifndef CASADI_SYMBOL_EXPORT
  #if defined(_WIN32) || defined(__WIN32__) || defined(__CYGWIN__)
    #if defined(STATIC_LINKED)
      #define CASADI_SYMBOL_EXPORT
    #else
      #define CASADI_SYMBOL_EXPORT __declspec(dllexport)
    #endif
  #elif defined(__GNUC__) && defined(GCC_HASCLASSVISIBILITY)
    #define CASADI_SYMBOL_EXPORT __attribute__ ((visibility ("default")))
  #else
    #define CASADI_SYMBOL_EXPORT
  #endif
#endif

casadi_real casadi_fabs(casadi_real x) {
/* Pre-c99 compatibility */
#if __STDC_VERSION__ < 199901L
  return x>0 ? x : -x;
#else
  return fabs(x);
#endif
}

#ifndef casadi_inf
  #define casadi_inf INFINITY
#endif

casadi_real casadi_fmax(casadi_real x, casadi_real y) {
/* Pre-c99 compatibility */
#if __STDC_VERSION__ < 199901L
  return x>y ? x : y;
#else
  return x >= y || y != y ? x : y;
#endif
}

casadi_real casadi_sq(casadi_real x) { return x*x;}

/* Configuration this file was compiled with */
CASADI_SYMBOL_EXPORT void LowPass_casadi_version(int* major, int* minor, int* patch) {
  *major = 3;
  *minor = 8;
  *patch = 2;
}
CASADI_SYMBOL_EXPORT int LowPass_casadi_int_size(void) { return (int) sizeof(casadi_int); }
CASADI_SYMBOL_EXPORT int LowPass_casadi_real_size(void) { return (int) sizeof(casadi_real); }

static const casadi_int casadi_s0[3] = {30, 1, 1};
static const casadi_int casadi_s1[3] = {6, 1, 1};
static const casadi_int casadi_s2[3] = {1, 1, 1};
static const casadi_int casadi_s3[3] = {0, 1, 1};

/* step:(s[30],u[6],p,w[0],h)->(s_next[30],y[6]) */
static int casadi_f0(const casadi_real** arg, casadi_real** res, casadi_int* iw, casadi_real* w, int mem) {
  casadi_real a00, a01, a02, a03, a04, a05, a06, a07, a08, a09, a10, a11;
  casadi_real a12, a13, a14, a15, a16, a17, a18, a19, a20, a21, a22, a23;
  casadi_real a24, a25, a26, a27, a28, a29, a30, a31, a32, a33, a34, a35;
  casadi_real a36, a37, a38, a39, a40, a41, a42, a43, a44, a45, a46, a47;
  casadi_real a48, a49, a50, a51, a52, a53, a54, a55, a56, a57;
  a00=arg[0][0];
  a01=arg[1][0];
  a02=casadi_fabs(a01);
  a03=casadi_inf;
  a02=(a02<a03);
  a04=casadi_fmax(a00,a02);
  if (res[0]!=0) res[0][0]=a04;
  a04=arg[0][1];
  a05=arg[1][1];
  a06=casadi_fabs(a05);
  a06=(a06<a03);
  a07=casadi_fmax(a04,a06);
  if (res[0]!=0) res[0][1]=a07;
  a07=arg[0][2];
  a08=arg[1][2];
  a09=casadi_fabs(a08);
  a09=(a09<a03);
  a10=casadi_fmax(a07,a09);
  if (res[0]!=0) res[0][2]=a10;
  a10=arg[0][3];
  a11=arg[1][3];
  a12=casadi_fabs(a11);
  a12=(a12<a03);
  a13=casadi_fmax(a10,a12);
  if (res[0]!=0) res[0][3]=a13;
  a13=arg[0][4];
  a14=arg[1][4];
  a15=casadi_fabs(a14);
  a15=(a15<a03);
  a16=casadi_fmax(a13,a15);
  if (res[0]!=0) res[0][4]=a16;
  a16=arg[0][5];
  a17=arg[1][5];
  a18=casadi_fabs(a17);
  a18=(a18<a03);
  a03=casadi_fmax(a16,a18);
  if (res[0]!=0) res[0][5]=a03;
  a03=(a02?a01:0);
  a19=(!a02);
  a00=(!a00);
  a00=(a00?a02:0);
  a20=(a00?a01:0);
  a21=(!a00);
  a22=arg[0][6];
  a21=(a21?a22:0);
  a20=(a20+a21);
  a19=(a19?a20:0);
  a03=(a03+a19);
  if (res[0]!=0) res[0][6]=a03;
  a19=(a06?a05:0);
  a21=(!a06);
  a04=(!a04);
  a04=(a04?a06:0);
  a22=(a04?a05:0);
  a23=(!a04);
  a24=arg[0][7];
  a23=(a23?a24:0);
  a22=(a22+a23);
  a21=(a21?a22:0);
  a19=(a19+a21);
  if (res[0]!=0) res[0][7]=a19;
  a21=(a09?a08:0);
  a23=(!a09);
  a07=(!a07);
  a07=(a07?a09:0);
  a24=(a07?a08:0);
  a25=(!a07);
  a26=arg[0][8];
  a25=(a25?a26:0);
  a24=(a24+a25);
  a23=(a23?a24:0);
  a21=(a21+a23);
  if (res[0]!=0) res[0][8]=a21;
  a23=(a12?a11:0);
  a25=(!a12);
  a10=(!a10);
  a10=(a10?a12:0);
  a26=(a10?a11:0);
  a27=(!a10);
  a28=arg[0][9];
  a27=(a27?a28:0);
  a26=(a26+a27);
  a25=(a25?a26:0);
  a23=(a23+a25);
  if (res[0]!=0) res[0][9]=a23;
  a25=(a15?a14:0);
  a27=(!a15);
  a13=(!a13);
  a13=(a13?a15:0);
  a28=(a13?a14:0);
  a29=(!a13);
  a30=arg[0][10];
  a29=(a29?a30:0);
  a28=(a28+a29);
  a27=(a27?a28:0);
  a25=(a25+a27);
  if (res[0]!=0) res[0][10]=a25;
  a27=(a18?a17:0);
  a29=(!a18);
  a16=(!a16);
  a16=(a16?a18:0);
  a30=(a16?a17:0);
  a31=(!a16);
  a32=arg[0][11];
  a31=(a31?a32:0);
  a30=(a30+a31);
  a29=(a29?a30:0);
  a27=(a27+a29);
  if (res[0]!=0) res[0][11]=a27;
  if (res[0]!=0) res[0][12]=a20;
  if (res[0]!=0) res[0][13]=a22;
  if (res[0]!=0) res[0][14]=a24;
  if (res[0]!=0) res[0][15]=a26;
  if (res[0]!=0) res[0][16]=a28;
  if (res[0]!=0) res[0][17]=a30;
  a29=0.;
  a31=arg[2][0];
  a29=(a29<a31);
  a32=1.;
  a33=2.;
  a34=6.3661977236758138e-01;
  a35=6.2831853071795862e+00;
  a35=(a35*a31);
  a31=arg[4][0];
  a35=(a35*a31);
  a35=(a35/a33);
  a31=(a34*a35);
  a36=5.0000000000000000e-01;
  a31=(a31+a36);
  a31=floor(a31);
  a37=4.;
  a38=(a31/a37);
  a38=floor(a38);
  a38=(a37*a38);
  a38=(a31-a38);
  a39=(a33<=a38);
  a39=(2.*a39);
  a39=(a32-a39);
  a40=(a38/a33);
  a40=floor(a40);
  a40=(2.*a40);
  a38=(a38-a40);
  a40=1.5707962512969971e+00;
  a41=(a40*a31);
  a41=(a35-a41);
  a42=7.5497894158615964e-08;
  a43=(a42*a31);
  a41=(a41-a43);
  a43=5.3903028581581190e-15;
  a31=(a43*a31);
  a41=(a41-a31);
  a31=casadi_sq(a41);
  a44=(a31/a33);
  a44=(a32-a44);
  a45=casadi_sq(a31);
  a46=-1.1358536521387682e-11;
  a47=(a46*a31);
  a48=2.0875700841974730e-09;
  a47=(a47+a48);
  a47=(a47*a31);
  a49=-2.7557314179296740e-07;
  a47=(a47+a49);
  a47=(a47*a31);
  a50=2.4801587288851704e-05;
  a47=(a47+a50);
  a47=(a47*a31);
  a51=-1.3888888888873056e-03;
  a47=(a47+a51);
  a47=(a47*a31);
  a52=4.1666666666666595e-02;
  a47=(a47+a52);
  a45=(a45*a47);
  a44=(a44+a45);
  a44=(a38?a44:0);
  a38=(!a38);
  a45=1.5896230157654656e-10;
  a47=(a45*a31);
  a53=-2.5050747762857807e-08;
  a47=(a47+a53);
  a47=(a47*a31);
  a54=2.7557313621385722e-06;
  a47=(a47+a54);
  a47=(a47*a31);
  a55=-1.9841269829589539e-04;
  a47=(a47+a55);
  a47=(a47*a31);
  a56=8.3333333333221182e-03;
  a47=(a47+a56);
  a47=(a47*a31);
  a57=-1.6666666666666630e-01;
  a47=(a47+a57);
  a31=(a31*a47);
  a31=(a41*a31);
  a41=(a41+a31);
  a38=(a38?a41:0);
  a44=(a44+a38);
  a39=(a39*a44);
  a34=(a34*a35);
  a34=(a34+a36);
  a34=floor(a34);
  a36=(a34+a32);
  a44=(a36/a37);
  a44=floor(a44);
  a37=(a37*a44);
  a36=(a36-a37);
  a37=(a33<=a36);
  a37=(2.*a37);
  a37=(a32-a37);
  a44=(a36/a33);
  a44=floor(a44);
  a44=(2.*a44);
  a36=(a36-a44);
  a40=(a40*a34);
  a35=(a35-a40);
  a42=(a42*a34);
  a35=(a35-a42);
  a43=(a43*a34);
  a35=(a35-a43);
  a43=casadi_sq(a35);
  a33=(a43/a33);
  a33=(a32-a33);
  a34=casadi_sq(a43);
  a46=(a46*a43);
  a46=(a46+a48);
  a46=(a46*a43);
  a46=(a46+a49);
  a46=(a46*a43);
  a46=(a46+a50);
  a46=(a46*a43);
  a46=(a46+a51);
  a46=(a46*a43);
  a46=(a46+a52);
  a34=(a34*a46);
  a33=(a33+a34);
  a33=(a36?a33:0);
  a36=(!a36);
  a45=(a45*a43);
  a45=(a45+a53);
  a45=(a45*a43);
  a45=(a45+a54);
  a45=(a45*a43);
  a45=(a45+a55);
  a45=(a45*a43);
  a45=(a45+a56);
  a45=(a45*a43);
  a45=(a45+a57);
  a43=(a43*a45);
  a43=(a35*a43);
  a35=(a35+a43);
  a36=(a36?a35:0);
  a33=(a33+a36);
  a37=(a37*a33);
  a39=(a39/a37);
  a37=casadi_sq(a39);
  a33=1.4142135623730951e+00;
  a36=(a33*a39);
  a36=(a32+a36);
  a35=casadi_sq(a39);
  a36=(a36+a35);
  a37=(a37/a36);
  a35=(a37*a03);
  a43=(2.*a37);
  a20=(a43*a20);
  a35=(a35+a20);
  a20=(a00?a01:0);
  a45=(!a00);
  a57=arg[0][12];
  a45=(a45?a57:0);
  a20=(a20+a45);
  a20=(a37*a20);
  a35=(a35+a20);
  a20=casadi_sq(a39);
  a20=(a20-a32);
  a20=(2.*a20);
  a20=(a20/a36);
  a45=(a00?a01:0);
  a57=(!a00);
  a56=arg[0][18];
  a57=(a57?a56:0);
  a45=(a45+a57);
  a57=(a20*a45);
  a35=(a35-a57);
  a33=(a33*a39);
  a32=(a32-a33);
  a39=casadi_sq(a39);
  a32=(a32+a39);
  a32=(a32/a36);
  a36=(a00?a01:0);
  a00=(!a00);
  a39=arg[0][24];
  a00=(a00?a39:0);
  a36=(a36+a00);
  a36=(a32*a36);
  a35=(a35-a36);
  a35=(a29?a35:0);
  a36=(!a29);
  a03=(a36?a03:0);
  a35=(a35+a03);
  if (res[0]!=0) res[0][18]=a35;
  a03=(a37*a19);
  a22=(a43*a22);
  a03=(a03+a22);
  a22=(a04?a05:0);
  a00=(!a04);
  a39=arg[0][13];
  a00=(a00?a39:0);
  a22=(a22+a00);
  a22=(a37*a22);
  a03=(a03+a22);
  a22=(a04?a05:0);
  a00=(!a04);
  a39=arg[0][19];
  a00=(a00?a39:0);
  a22=(a22+a00);
  a00=(a20*a22);
  a03=(a03-a00);
  a00=(a04?a05:0);
  a04=(!a04);
  a39=arg[0][25];
  a04=(a04?a39:0);
  a00=(a00+a04);
  a00=(a32*a00);
  a03=(a03-a00);
  a03=(a29?a03:0);
  a19=(a36?a19:0);
  a03=(a03+a19);
  if (res[0]!=0) res[0][19]=a03;
  a19=(a37*a21);
  a24=(a43*a24);
  a19=(a19+a24);
  a24=(a07?a08:0);
  a00=(!a07);
  a04=arg[0][14];
  a00=(a00?a04:0);
  a24=(a24+a00);
  a24=(a37*a24);
  a19=(a19+a24);
  a24=(a07?a08:0);
  a00=(!a07);
  a04=arg[0][20];
  a00=(a00?a04:0);
  a24=(a24+a00);
  a00=(a20*a24);
  a19=(a19-a00);
  a00=(a07?a08:0);
  a07=(!a07);
  a04=arg[0][26];
  a07=(a07?a04:0);
  a00=(a00+a07);
  a00=(a32*a00);
  a19=(a19-a00);
  a19=(a29?a19:0);
  a21=(a36?a21:0);
  a19=(a19+a21);
  if (res[0]!=0) res[0][20]=a19;
  a21=(a37*a23);
  a26=(a43*a26);
  a21=(a21+a26);
  a26=(a10?a11:0);
  a00=(!a10);
  a07=arg[0][15];
  a00=(a00?a07:0);
  a26=(a26+a00);
  a26=(a37*a26);
  a21=(a21+a26);
  a26=(a10?a11:0);
  a00=(!a10);
  a07=arg[0][21];
  a00=(a00?a07:0);
  a26=(a26+a00);
  a00=(a20*a26);
  a21=(a21-a00);
  a00=(a10?a11:0);
  a10=(!a10);
  a07=arg[0][27];
  a10=(a10?a07:0);
  a00=(a00+a10);
  a00=(a32*a00);
  a21=(a21-a00);
  a21=(a29?a21:0);
  a23=(a36?a23:0);
  a21=(a21+a23);
  if (res[0]!=0) res[0][21]=a21;
  a23=(a37*a25);
  a28=(a43*a28);
  a23=(a23+a28);
  a28=(a13?a14:0);
  a00=(!a13);
  a10=arg[0][16];
  a00=(a00?a10:0);
  a28=(a28+a00);
  a28=(a37*a28);
  a23=(a23+a28);
  a28=(a13?a14:0);
  a00=(!a13);
  a10=arg[0][22];
  a00=(a00?a10:0);
  a28=(a28+a00);
  a00=(a20*a28);
  a23=(a23-a00);
  a00=(a13?a14:0);
  a13=(!a13);
  a10=arg[0][28];
  a13=(a13?a10:0);
  a00=(a00+a13);
  a00=(a32*a00);
  a23=(a23-a00);
  a23=(a29?a23:0);
  a25=(a36?a25:0);
  a23=(a23+a25);
  if (res[0]!=0) res[0][22]=a23;
  a25=(a37*a27);
  a43=(a43*a30);
  a25=(a25+a43);
  a43=(a16?a17:0);
  a30=(!a16);
  a00=arg[0][17];
  a30=(a30?a00:0);
  a43=(a43+a30);
  a37=(a37*a43);
  a25=(a25+a37);
  a37=(a16?a17:0);
  a43=(!a16);
  a30=arg[0][23];
  a43=(a43?a30:0);
  a37=(a37+a43);
  a20=(a20*a37);
  a25=(a25-a20);
  a20=(a16?a17:0);
  a16=(!a16);
  a43=arg[0][29];
  a16=(a16?a43:0);
  a20=(a20+a16);
  a32=(a32*a20);
  a25=(a25-a32);
  a29=(a29?a25:0);
  a36=(a36?a27:0);
  a29=(a29+a36);
  if (res[0]!=0) res[0][23]=a29;
  if (res[0]!=0) res[0][24]=a45;
  if (res[0]!=0) res[0][25]=a22;
  if (res[0]!=0) res[0][26]=a24;
  if (res[0]!=0) res[0][27]=a26;
  if (res[0]!=0) res[0][28]=a28;
  if (res[0]!=0) res[0][29]=a37;
  a35=(a02?a35:0);
  a02=(!a02);
  a02=(a02?a01:0);
  a35=(a35+a02);
  if (res[1]!=0) res[1][0]=a35;
  a03=(a06?a03:0);
  a06=(!a06);
  a06=(a06?a05:0);
  a03=(a03+a06);
  if (res[1]!=0) res[1][1]=a03;
  a19=(a09?a19:0);
  a09=(!a09);
  a09=(a09?a08:0);
  a19=(a19+a09);
  if (res[1]!=0) res[1][2]=a19;
  a21=(a12?a21:0);
  a12=(!a12);
  a12=(a12?a11:0);
  a21=(a21+a12);
  if (res[1]!=0) res[1][3]=a21;
  a23=(a15?a23:0);
  a15=(!a15);
  a15=(a15?a14:0);
  a23=(a23+a15);
  if (res[1]!=0) res[1][4]=a23;
  a29=(a18?a29:0);
  a18=(!a18);
  a18=(a18?a17:0);
  a29=(a29+a18);
  if (res[1]!=0) res[1][5]=a29;
  return 0;
}

CASADI_SYMBOL_EXPORT int step(const casadi_real** arg, casadi_real** res, casadi_int* iw, casadi_real* w, int mem){
  return casadi_f0(arg, res, iw, w, mem);
}

CASADI_SYMBOL_EXPORT int step_checkout(void) {
  return 0;
}

CASADI_SYMBOL_EXPORT void step_release(int mem) {
}

CASADI_SYMBOL_EXPORT void step_incref(void) {
}

CASADI_SYMBOL_EXPORT void step_decref(void) {
}

CASADI_SYMBOL_EXPORT casadi_int step_n_in(void) { return 5;}

CASADI_SYMBOL_EXPORT casadi_int step_n_out(void) { return 2;}

CASADI_SYMBOL_EXPORT casadi_real step_default_in(casadi_int i) {
  switch (i) {
    default: return 0;
  }
}

CASADI_SYMBOL_EXPORT const char* step_name_in(casadi_int i) {
  switch (i) {
    case 0: return "s";
    case 1: return "u";
    case 2: return "p";
    case 3: return "w";
    case 4: return "h";
    default: return 0;
  }
}

CASADI_SYMBOL_EXPORT const char* step_name_out(casadi_int i) {
  switch (i) {
    case 0: return "s_next";
    case 1: return "y";
    default: return 0;
  }
}

CASADI_SYMBOL_EXPORT const casadi_int* step_sparsity_in(casadi_int i) {
  switch (i) {
    case 0: return casadi_s0;
    case 1: return casadi_s1;
    case 2: return casadi_s2;
    case 3: return casadi_s3;
    case 4: return casadi_s2;
    default: return 0;
  }
}

CASADI_SYMBOL_EXPORT const casadi_int* step_sparsity_out(casadi_int i) {
  switch (i) {
    case 0: return casadi_s0;
    case 1: return casadi_s1;
    default: return 0;
  }
}

CASADI_SYMBOL_EXPORT int step_work(casadi_int *sz_arg, casadi_int* sz_res, casadi_int *sz_iw, casadi_int *sz_w) {
  if (sz_arg) *sz_arg = 5;
  if (sz_res) *sz_res = 2;
  if (sz_iw) *sz_iw = 0;
  if (sz_w) *sz_w = 0;
  return 0;
}

CASADI_SYMBOL_EXPORT int step_work_bytes(casadi_int *sz_arg, casadi_int* sz_res, casadi_int *sz_iw, casadi_int *sz_w) {
  if (sz_arg) *sz_arg = 5*sizeof(const casadi_real*);
  if (sz_res) *sz_res = 2*sizeof(casadi_real*);
  if (sz_iw) *sz_iw = 0*sizeof(casadi_int);
  if (sz_w) *sz_w = 0*sizeof(casadi_real);
  return 0;
}

/* initial:(u[6],p)->(s[30],y[6]) */
static int casadi_f1(const casadi_real** arg, casadi_real** res, casadi_int* iw, casadi_real* w, int mem) {
  casadi_real a0;
  a0=0.;
  if (res[0]!=0) res[0][0]=a0;
  if (res[0]!=0) res[0][1]=a0;
  if (res[0]!=0) res[0][2]=a0;
  if (res[0]!=0) res[0][3]=a0;
  if (res[0]!=0) res[0][4]=a0;
  if (res[0]!=0) res[0][5]=a0;
  if (res[0]!=0) res[0][6]=a0;
  if (res[0]!=0) res[0][7]=a0;
  if (res[0]!=0) res[0][8]=a0;
  if (res[0]!=0) res[0][9]=a0;
  if (res[0]!=0) res[0][10]=a0;
  if (res[0]!=0) res[0][11]=a0;
  if (res[0]!=0) res[0][12]=a0;
  if (res[0]!=0) res[0][13]=a0;
  if (res[0]!=0) res[0][14]=a0;
  if (res[0]!=0) res[0][15]=a0;
  if (res[0]!=0) res[0][16]=a0;
  if (res[0]!=0) res[0][17]=a0;
  if (res[0]!=0) res[0][18]=a0;
  if (res[0]!=0) res[0][19]=a0;
  if (res[0]!=0) res[0][20]=a0;
  if (res[0]!=0) res[0][21]=a0;
  if (res[0]!=0) res[0][22]=a0;
  if (res[0]!=0) res[0][23]=a0;
  if (res[0]!=0) res[0][24]=a0;
  if (res[0]!=0) res[0][25]=a0;
  if (res[0]!=0) res[0][26]=a0;
  if (res[0]!=0) res[0][27]=a0;
  if (res[0]!=0) res[0][28]=a0;
  if (res[0]!=0) res[0][29]=a0;
  a0=arg[0][0];
  if (res[1]!=0) res[1][0]=a0;
  a0=arg[0][1];
  if (res[1]!=0) res[1][1]=a0;
  a0=arg[0][2];
  if (res[1]!=0) res[1][2]=a0;
  a0=arg[0][3];
  if (res[1]!=0) res[1][3]=a0;
  a0=arg[0][4];
  if (res[1]!=0) res[1][4]=a0;
  a0=arg[0][5];
  if (res[1]!=0) res[1][5]=a0;
  return 0;
}

CASADI_SYMBOL_EXPORT int initial(const casadi_real** arg, casadi_real** res, casadi_int* iw, casadi_real* w, int mem){
  return casadi_f1(arg, res, iw, w, mem);
}

CASADI_SYMBOL_EXPORT int initial_checkout(void) {
  return 0;
}

CASADI_SYMBOL_EXPORT void initial_release(int mem) {
}

CASADI_SYMBOL_EXPORT void initial_incref(void) {
}

CASADI_SYMBOL_EXPORT void initial_decref(void) {
}

CASADI_SYMBOL_EXPORT casadi_int initial_n_in(void) { return 2;}

CASADI_SYMBOL_EXPORT casadi_int initial_n_out(void) { return 2;}

CASADI_SYMBOL_EXPORT casadi_real initial_default_in(casadi_int i) {
  switch (i) {
    default: return 0;
  }
}

CASADI_SYMBOL_EXPORT const char* initial_name_in(casadi_int i) {
  switch (i) {
    case 0: return "u";
    case 1: return "p";
    default: return 0;
  }
}

CASADI_SYMBOL_EXPORT const char* initial_name_out(casadi_int i) {
  switch (i) {
    case 0: return "s";
    case 1: return "y";
    default: return 0;
  }
}

CASADI_SYMBOL_EXPORT const casadi_int* initial_sparsity_in(casadi_int i) {
  switch (i) {
    case 0: return casadi_s1;
    case 1: return casadi_s2;
    default: return 0;
  }
}

CASADI_SYMBOL_EXPORT const casadi_int* initial_sparsity_out(casadi_int i) {
  switch (i) {
    case 0: return casadi_s0;
    case 1: return casadi_s1;
    default: return 0;
  }
}

CASADI_SYMBOL_EXPORT int initial_work(casadi_int *sz_arg, casadi_int* sz_res, casadi_int *sz_iw, casadi_int *sz_w) {
  if (sz_arg) *sz_arg = 2;
  if (sz_res) *sz_res = 2;
  if (sz_iw) *sz_iw = 0;
  if (sz_w) *sz_w = 0;
  return 0;
}

CASADI_SYMBOL_EXPORT int initial_work_bytes(casadi_int *sz_arg, casadi_int* sz_res, casadi_int *sz_iw, casadi_int *sz_w) {
  if (sz_arg) *sz_arg = 2*sizeof(const casadi_real*);
  if (sz_res) *sz_res = 2*sizeof(casadi_real*);
  if (sz_iw) *sz_iw = 0*sizeof(casadi_int);
  if (sz_w) *sz_w = 0*sizeof(casadi_real);
  return 0;
}

/* limits:(p,h)->(broken) */
static int casadi_f2(const casadi_real** arg, casadi_real** res, casadi_int* iw, casadi_real* w, int mem) {
  casadi_real a0, a1, a2;
  a0=1.;
  a1=arg[0][0];
  a1=(2.*a1);
  a2=arg[1][0];
  a1=(a1*a2);
  a0=(a0<=a1);
  if (res[0]!=0) res[0][0]=a0;
  return 0;
}

CASADI_SYMBOL_EXPORT int limits(const casadi_real** arg, casadi_real** res, casadi_int* iw, casadi_real* w, int mem){
  return casadi_f2(arg, res, iw, w, mem);
}

CASADI_SYMBOL_EXPORT int limits_checkout(void) {
  return 0;
}

CASADI_SYMBOL_EXPORT void limits_release(int mem) {
}

CASADI_SYMBOL_EXPORT void limits_incref(void) {
}

CASADI_SYMBOL_EXPORT void limits_decref(void) {
}

CASADI_SYMBOL_EXPORT casadi_int limits_n_in(void) { return 2;}

CASADI_SYMBOL_EXPORT casadi_int limits_n_out(void) { return 1;}

CASADI_SYMBOL_EXPORT casadi_real limits_default_in(casadi_int i) {
  switch (i) {
    default: return 0;
  }
}

CASADI_SYMBOL_EXPORT const char* limits_name_in(casadi_int i) {
  switch (i) {
    case 0: return "p";
    case 1: return "h";
    default: return 0;
  }
}

CASADI_SYMBOL_EXPORT const char* limits_name_out(casadi_int i) {
  switch (i) {
    case 0: return "broken";
    default: return 0;
  }
}

CASADI_SYMBOL_EXPORT const casadi_int* limits_sparsity_in(casadi_int i) {
  switch (i) {
    case 0: return casadi_s2;
    case 1: return casadi_s2;
    default: return 0;
  }
}

CASADI_SYMBOL_EXPORT const casadi_int* limits_sparsity_out(casadi_int i) {
  switch (i) {
    case 0: return casadi_s2;
    default: return 0;
  }
}

CASADI_SYMBOL_EXPORT int limits_work(casadi_int *sz_arg, casadi_int* sz_res, casadi_int *sz_iw, casadi_int *sz_w) {
  if (sz_arg) *sz_arg = 2;
  if (sz_res) *sz_res = 1;
  if (sz_iw) *sz_iw = 0;
  if (sz_w) *sz_w = 0;
  return 0;
}

CASADI_SYMBOL_EXPORT int limits_work_bytes(casadi_int *sz_arg, casadi_int* sz_res, casadi_int *sz_iw, casadi_int *sz_w) {
  if (sz_arg) *sz_arg = 2*sizeof(const casadi_real*);
  if (sz_res) *sz_res = 1*sizeof(casadi_real*);
  if (sz_iw) *sz_iw = 0*sizeof(casadi_int);
  if (sz_w) *sz_w = 0*sizeof(casadi_real);
  return 0;
}

/* What the core calls. */
int model_step(const double **arg, double **res, long long *iw, double *w) {
    return step(arg, res, iw, w, 0);
}

int model_initial(const double **arg, double **res, long long *iw, double *w) {
    return initial(arg, res, iw, w, 0);
}

int model_limits(const double **arg, double **res, long long *iw, double *w) {
    return limits(arg, res, iw, w, 0);
}
