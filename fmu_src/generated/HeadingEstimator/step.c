/* Generated from the block HeadingEstimator; do not edit. */
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
  #define CASADI_PREFIX(ID) HeadingEstimator_ ## ID
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
#define casadi_fabs CASADI_PREFIX(fabs)
#define casadi_fmax CASADI_PREFIX(fmax)
#define casadi_fmin CASADI_PREFIX(fmin)
#define casadi_s0 CASADI_PREFIX(s0)
#define casadi_s1 CASADI_PREFIX(s1)
#define casadi_s2 CASADI_PREFIX(s2)
#define casadi_s3 CASADI_PREFIX(s3)
#define casadi_s4 CASADI_PREFIX(s4)
#define casadi_s5 CASADI_PREFIX(s5)
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

casadi_real casadi_sq(casadi_real x) { return x*x;}

casadi_real casadi_fmax(casadi_real x, casadi_real y) {
/* Pre-c99 compatibility */
#if __STDC_VERSION__ < 199901L
  return x>y ? x : y;
#else
  return x >= y || y != y ? x : y;
#endif
}

casadi_real casadi_fmin(casadi_real x, casadi_real y) {
/* Pre-c99 compatibility */
#if __STDC_VERSION__ < 199901L
  return x<y ? x : y;
#else
  return x <= y || y != y ? x : y;
#endif
}

/* Configuration this file was compiled with */
CASADI_SYMBOL_EXPORT void HeadingEstimator_casadi_version(int* major, int* minor, int* patch) {
  *major = 3;
  *minor = 8;
  *patch = 2;
}
CASADI_SYMBOL_EXPORT int HeadingEstimator_casadi_int_size(void) { return (int) sizeof(casadi_int); }
CASADI_SYMBOL_EXPORT int HeadingEstimator_casadi_real_size(void) { return (int) sizeof(casadi_real); }

static const casadi_int casadi_s0[3] = {51, 1, 1};
static const casadi_int casadi_s1[3] = {9, 1, 1};
static const casadi_int casadi_s2[3] = {18, 1, 1};
static const casadi_int casadi_s3[3] = {0, 1, 1};
static const casadi_int casadi_s4[3] = {1, 1, 1};
static const casadi_int casadi_s5[3] = {10, 1, 1};

