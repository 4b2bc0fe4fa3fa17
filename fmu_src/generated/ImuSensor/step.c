/* Generated from the block ImuSensor; do not edit. */
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
  #define CASADI_PREFIX(ID) ImuSensor_ ## ID
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
#define casadi_s0 CASADI_PREFIX(s0)
#define casadi_s1 CASADI_PREFIX(s1)
#define casadi_s2 CASADI_PREFIX(s2)
#define casadi_s3 CASADI_PREFIX(s3)
#define casadi_s4 CASADI_PREFIX(s4)

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

/* Configuration this file was compiled with */
CASADI_SYMBOL_EXPORT void ImuSensor_casadi_version(int* major, int* minor, int* patch) {
  *major = 3;
  *minor = 8;
  *patch = 2;
}
CASADI_SYMBOL_EXPORT int ImuSensor_casadi_int_size(void) { return (int) sizeof(casadi_int); }
CASADI_SYMBOL_EXPORT int ImuSensor_casadi_real_size(void) { return (int) sizeof(casadi_real); }

static const casadi_int casadi_s0[3] = {3, 1, 1};
static const casadi_int casadi_s1[3] = {7, 1, 1};
static const casadi_int casadi_s2[3] = {10, 1, 1};
static const casadi_int casadi_s3[3] = {6, 1, 1};
static const casadi_int casadi_s4[3] = {1, 1, 1};

/* step:(s[3],u[7],p[10],w[6],h)->(s_next[3],y[7]) */
static int casadi_f0(const casadi_real** arg, casadi_real** res, casadi_int* iw, casadi_real* w, int mem) {
  const casadi_real *restrict i0=arg[0];
  const casadi_real *restrict i1=arg[1];
  const casadi_real *restrict i2=arg[2];
  const casadi_real *restrict i3=arg[3];
  const casadi_real *restrict i4=arg[4];
  casadi_real *restrict o0=res[0];
  casadi_real *restrict o1=res[1];
  const casadi_real v3=sqrt(i4[0]);
  const casadi_real v4=i2[7]*v3;
  const casadi_real v6=v4*i3[3];
  const casadi_real v7=i0[0]+v6;
  o0[0]=v7;
  const casadi_real v10=i2[8]*v3;
  const casadi_real v12=v10*i3[4];
  const casadi_real v13=i0[1]+v12;
  o0[1]=v13;
  const casadi_real v16=i2[9]*v3;
  const casadi_real v18=v16*i3[5];
  const casadi_real v19=i0[2]+v18;
  o0[2]=v19;
  o1[6]=i1[6];
  const casadi_real v24=i1[6]-i2[3];
  const casadi_real v25=i2[0]*v24;
  const casadi_real v26=i1[0]+v25;
  const casadi_real v29=i2[4]*i3[0];
  const casadi_real v30=sqrt(i4[0]);
  const casadi_real v31=v29/v30;
  const casadi_real v32=v26+v31;
  const casadi_real v33=v32+i0[0];
  o1[0]=v33;
  const casadi_real v36=i2[1]*v24;
  const casadi_real v37=i1[1]+v36;
  const casadi_real v40=i2[5]*i3[1];
  const casadi_real v41=v40/v30;
  const casadi_real v42=v37+v41;
  const casadi_real v43=v42+i0[1];
  o1[1]=v43;
  const casadi_real v46=i2[2]*v24;
  const casadi_real v47=i1[2]+v46;
  const casadi_real v50=i2[6]*i3[2];
  const casadi_real v51=v50/v30;
  const casadi_real v52=v47+v51;
  const casadi_real v53=v52+i0[2];
  o1[2]=v53;
  o1[3]=i1[3];
  o1[4]=i1[4];
  o1[5]=i1[5];
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
    case 4: return casadi_s4;
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

/* initial:(u[7],p[10])->(s[3],y[7]) */
static int casadi_f1(const casadi_real** arg, casadi_real** res, casadi_int* iw, casadi_real* w, int mem) {
  casadi_real a0;
  a0=0.;
  if (res[0]!=0) res[0][0]=a0;
  if (res[0]!=0) res[0][1]=a0;
  if (res[0]!=0) res[0][2]=a0;
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
  a0=arg[0][6];
  if (res[1]!=0) res[1][6]=a0;
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

/* What the core calls. */
int model_step(const double **arg, double **res, long long *iw, double *w) {
    return step(arg, res, iw, w, 0);
}

int model_initial(const double **arg, double **res, long long *iw, double *w) {
    return initial(arg, res, iw, w, 0);
}