/* step:(s[51],u[9],p[18],w[0],h)->(s_next[51],y[10]) */
static int casadi_f0(const casadi_real** arg, casadi_real** res, casadi_int* iw, casadi_real* w, int mem) {
  casadi_real a00, a01, a02, a03, a04, a05, a06, a07, a08, a09, a10, a11;
  casadi_real a12, a13, a14, a15, a16, a17, a18, a19, a20, a21, a22, a23;
  casadi_real a24, a25, a26, a27, a28, a29, a30, a31, a32, a33, a34, a35;
  casadi_real a36, a37, a38, a39, a40, a41, a42, a43, a44, a45, a46, a47;
  casadi_real a48, a49, a50, a51, a52, a53, a54, a55, a56, a57, a58, a59;
  casadi_real a60, a61, a62, a63, a64, a65, a66, a67, a68, a69, a70, a71;
  casadi_real a72, a73, a74, a75, a76, a77, a78, a79, a80, a81, a82, a83;
  casadi_real a84, a85, a86, a87, a88, a89, a90, a91;
  a00=5.0000000000000000e-01;
  a01=arg[1][6];
  a01=(a00<a01);
  a02=arg[1][5];
  a03=casadi_fabs(a02);
  a04=1000000.;
  a03=(a03<=a04);
  a03=(a01*a03);
  a05=arg[1][7];
  a06=casadi_fabs(a05);
  a06=(a06<=a04);
  a03=(a03*a06);
  a06=0.;
  a07=(a06<=a05);
  a03=(a03*a07);
  a07=arg[1][8];
  a08=(a00<a07);
  a09=arg[0][12];
  a10=casadi_sq(a09);
  a11=arg[0][13];
  a12=casadi_sq(a11);
  a10=(a10+a12);
  a12=arg[1][0];
  a13=casadi_fabs(a12);
  a13=(a13<=a04);
  a14=casadi_fabs(a12);
  a15=3.1415926535897931e+00;
  a16=arg[4][0];
  a17=(a15/a16);
  a14=(a14<=a17);
  a17=(a13*a14);
  a12=(a17?a12:0);
  a17=(!a17);
  a18=arg[0][42];
  a17=(a17?a18:0);
  a12=(a12+a17);
  a17=arg[0][50];
  a18=(a12-a17);
  a19=arg[2][14];
  a20=arg[1][4];
  a21=casadi_fabs(a20);
  a21=(a21<=a04);
  a20=(a21?a20:0);
  a22=(!a21);
  a23=arg[0][46];
  a22=(a22?a23:0);
  a20=(a20+a22);
  a22=arg[2][15];
  a22=(a20-a22);
  a19=(a19*a22);
  a18=(a18-a19);
  a19=casadi_fabs(a18);
  a19=(a19<=a04);
  a22=(a19?a18:0);
  a23=arg[0][14];
  a24=(a22-a23);
  a24=casadi_sq(a24);
  a10=(a10+a24);
  a24=arg[2][10];
  a25=casadi_sq(a24);
  a26=30.;
  a27=arg[2][16];
  a28=casadi_sq(a27);
  a29=1.0000000000000001e-18;
  a28=(a28+a29);
  a28=(a28/a16);
  a26=(a26*a28);
  a25=(a25+a26);
  a10=(a10<=a25);
  a25=1.;
  a26=arg[1][1];
  a30=casadi_fabs(a26);
  a30=(a30<=a04);
  a31=arg[1][2];
  a32=casadi_fabs(a31);
  a32=(a32<=a04);
  a33=(a30*a32);
  a34=arg[1][3];
  a35=casadi_fabs(a34);
  a35=(a35<=a04);
  a33=(a33*a35);
  a26=(a30?a26:0);
  a30=(!a30);
  a04=arg[0][43];
  a30=(a30?a04:0);
  a26=(a26+a30);
  a30=casadi_sq(a26);
  a31=(a32?a31:0);
  a32=(!a32);
  a04=arg[0][44];
  a32=(a32?a04:0);
  a31=(a31+a32);
  a32=casadi_sq(a31);
  a30=(a30+a32);
  a34=(a35?a34:0);
  a35=(!a35);
  a32=arg[0][45];
  a35=(a35?a32:0);
  a34=(a34+a35);
  a35=casadi_sq(a34);
  a30=(a30+a35);
  a30=(a06<a30);
  a33=(a33*a30);
  a33=(a25-a33);
  a30=(!a33);
  a35=(a30?a26:0);
  a32=arg[0][18];
  a04=(a35-a32);
  a04=casadi_sq(a04);
  a36=(a30?a31:0);
  a37=arg[0][19];
  a38=(a36-a37);
  a38=casadi_sq(a38);
  a04=(a04+a38);
  a30=(a30?a34:0);
  a38=arg[0][20];
  a39=(a30-a38);
  a39=casadi_sq(a39);
  a04=(a04+a39);
  a39=arg[2][11];
  a40=casadi_sq(a39);
  a41=3.0000000000000004e-07;
  a40=(a40+a41);
  a04=(a04<=a40);
  a10=(a10*a04);
  a04=arg[0][15];
  a40=(a04-a32);
  a40=casadi_sq(a40);
  a41=arg[0][16];
  a42=(a41-a37);
  a42=casadi_sq(a42);
  a40=(a40+a42);
  a42=arg[0][17];
  a43=(a42-a38);
  a43=casadi_sq(a43);
  a40=(a40+a43);
  a43=1.0000000000000001e-01;
  a43=(a43*a39);
  a43=casadi_sq(a43);
  a39=3.6818181818181830e-07;
  a39=(a39*a16);
  a43=(a43+a39);
  a40=(a40<=a43);
  a10=(a10*a40);
  a40=arg[0][9];
  a43=(a40-a09);
  a43=casadi_sq(a43);
  a39=arg[0][10];
  a44=(a39-a11);
  a44=casadi_sq(a44);
  a43=(a43+a44);
  a44=arg[0][11];
  a45=(a44-a23);
  a45=casadi_sq(a45);
  a43=(a43+a45);
  a24=(a00*a24);
  a24=casadi_sq(a24);
  a45=3.6818181818181827e+01;
  a45=(a45*a28);
  a45=(a45*a16);
  a24=(a24+a45);
  a43=(a43<=a24);
  a10=(a10*a43);
  a14=(a25-a14);
  a14=(a13*a14);
  a14=(a06<a14);
  a43=(a25-a14);
  a43=(a13*a43);
  a43=(a43*a19);
  a43=(a25-a43);
  a24=(a25-a43);
  a10=(a10*a24);
  a24=arg[2][9];
  a45=arg[0][22];
  a28=(a24<=a45);
  a28=(a10*a28);
  a46=arg[0][23];
  a28=(a28*a46);
  a47=(a06<a24);
  a48=(a00<a07);
  a48=(a25-a48);
  a47=(a47*a48);
  a28=(a28*a47);
  a08=casadi_fmax(a08,a28);
  a48=(a25-a43);
  a08=(a08*a48);
  a48=(a10<a46);
  a47=(a47*a48);
  a48=arg[0][24];
  a49=(a47?a48:0);
  a50=(!a47);
  a51=arg[0][0];
  a51=(a50?a51:0);
  a49=(a49+a51);
  a51=(a00<a07);
  a51=(a25-a51);
  a52=casadi_sq(a27);
  a52=(a52+a29);
  a53=3.;
  a54=arg[0][21];
  a55=(a45+a16);
  a55=(a10*a55);
  a56=casadi_fmax(a55,a16);
  a56=(a16/a56);
  a57=10.;
  a57=(a57+a16);
  a57=(a16/a57);
  a57=casadi_fmax(a56,a57);
  a58=2.7160493827160487e-01;
  a59=2.9999999999999999e-01;
  a60=(a59+a16);
  a60=(a16/a60);
  a60=casadi_fmax(a56,a60);
  a61=(a60*a40);
  a40=(a40-a61);
  a61=(a53+a16);
  a61=(a16/a61);
  a61=casadi_fmax(a56,a61);
  a62=(a61*a09);
  a09=(a09-a62);
  a62=(a40-a09);
  a62=casadi_sq(a62);
  a63=(a60*a39);
  a39=(a39-a63);
  a63=(a61*a11);
  a11=(a11-a63);
  a63=(a39-a11);
  a63=casadi_sq(a63);
  a62=(a62+a63);
  a63=(a22-a44);
  a60=(a60*a63);
  a44=(a44+a60);
  a22=(a22-a23);
  a61=(a61*a22);
  a23=(a23+a61);
  a61=(a44-a23);
  a61=casadi_sq(a61);
  a62=(a62+a61);
  a58=(a58*a62);
  a58=(a58-a54);
  a57=(a57*a58);
  a54=(a54+a57);
  a10=(a10*a54);
  a54=(a53*a10);
  a57=1.3000000000000000e+00;
  a58=(a57*a52);
  a58=(a54-a58);
  a58=casadi_fmax(a58,a06);
  a58=(a52+a58);
  a52=(a52/a58);
  a52=(a28*a52);
  a52=(a25-a52);
  a51=(a51*a52);
  a19=(a19?a18:0);
  a18=arg[0][25];
  a52=(a47?a18:0);
  a58=arg[0][1];
  a58=(a50?a58:0);
  a52=(a52+a58);
  a58=(a19-a52);
  a62=arg[0][26];
  a61=(a47?a62:0);
  a22=arg[0][2];
  a50=(a50?a22:0);
  a61=(a61+a50);
  a50=(a25+a61);
  a58=(a58/a50);
  a22=(a51*a58);
  a22=(a22*a16);
  a22=(a49+a22);
  a60=arg[0][28];
  a63=(a47?a60:0);
  a64=(!a47);
  a65=arg[0][4];
  a66=(a64?a65:0);
  a63=(a63+a66);
  a66=(a25-a43);
  a66=(a51*a66);
  a67=(a66/a50);
  a67=(a67*a16);
  a68=arg[0][29];
  a69=(a47?a68:0);
  a70=arg[0][5];
  a70=(a64?a70:0);
  a69=(a69+a70);
  a70=(a67*a69);
  a70=(a63-a70);
  a71=(a66/a50);
  a71=(a71*a58);
  a71=(a71*a16);
  a72=arg[0][31];
  a73=(a47?a72:0);
  a74=arg[0][7];
  a75=(a64?a74:0);
  a73=(a73+a75);
  a75=(a71*a73);
  a70=(a70-a75);
  a75=(a66/a50);
  a76=arg[2][17];
  a76=casadi_sq(a76);
  a77=casadi_sq(a16);
  a77=(a76*a77);
  a78=2.;
  a77=(a77/a78);
  a75=(a75*a77);
  a77=(a70-a75);
  a78=(a76*a16);
  a79=1.0000000000000001e-20;
  a79=(a79*a16);
  a78=(a78+a79);
  a78=(a69+a78);
  a79=casadi_sq(a27);
  a79=(a79+a29);
  a80=casadi_sq(a27);
  a80=(a80+a29);
  a57=(a57*a80);
  a54=(a54-a57);
  a54=casadi_fmax(a54,a06);
  a54=(a28*a54);
  a79=(a79+a54);
  a79=(a79/a16);
  a54=(a00<a07);
  a57=arg[2][8];
  a57=casadi_sq(a57);
  a54=(a54*a57);
  a79=(a79+a54);
  a79=(a78+a79);
  a54=(a19-a52);
  a57=casadi_sq(a54);
  a80=25.;
  a57=(a57/a80);
  a57=casadi_fmax(a79,a57);
  a81=(a77/a57);
  a82=(a81*a54);
  a82=(a22+a82);
  a82=(a08?a82:0);
  a83=(!a08);
  a22=(a83?a22:0);
  a82=(a82+a22);
  a22=arg[0][27];
  a84=(a47?a22:0);
  a85=arg[0][3];
  a85=(a64?a85:0);
  a84=(a84+a85);
  a85=(a47?a60:0);
  a65=(a64?a65:0);
  a85=(a85+a65);
  a65=(a67*a85);
  a65=(a84-a65);
  a86=arg[0][30];
  a87=(a47?a86:0);
  a88=arg[0][6];
  a89=(a64?a88:0);
  a87=(a87+a89);
  a89=(a71*a87);
  a65=(a65-a89);
  a70=(a70*a67);
  a65=(a65-a70);
  a70=(a47?a86:0);
  a88=(a64?a88:0);
  a70=(a70+a88);
  a88=(a47?a72:0);
  a74=(a64?a74:0);
  a88=(a88+a74);
  a74=(a67*a88);
  a74=(a70-a74);
  a89=arg[0][32];
  a47=(a47?a89:0);
  a90=arg[0][8];
  a64=(a64?a90:0);
  a47=(a47+a64);
  a64=(a71*a47);
  a74=(a74-a64);
  a64=(a74*a71);
  a65=(a65-a64);
  a50=(1./a50);
  a50=casadi_sq(a50);
  a64=casadi_sq(a27);
  a64=(a64+a29);
  a64=(a64*a16);
  a90=casadi_sq(a16);
  a90=(a16*a90);
  a76=(a76*a90);
  a76=(a76/a53);
  a64=(a64+a76);
  a50=(a50*a64);
  a64=arg[2][7];
  a64=casadi_sq(a64);
  a58=casadi_sq(a58);
  a64=(a64*a58);
  a64=(a64*a16);
  a50=(a50+a64);
  a66=(a66*a50);
  a51=(a43*a51);
  a50=arg[2][12];
  a50=casadi_sq(a50);
  a64=arg[0][47];
  a64=(a64+a16);
  a64=(a43?a64:0);
  a58=casadi_fmin(a64,a25);
  a76=casadi_sq(a58);
  a43=(a43*a16);
  a43=(a64-a43);
  a90=casadi_fmin(a43,a25);
  a91=casadi_sq(a90);
  a76=(a76-a91);
  a58=(a64-a58);
  a43=(a43-a90);
  a58=(a58-a43);
  a58=(2.*a58);
  a76=(a76+a58);
  a50=(a50*a76);
  a51=(a51*a50);
  a66=(a66+a51);
  a65=(a65+a66);
  a66=(a81*a77);
  a66=(a65-a66);
  a66=(a08?a66:0);
  a51=(!a08);
  a65=(a51?a65:0);
  a66=(a66+a65);
  a05=(a03?a05:0);
  a65=9.9999999999999998e-13;
  a05=casadi_fmax(a05,a65);
  a05=(a66+a05);
  a02=(a02-a82);
  a65=6.2831853071795862e+00;
  a50=(a02+a15);
  a50=(a50/a65);
  a50=floor(a50);
  a50=(a65*a50);
  a02=(a02-a50);
  a50=casadi_sq(a02);
  a50=(a03?a50:0);
  a50=(a03?a50:0);
  a50=(a50/a80);
  a50=casadi_fmax(a05,a50);
  a76=(a66/a50);
  a58=(a76*a02);
  a58=(a03?a58:0);
  a58=(a82+a58);
  a58=(a03?a58:0);
  a43=(!a03);
  a82=(a43?a82:0);
  a58=(a58+a82);
  if (res[0]!=0) res[0][0]=a58;
  a82=(a78/a57);
  a90=(a82*a54);
  a90=(a52+a90);
  a90=(a08?a90:0);
  a91=(a83?a52:0);
  a90=(a90+a91);
  a91=(a69*a67);
  a85=(a85-a91);
  a91=(a88*a71);
  a85=(a85-a91);
  a85=(a85-a75);
  a75=(a82*a77);
  a75=(a85-a75);
  a75=(a08?a75:0);
  a85=(a51?a85:0);
  a75=(a75+a85);
  a85=(a75/a50);
  a91=(a85*a02);
  a91=(a03?a91:0);
  a91=(a90+a91);
  a91=(a03?a91:0);
  a90=(a43?a90:0);
  a91=(a91+a90);
  if (res[0]!=0) res[0][1]=a91;
  a90=(a73/a57);
  a54=(a90*a54);
  a54=(a61+a54);
  a54=(a08?a54:0);
  a83=(a83?a61:0);
  a54=(a54+a83);
  a67=(a73*a67);
  a87=(a87-a67);
  a71=(a47*a71);
  a87=(a87-a71);
  a71=(a90*a77);
  a71=(a87-a71);
  a71=(a08?a71:0);
  a87=(a51?a87:0);
  a71=(a71+a87);
  a87=(a71/a50);
  a02=(a87*a02);
  a02=(a03?a02:0);
  a02=(a54+a02);
  a02=(a03?a02:0);
  a43=(a43?a54:0);
  a02=(a02+a43);
  if (res[0]!=0) res[0][2]=a02;
  a43=(a76*a66);
  a43=(a66-a43);
  a43=(a03?a43:0);
  a54=(!a03);
  a66=(a54?a66:0);
  a43=(a43+a66);
  if (res[0]!=0) res[0][3]=a43;
  a66=(a81*a78);
  a66=(a77-a66);
  a66=(a08?a66:0);
  a77=(a51?a77:0);
  a66=(a66+a77);
  a77=(a76*a75);
  a77=(a66-a77);
  a77=(a03?a77:0);
  a66=(a54?a66:0);
  a77=(a77+a66);
  if (res[0]!=0) res[0][4]=a77;
  a77=(a82*a78);
  a77=(a78-a77);
  a77=(a08?a77:0);
  a78=(a51?a78:0);
  a77=(a77+a78);
  a75=(a85*a75);
  a75=(a77-a75);
  a75=(a03?a75:0);
  a77=(a54?a77:0);
  a75=(a75+a77);
  if (res[0]!=0) res[0][5]=a75;
  a81=(a81*a73);
  a81=(a74-a81);
  a81=(a08?a81:0);
  a74=(a51?a74:0);
  a81=(a81+a74);
  a76=(a76*a71);
  a76=(a81-a76);
  a76=(a03?a76:0);
  a81=(a54?a81:0);
  a76=(a76+a81);
  if (res[0]!=0) res[0][6]=a76;
  a82=(a82*a73);
  a82=(a88-a82);
  a82=(a08?a82:0);
  a76=(a51?a88:0);
  a82=(a82+a76);
  a85=(a85*a71);
  a85=(a82-a85);
  a85=(a03?a85:0);
  a82=(a54?a82:0);
  a85=(a85+a82);
  if (res[0]!=0) res[0][7]=a85;
  a85=arg[2][13];
  a85=casadi_sq(a85);
  a85=(a85*a16);
  a85=(a47+a85);
  a90=(a90*a73);
  a90=(a85-a90);
  a90=(a08?a90:0);
  a51=(a51?a85:0);
  a90=(a90+a51);
  a87=(a87*a71);
  a87=(a90-a87);
  a87=(a03?a87:0);
  a54=(a54?a90:0);
  a87=(a87+a54);
  if (res[0]!=0) res[0][8]=a87;
  if (res[0]!=0) res[0][9]=a40;
  if (res[0]!=0) res[0][10]=a39;
  if (res[0]!=0) res[0][11]=a44;
  if (res[0]!=0) res[0][12]=a09;
  if (res[0]!=0) res[0][13]=a11;
  if (res[0]!=0) res[0][14]=a23;
  a59=(a59+a16);
  a59=(a16/a59);
  a59=casadi_fmax(a56,a59);
  a44=(a35-a04);
  a44=(a59*a44);
  a04=(a04+a44);
  if (res[0]!=0) res[0][15]=a04;
  a04=(a36-a41);
  a04=(a59*a04);
  a41=(a41+a04);
  if (res[0]!=0) res[0][16]=a41;
  a41=(a30-a42);
  a59=(a59*a41);
  a42=(a42+a59);
  if (res[0]!=0) res[0][17]=a42;
  a53=(a53+a16);
  a16=(a16/a53);
  a56=casadi_fmax(a56,a16);
  a35=(a35-a32);
  a35=(a56*a35);
  a32=(a32+a35);
  if (res[0]!=0) res[0][18]=a32;
  a36=(a36-a37);
  a36=(a56*a36);
  a37=(a37+a36);
  if (res[0]!=0) res[0][19]=a37;
  a30=(a30-a38);
  a56=(a56*a30);
  a38=(a38+a56);
  if (res[0]!=0) res[0][20]=a38;
  if (res[0]!=0) res[0][21]=a10;
  if (res[0]!=0) res[0][22]=a55;
  a10=(a45<a24);
  a24=(a24<=a55);
  a10=(a10*a24);
  a09=casadi_sq(a09);
  a11=casadi_sq(a11);
  a09=(a09+a11);
  a11=50.;
  a27=casadi_sq(a27);
  a27=(a27+a29);
  a27=(a27/a55);
  a11=(a11*a27);
  a09=(a09<=a11);
  a23=(a23-a52);
  a23=casadi_sq(a23);
  a27=(a69+a27);
  a80=(a80*a27);
  a23=(a23<=a80);
  a09=(a09*a23);
  a09=(a10?a09:0);
  a10=(!a10);
  a23=(a06<a55);
  a46=(a46*a23);
  a10=(a10?a46:0);
  a09=(a09+a10);
  if (res[0]!=0) res[0][23]=a09;
  a09=3.3333333333333335e+00;
  a45=(a09*a45);
  a45=floor(a45);
  a09=(a09*a55);
  a09=floor(a09);
  a45=(a45<a09);
  a09=arg[0][33];
  a55=(a45?a09:0);
  a10=(!a45);
  a48=(a10?a48:0);
  a55=(a55+a48);
  if (res[0]!=0) res[0][24]=a55;
  a55=arg[0][34];
  a48=(a45?a55:0);
  a18=(a10?a18:0);
  a48=(a48+a18);
  if (res[0]!=0) res[0][25]=a48;
  a48=arg[0][35];
  a18=(a45?a48:0);
  a62=(a10?a62:0);
  a18=(a18+a62);
  if (res[0]!=0) res[0][26]=a18;
  a18=arg[0][36];
  a62=(a45?a18:0);
  a22=(a10?a22:0);
  a62=(a62+a22);
  if (res[0]!=0) res[0][27]=a62;
  a62=arg[0][37];
  a22=(a45?a62:0);
  a60=(a10?a60:0);
  a22=(a22+a60);
  if (res[0]!=0) res[0][28]=a22;
  a22=arg[0][38];
  a60=(a45?a22:0);
  a68=(a10?a68:0);
  a60=(a60+a68);
  if (res[0]!=0) res[0][29]=a60;
  a60=arg[0][39];
  a68=(a45?a60:0);
  a86=(a10?a86:0);
  a68=(a68+a86);
  if (res[0]!=0) res[0][30]=a68;
  a68=arg[0][40];
  a86=(a45?a68:0);
  a72=(a10?a72:0);
  a86=(a86+a72);
  if (res[0]!=0) res[0][31]=a86;
  a86=arg[0][41];
  a72=(a45?a86:0);
  a10=(a10?a89:0);
  a72=(a72+a10);
  if (res[0]!=0) res[0][32]=a72;
  a49=(a45?a49:0);
  a72=(!a45);
  a09=(a72?a09:0);
  a49=(a49+a09);
  if (res[0]!=0) res[0][33]=a49;
  a52=(a45?a52:0);
  a55=(a72?a55:0);
  a52=(a52+a55);
  if (res[0]!=0) res[0][34]=a52;
  a61=(a45?a61:0);
  a48=(a72?a48:0);
  a61=(a61+a48);
  if (res[0]!=0) res[0][35]=a61;
  a84=(a45?a84:0);
  a18=(a72?a18:0);
  a84=(a84+a18);
  if (res[0]!=0) res[0][36]=a84;
  a63=(a45?a63:0);
  a62=(a72?a62:0);
  a63=(a63+a62);
  if (res[0]!=0) res[0][37]=a63;
  a69=(a45?a69:0);
  a22=(a72?a22:0);
  a69=(a69+a22);
  if (res[0]!=0) res[0][38]=a69;
  a70=(a45?a70:0);
  a60=(a72?a60:0);
  a70=(a70+a60);
  if (res[0]!=0) res[0][39]=a70;
  a88=(a45?a88:0);
  a68=(a72?a68:0);
  a88=(a88+a68);
  if (res[0]!=0) res[0][40]=a88;
  a45=(a45?a47:0);
  a72=(a72?a86:0);
  a45=(a45+a72);
  if (res[0]!=0) res[0][41]=a45;
  if (res[0]!=0) res[0][42]=a12;
  if (res[0]!=0) res[0][43]=a26;
  if (res[0]!=0) res[0][44]=a31;
  if (res[0]!=0) res[0][45]=a34;
  if (res[0]!=0) res[0][46]=a20;
  if (res[0]!=0) res[0][47]=a64;
  a64=arg[0][48];
  if (res[0]!=0) res[0][48]=a64;
  a64=arg[0][49];
  if (res[0]!=0) res[0][49]=a64;
  if (res[0]!=0) res[0][50]=a17;
  a15=(a58+a15);
  a15=(a15/a65);
  a15=floor(a15);
  a65=(a65*a15);
  a65=(a58-a65);
  if (res[1]!=0) res[1][0]=a65;
  a43=casadi_fmax(a43,a06);
  a43=sqrt(a43);
  if (res[1]!=0) res[1][1]=a43;
  if (res[1]!=0) res[1][2]=a91;
  a75=casadi_fmax(a75,a06);
  a75=sqrt(a75);
  if (res[1]!=0) res[1][3]=a75;
  if (res[1]!=0) res[1][4]=a02;
  a87=casadi_fmax(a87,a06);
  a87=sqrt(a87);
  if (res[1]!=0) res[1][5]=a87;
  a19=(a19-a91);
  a02=(a25+a02);
  a19=(a19/a02);
  if (res[1]!=0) res[1][6]=a19;
  if (res[1]!=0) res[1][7]=a58;
  a58=(a00<a07);
  a58=casadi_fmax(a28,a58);
  if (res[1]!=0) res[1][8]=a58;
  a58=8.;
  a58=(a58*a08);
  a00=(a00<a07);
  a58=(a58*a00);
  a79=(a79<a57);
  a58=(a58*a79);
  a79=64.;
  a79=(a79*a03);
  a05=(a05<a50);
  a79=(a79*a05);
  a58=(a58+a79);
  a03=(a25-a03);
  a01=(a01*a03);
  a13=(a13*a21);
  a13=(a25-a13);
  a25=(a25-a13);
  a01=(a01*a25);
  a58=(a58+a01);
  a58=(a58+a13);
  a14=(2.*a14);
  a58=(a58+a14);
  a14=128.;
  a14=(a14*a28);
  a14=(a14*a33);
  a58=(a58+a14);
  if (res[1]!=0) res[1][9]=a58;
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
    case 1: return casadi_s5;
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

/* initial:(u[9],p[18])->(s[51],y[10]) */
static int casadi_f1(const casadi_real** arg, casadi_real** res, casadi_int* iw, casadi_real* w, int mem) {
  casadi_real a0, a1, a2, a3, a4, a5, a6, a7, a8;
  a0=arg[1][0];
  if (res[0]!=0) res[0][0]=a0;
  a1=arg[1][1];
  if (res[0]!=0) res[0][1]=a1;
  a2=arg[1][2];
  if (res[0]!=0) res[0][2]=a2;
  a3=arg[1][3];
  a3=casadi_sq(a3);
  if (res[0]!=0) res[0][3]=a3;
  a4=0.;
  if (res[0]!=0) res[0][4]=a4;
  a5=arg[1][4];
  a6=casadi_sq(a5);
  if (res[0]!=0) res[0][5]=a6;
  if (res[0]!=0) res[0][6]=a4;
  a7=arg[1][6];
  a7=(a7*a5);
  a5=arg[1][5];
  a7=(a7*a5);
  if (res[0]!=0) res[0][7]=a7;
  a5=casadi_sq(a5);
  if (res[0]!=0) res[0][8]=a5;
  if (res[0]!=0) res[0][9]=a4;
  if (res[0]!=0) res[0][10]=a4;
  if (res[0]!=0) res[0][11]=a4;
  if (res[0]!=0) res[0][12]=a4;
  if (res[0]!=0) res[0][13]=a4;
  if (res[0]!=0) res[0][14]=a4;
  if (res[0]!=0) res[0][15]=a4;
  if (res[0]!=0) res[0][16]=a4;
  if (res[0]!=0) res[0][17]=a4;
  if (res[0]!=0) res[0][18]=a4;
  if (res[0]!=0) res[0][19]=a4;
  if (res[0]!=0) res[0][20]=a4;
  if (res[0]!=0) res[0][21]=a4;
  if (res[0]!=0) res[0][22]=a4;
  if (res[0]!=0) res[0][23]=a4;
  if (res[0]!=0) res[0][24]=a0;
  if (res[0]!=0) res[0][25]=a1;
  if (res[0]!=0) res[0][26]=a2;
  if (res[0]!=0) res[0][27]=a3;
  if (res[0]!=0) res[0][28]=a4;
  if (res[0]!=0) res[0][29]=a6;
  if (res[0]!=0) res[0][30]=a4;
  if (res[0]!=0) res[0][31]=a7;
  if (res[0]!=0) res[0][32]=a5;
  if (res[0]!=0) res[0][33]=a0;
  if (res[0]!=0) res[0][34]=a1;
  if (res[0]!=0) res[0][35]=a2;
  if (res[0]!=0) res[0][36]=a3;
  if (res[0]!=0) res[0][37]=a4;
  if (res[0]!=0) res[0][38]=a6;
  if (res[0]!=0) res[0][39]=a4;
  if (res[0]!=0) res[0][40]=a7;
  if (res[0]!=0) res[0][41]=a5;
  if (res[0]!=0) res[0][42]=a4;
  if (res[0]!=0) res[0][43]=a4;
  if (res[0]!=0) res[0][44]=a4;
  a7=9.8066499999999994e+00;
  if (res[0]!=0) res[0][45]=a7;
  a7=25.;
  if (res[0]!=0) res[0][46]=a7;
  if (res[0]!=0) res[0][47]=a4;
  if (res[0]!=0) res[0][48]=a4;
  if (res[0]!=0) res[0][49]=a4;
  if (res[0]!=0) res[0][50]=a4;
  a7=6.2831853071795862e+00;
  a8=3.1415926535897931e+00;
  a8=(a0+a8);
  a8=(a8/a7);
  a8=floor(a8);
  a7=(a7*a8);
  a7=(a0-a7);
  if (res[1]!=0) res[1][0]=a7;
  a3=casadi_fmax(a3,a4);
  a3=sqrt(a3);
  if (res[1]!=0) res[1][1]=a3;
  if (res[1]!=0) res[1][2]=a1;
  a6=casadi_fmax(a6,a4);
  a6=sqrt(a6);
  if (res[1]!=0) res[1][3]=a6;
  if (res[1]!=0) res[1][4]=a2;
  a5=casadi_fmax(a5,a4);
  a5=sqrt(a5);
  if (res[1]!=0) res[1][5]=a5;
  a5=1.;
  a5=(a5+a2);
  a1=(a1/a5);
  a1=(-a1);
  if (res[1]!=0) res[1][6]=a1;
  if (res[1]!=0) res[1][7]=a0;
  if (res[1]!=0) res[1][8]=a4;
  if (res[1]!=0) res[1][9]=a4;
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
    case 1: return casadi_s5;
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
