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

/* Configuration this file was compiled with */
CASADI_SYMBOL_EXPORT void HeadingEstimator_casadi_version(int* major, int* minor, int* patch) {
  *major = 3;
  *minor = 8;
  *patch = 2;
}
CASADI_SYMBOL_EXPORT int HeadingEstimator_casadi_int_size(void) { return (int) sizeof(casadi_int); }
CASADI_SYMBOL_EXPORT int HeadingEstimator_casadi_real_size(void) { return (int) sizeof(casadi_real); }

static const casadi_int casadi_s0[3] = {57, 1, 1};
static const casadi_int casadi_s1[3] = {9, 1, 1};
static const casadi_int casadi_s2[3] = {24, 1, 1};
static const casadi_int casadi_s3[3] = {0, 1, 1};
static const casadi_int casadi_s4[3] = {1, 1, 1};
static const casadi_int casadi_s5[3] = {10, 1, 1};

/* step:(s[57],u[9],p[24],w[0],h)->(s_next[57],y[10]) */
static int casadi_f0(const casadi_real** arg, casadi_real** res, casadi_int* iw, casadi_real* w, int mem) {
  casadi_real a00, a01, a02, a03, a04, a05, a06, a07, a08, a09, a10, a11;
  casadi_real a12, a13, a14, a15, a16, a17, a18, a19, a20, a21, a22, a23;
  casadi_real a24, a25, a26, a27, a28, a29, a30, a31, a32, a33, a34, a35;
  casadi_real a36, a37, a38, a39, a40, a41, a42, a43, a44, a45, a46, a47;
  casadi_real a48, a49, a50, a51, a52, a53, a54, a55, a56, a57, a58, a59;
  casadi_real a60, a61, a62, a63, a64, a65, a66, a67, a68, a69, a70, a71;
  casadi_real a72, a73, a74, a75, a76, a77, a78, a79, a80, a81, a82, a83;
  casadi_real a84, a85, a86, a87, a88, a89, a90, a91, a92;
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
  a12=1.;
  a13=arg[1][0];
  a14=casadi_fabs(a13);
  a14=(a14<=a04);
  a15=3.1415926535897931e+00;
  a16=arg[4][0];
  a17=(a15/a16);
  a13=(a14?a13:0);
  a18=(!a14);
  a19=arg[0][48];
  a18=(a18?a19:0);
  a13=(a13+a18);
  a18=arg[0][56];
  a19=(a13-a18);
  a20=arg[2][16];
  a21=arg[1][4];
  a22=casadi_fabs(a21);
  a22=(a22<=a04);
  a21=(a22?a21:0);
  a23=(!a22);
  a24=arg[0][52];
  a23=(a23?a24:0);
  a21=(a21+a23);
  a23=arg[2][17];
  a23=(a21-a23);
  a20=(a20*a23);
  a19=(a19-a20);
  a20=casadi_fabs(a19);
  a17=(a17<a20);
  a17=(a06<a17);
  a20=(a12-a17);
  a20=(a14*a20);
  a23=casadi_fabs(a19);
  a23=(a23<=a04);
  a20=(a20*a23);
  a20=(a12-a20);
  a23=(!a20);
  a24=(a23?a19:0);
  a25=arg[0][14];
  a26=(a24-a25);
  a26=casadi_sq(a26);
  a10=(a10+a26);
  a26=arg[2][10];
  a27=casadi_sq(a26);
  a28=30.;
  a29=arg[2][20];
  a30=casadi_sq(a29);
  a31=1.0000000000000001e-18;
  a30=(a30+a31);
  a30=(a30/a16);
  a28=(a28*a30);
  a27=(a27+a28);
  a10=(a10<=a27);
  a27=arg[1][1];
  a28=casadi_fabs(a27);
  a28=(a28<=a04);
  a32=arg[1][2];
  a33=casadi_fabs(a32);
  a33=(a33<=a04);
  a34=(a28*a33);
  a35=arg[1][3];
  a36=casadi_fabs(a35);
  a36=(a36<=a04);
  a34=(a34*a36);
  a27=(a28?a27:0);
  a28=(!a28);
  a04=arg[0][49];
  a28=(a28?a04:0);
  a27=(a27+a28);
  a28=casadi_sq(a27);
  a32=(a33?a32:0);
  a33=(!a33);
  a04=arg[0][50];
  a33=(a33?a04:0);
  a32=(a32+a33);
  a33=casadi_sq(a32);
  a28=(a28+a33);
  a35=(a36?a35:0);
  a36=(!a36);
  a33=arg[0][51];
  a36=(a36?a33:0);
  a35=(a35+a36);
  a36=casadi_sq(a35);
  a28=(a28+a36);
  a28=(a06<a28);
  a34=(a34*a28);
  a34=(a12-a34);
  a28=(!a34);
  a36=(a28?a27:0);
  a33=arg[0][18];
  a04=(a36-a33);
  a04=casadi_sq(a04);
  a37=(a28?a32:0);
  a38=arg[0][19];
  a39=(a37-a38);
  a39=casadi_sq(a39);
  a04=(a04+a39);
  a28=(a28?a35:0);
  a39=arg[0][20];
  a40=(a28-a39);
  a40=casadi_sq(a40);
  a04=(a04+a40);
  a40=arg[2][11];
  a41=casadi_sq(a40);
  a42=3.0000000000000004e-07;
  a41=(a41+a42);
  a04=(a04<=a41);
  a10=(a10*a04);
  a04=arg[0][15];
  a41=(a04-a33);
  a41=casadi_sq(a41);
  a42=arg[0][16];
  a43=(a42-a38);
  a43=casadi_sq(a43);
  a41=(a41+a43);
  a43=arg[0][17];
  a44=(a43-a39);
  a44=casadi_sq(a44);
  a41=(a41+a44);
  a44=1.0000000000000001e-01;
  a44=(a44*a40);
  a44=casadi_sq(a44);
  a40=3.6818181818181830e-07;
  a40=(a40*a16);
  a44=(a44+a40);
  a41=(a41<=a44);
  a10=(a10*a41);
  a41=arg[0][9];
  a44=(a41-a09);
  a44=casadi_sq(a44);
  a40=arg[0][10];
  a45=(a40-a11);
  a45=casadi_sq(a45);
  a44=(a44+a45);
  a45=arg[0][11];
  a46=(a45-a25);
  a46=casadi_sq(a46);
  a44=(a44+a46);
  a26=(a00*a26);
  a26=casadi_sq(a26);
  a46=3.6818181818181827e+01;
  a46=(a46*a30);
  a46=(a46*a16);
  a26=(a26+a46);
  a44=(a44<=a26);
  a10=(a10*a44);
  a44=(a12-a20);
  a10=(a10*a44);
  a44=arg[2][9];
  a26=arg[0][22];
  a46=(a44<=a26);
  a46=(a10*a46);
  a30=arg[0][23];
  a46=(a46*a30);
  a47=(a06<a44);
  a48=(a00<a07);
  a48=(a12-a48);
  a47=(a47*a48);
  a46=(a46*a47);
  a08=casadi_fmax(a08,a46);
  a48=(a12-a20);
  a08=(a08*a48);
  a48=(a10<a30);
  a47=(a47*a48);
  a48=arg[0][30];
  a49=(a47?a48:0);
  a50=(!a47);
  a51=arg[0][0];
  a51=(a50?a51:0);
  a49=(a49+a51);
  a51=(a00<a07);
  a51=(a12-a51);
  a52=casadi_sq(a29);
  a52=(a52+a31);
  a53=3.;
  a54=arg[0][21];
  a55=(a26+a16);
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
  a61=(a60*a41);
  a41=(a41-a61);
  a61=(a53+a16);
  a61=(a16/a61);
  a61=casadi_fmax(a56,a61);
  a62=(a61*a09);
  a09=(a09-a62);
  a62=(a41-a09);
  a62=casadi_sq(a62);
  a63=(a60*a40);
  a40=(a40-a63);
  a63=(a61*a11);
  a11=(a11-a63);
  a63=(a40-a11);
  a63=casadi_sq(a63);
  a62=(a62+a63);
  a63=(a24-a45);
  a60=(a60*a63);
  a45=(a45+a60);
  a24=(a24-a25);
  a61=(a61*a24);
  a25=(a25+a61);
  a61=(a45-a25);
  a61=casadi_sq(a61);
  a62=(a62+a61);
  a58=(a58*a62);
  a58=(a58-a54);
  a57=(a57*a58);
  a54=(a54+a57);
  a10=(a10*a54);
  a54=(a53*a10);
  a57=(a54-a52);
  a57=casadi_fmax(a57,a06);
  a57=(a52+a57);
  a52=(a52/a57);
  a52=(a46*a52);
  a52=(a12-a52);
  a51=(a51*a52);
  a23=(a23?a19:0);
  a19=arg[0][31];
  a52=(a47?a19:0);
  a57=arg[0][1];
  a58=(a50?a57:0);
  a52=(a52+a58);
  a58=(a23-a52);
  a62=arg[0][32];
  a61=(a47?a62:0);
  a24=arg[0][2];
  a50=(a50?a24:0);
  a61=(a61+a50);
  a50=(a12+a61);
  a58=(a58/a50);
  a24=(a12-a20);
  a58=(a58*a24);
  a60=(a51*a58);
  a60=(a60*a16);
  a60=(a49+a60);
  a63=arg[0][34];
  a64=(a47?a63:0);
  a65=(!a47);
  a66=arg[0][4];
  a67=(a65?a66:0);
  a64=(a64+a67);
  a24=(a51*a24);
  a67=(a24/a50);
  a67=(a67*a16);
  a68=arg[0][35];
  a69=(a47?a68:0);
  a70=arg[0][5];
  a70=(a65?a70:0);
  a69=(a69+a70);
  a70=(a67*a69);
  a70=(a64-a70);
  a71=(a24/a50);
  a71=(a71*a58);
  a71=(a71*a16);
  a72=arg[0][37];
  a73=(a47?a72:0);
  a74=arg[0][7];
  a75=(a65?a74:0);
  a73=(a73+a75);
  a75=(a71*a73);
  a70=(a70-a75);
  a75=(a24/a50);
  a76=arg[2][23];
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
  a79=casadi_sq(a29);
  a79=(a79+a31);
  a80=casadi_sq(a29);
  a80=(a80+a31);
  a54=(a54-a80);
  a54=casadi_fmax(a54,a06);
  a54=(a46*a54);
  a79=(a79+a54);
  a79=(a79/a16);
  a54=(a00<a07);
  a80=arg[2][8];
  a80=casadi_sq(a80);
  a54=(a54*a80);
  a79=(a79+a54);
  a79=(a78+a79);
  a54=(a23-a52);
  a80=casadi_sq(a54);
  a81=25.;
  a80=(a80/a81);
  a80=casadi_fmax(a79,a80);
  a82=(a77/a80);
  a83=(a82*a54);
  a83=(a60+a83);
  a83=(a08?a83:0);
  a84=(!a08);
  a60=(a84?a60:0);
  a83=(a83+a60);
  a60=arg[0][33];
  a85=(a47?a60:0);
  a86=arg[0][3];
  a86=(a65?a86:0);
  a85=(a85+a86);
  a86=(a47?a63:0);
  a66=(a65?a66:0);
  a86=(a86+a66);
  a66=(a67*a86);
  a66=(a85-a66);
  a87=arg[0][36];
  a88=(a47?a87:0);
  a89=arg[0][6];
  a90=(a65?a89:0);
  a88=(a88+a90);
  a90=(a71*a88);
  a66=(a66-a90);
  a70=(a70*a67);
  a66=(a66-a70);
  a70=(a47?a87:0);
  a89=(a65?a89:0);
  a70=(a70+a89);
  a89=(a47?a72:0);
  a74=(a65?a74:0);
  a89=(a89+a74);
  a74=(a67*a89);
  a74=(a70-a74);
  a90=arg[0][38];
  a47=(a47?a90:0);
  a91=arg[0][8];
  a65=(a65?a91:0);
  a47=(a47+a65);
  a65=(a71*a47);
  a74=(a74-a65);
  a65=(a74*a71);
  a66=(a66-a65);
  a50=(1./a50);
  a50=casadi_sq(a50);
  a65=casadi_sq(a29);
  a65=(a65+a31);
  a65=(a65*a16);
  a91=casadi_sq(a16);
  a91=(a16*a91);
  a76=(a76*a91);
  a76=(a76/a53);
  a65=(a65+a76);
  a50=(a50*a65);
  a65=arg[2][7];
  a65=casadi_sq(a65);
  a58=casadi_sq(a58);
  a65=(a65*a58);
  a65=(a65*a16);
  a50=(a50+a65);
  a24=(a24*a50);
  a51=(a20*a51);
  a50=arg[2][12];
  a50=casadi_sq(a50);
  a65=arg[0][53];
  a65=(a65+a16);
  a58=casadi_sq(a65);
  a58=(a20?a58:0);
  a58=(a20?a58:0);
  a65=(a20?a65:0);
  a20=(a20*a16);
  a20=(a65-a20);
  a20=casadi_sq(a20);
  a58=(a58-a20);
  a50=(a50*a58);
  a51=(a51*a50);
  a24=(a24+a51);
  a66=(a66+a24);
  a24=(a82*a77);
  a24=(a66-a24);
  a24=(a08?a24:0);
  a51=(!a08);
  a66=(a51?a66:0);
  a24=(a24+a66);
  a05=(a03?a05:0);
  a66=9.9999999999999998e-13;
  a05=casadi_fmax(a05,a66);
  a05=(a24+a05);
  a02=(a02-a83);
  a66=6.2831853071795862e+00;
  a50=(a02+a15);
  a50=(a50/a66);
  a50=floor(a50);
  a50=(a66*a50);
  a02=(a02-a50);
  a50=casadi_sq(a02);
  a50=(a03?a50:0);
  a50=(a03?a50:0);
  a50=(a50/a81);
  a50=casadi_fmax(a05,a50);
  a58=(a24/a50);
  a20=(a58*a02);
  a20=(a03?a20:0);
  a20=(a83+a20);
  a20=(a03?a20:0);
  a76=(!a03);
  a83=(a76?a83:0);
  a20=(a20+a83);
  if (res[0]!=0) res[0][0]=a20;
  a83=(a78/a80);
  a91=(a83*a54);
  a91=(a52+a91);
  a91=(a08?a91:0);
  a92=(a84?a52:0);
  a91=(a91+a92);
  a92=(a69*a67);
  a86=(a86-a92);
  a92=(a89*a71);
  a86=(a86-a92);
  a86=(a86-a75);
  a75=(a83*a77);
  a75=(a86-a75);
  a75=(a08?a75:0);
  a86=(a51?a86:0);
  a75=(a75+a86);
  a86=(a75/a50);
  a92=(a86*a02);
  a92=(a03?a92:0);
  a92=(a91+a92);
  a92=(a03?a92:0);
  a91=(a76?a91:0);
  a92=(a92+a91);
  if (res[0]!=0) res[0][1]=a92;
  a91=(a73/a80);
  a54=(a91*a54);
  a54=(a61+a54);
  a54=(a08?a54:0);
  a84=(a84?a61:0);
  a54=(a54+a84);
  a67=(a73*a67);
  a88=(a88-a67);
  a71=(a47*a71);
  a88=(a88-a71);
  a71=(a91*a77);
  a71=(a88-a71);
  a71=(a08?a71:0);
  a88=(a51?a88:0);
  a71=(a71+a88);
  a88=(a71/a50);
  a02=(a88*a02);
  a02=(a03?a02:0);
  a02=(a54+a02);
  a02=(a03?a02:0);
  a76=(a76?a54:0);
  a02=(a02+a76);
  if (res[0]!=0) res[0][2]=a02;
  a76=(a58*a24);
  a76=(a24-a76);
  a76=(a03?a76:0);
  a54=(!a03);
  a24=(a54?a24:0);
  a76=(a76+a24);
  if (res[0]!=0) res[0][3]=a76;
  a24=(a82*a78);
  a24=(a77-a24);
  a24=(a08?a24:0);
  a77=(a51?a77:0);
  a24=(a24+a77);
  a77=(a58*a75);
  a77=(a24-a77);
  a77=(a03?a77:0);
  a24=(a54?a24:0);
  a77=(a77+a24);
  if (res[0]!=0) res[0][4]=a77;
  a77=(a83*a78);
  a77=(a78-a77);
  a77=(a08?a77:0);
  a78=(a51?a78:0);
  a77=(a77+a78);
  a75=(a86*a75);
  a75=(a77-a75);
  a75=(a03?a75:0);
  a77=(a54?a77:0);
  a75=(a75+a77);
  if (res[0]!=0) res[0][5]=a75;
  a82=(a82*a73);
  a82=(a74-a82);
  a82=(a08?a82:0);
  a74=(a51?a74:0);
  a82=(a82+a74);
  a58=(a58*a71);
  a58=(a82-a58);
  a58=(a03?a58:0);
  a82=(a54?a82:0);
  a58=(a58+a82);
  if (res[0]!=0) res[0][6]=a58;
  a83=(a83*a73);
  a83=(a89-a83);
  a83=(a08?a83:0);
  a58=(a51?a89:0);
  a83=(a83+a58);
  a86=(a86*a71);
  a86=(a83-a86);
  a86=(a03?a86:0);
  a83=(a54?a83:0);
  a86=(a86+a83);
  if (res[0]!=0) res[0][7]=a86;
  a86=arg[2][13];
  a86=casadi_sq(a86);
  a86=(a86*a16);
  a86=(a47+a86);
  a91=(a91*a73);
  a91=(a86-a91);
  a91=(a08?a91:0);
  a51=(a51?a86:0);
  a91=(a91+a51);
  a88=(a88*a71);
  a88=(a91-a88);
  a88=(a03?a88:0);
  a54=(a54?a91:0);
  a88=(a88+a54);
  if (res[0]!=0) res[0][8]=a88;
  if (res[0]!=0) res[0][9]=a41;
  if (res[0]!=0) res[0][10]=a40;
  if (res[0]!=0) res[0][11]=a45;
  if (res[0]!=0) res[0][12]=a09;
  if (res[0]!=0) res[0][13]=a11;
  if (res[0]!=0) res[0][14]=a25;
  a59=(a59+a16);
  a59=(a16/a59);
  a59=casadi_fmax(a56,a59);
  a45=(a36-a04);
  a45=(a59*a45);
  a04=(a04+a45);
  if (res[0]!=0) res[0][15]=a04;
  a04=(a37-a42);
  a04=(a59*a04);
  a42=(a42+a04);
  if (res[0]!=0) res[0][16]=a42;
  a42=(a28-a43);
  a59=(a59*a42);
  a43=(a43+a59);
  if (res[0]!=0) res[0][17]=a43;
  a53=(a53+a16);
  a16=(a16/a53);
  a56=casadi_fmax(a56,a16);
  a36=(a36-a33);
  a36=(a56*a36);
  a33=(a33+a36);
  if (res[0]!=0) res[0][18]=a33;
  a37=(a37-a38);
  a37=(a56*a37);
  a38=(a38+a37);
  if (res[0]!=0) res[0][19]=a38;
  a28=(a28-a39);
  a56=(a56*a28);
  a39=(a39+a56);
  if (res[0]!=0) res[0][20]=a39;
  if (res[0]!=0) res[0][21]=a10;
  if (res[0]!=0) res[0][22]=a55;
  a10=(a26<a44);
  a44=(a44<=a55);
  a10=(a10*a44);
  a09=casadi_sq(a09);
  a11=casadi_sq(a11);
  a09=(a09+a11);
  a11=50.;
  a29=casadi_sq(a29);
  a29=(a29+a31);
  a29=(a29/a55);
  a11=(a11*a29);
  a09=(a09<=a11);
  a25=(a25-a52);
  a25=casadi_sq(a25);
  a29=(a69+a29);
  a81=(a81*a29);
  a25=(a25<=a81);
  a09=(a09*a25);
  a09=(a10?a09:0);
  a10=(!a10);
  a25=(a06<a55);
  a30=(a30*a25);
  a10=(a10?a30:0);
  a09=(a09+a10);
  if (res[0]!=0) res[0][23]=a09;
  a09=3.3333333333333335e+00;
  a10=(a09*a26);
  a10=floor(a10);
  a30=(a09*a55);
  a30=floor(a30);
  a10=(a10<a30);
  a30=arg[0][27];
  a25=(a10?a30:0);
  a81=(!a10);
  a29=arg[0][24];
  a29=(a81?a29:0);
  a25=(a25+a29);
  if (res[0]!=0) res[0][24]=a25;
  a25=arg[0][28];
  a29=(a10?a25:0);
  a11=arg[0][25];
  a11=(a81?a11:0);
  a29=(a29+a11);
  if (res[0]!=0) res[0][25]=a29;
  a29=arg[0][29];
  a11=(a10?a29:0);
  a31=arg[0][26];
  a81=(a81?a31:0);
  a11=(a11+a81);
  if (res[0]!=0) res[0][26]=a11;
  a11=(!a10);
  a30=(a11?a30:0);
  if (res[0]!=0) res[0][27]=a30;
  a25=(a11?a25:0);
  if (res[0]!=0) res[0][28]=a25;
  a10=(a10?a57:0);
  a11=(a11?a29:0);
  a10=(a10+a11);
  if (res[0]!=0) res[0][29]=a10;
  a26=(a09*a26);
  a26=floor(a26);
  a09=(a09*a55);
  a09=floor(a09);
  a26=(a26<a09);
  a09=arg[0][39];
  a55=(a26?a09:0);
  a10=(!a26);
  a48=(a10?a48:0);
  a55=(a55+a48);
  if (res[0]!=0) res[0][30]=a55;
  a55=arg[0][40];
  a48=(a26?a55:0);
  a19=(a10?a19:0);
  a48=(a48+a19);
  if (res[0]!=0) res[0][31]=a48;
  a48=arg[0][41];
  a19=(a26?a48:0);
  a62=(a10?a62:0);
  a19=(a19+a62);
  if (res[0]!=0) res[0][32]=a19;
  a19=arg[0][42];
  a62=(a26?a19:0);
  a60=(a10?a60:0);
  a62=(a62+a60);
  if (res[0]!=0) res[0][33]=a62;
  a62=arg[0][43];
  a60=(a26?a62:0);
  a63=(a10?a63:0);
  a60=(a60+a63);
  if (res[0]!=0) res[0][34]=a60;
  a60=arg[0][44];
  a63=(a26?a60:0);
  a68=(a10?a68:0);
  a63=(a63+a68);
  if (res[0]!=0) res[0][35]=a63;
  a63=arg[0][45];
  a68=(a26?a63:0);
  a87=(a10?a87:0);
  a68=(a68+a87);
  if (res[0]!=0) res[0][36]=a68;
  a68=arg[0][46];
  a87=(a26?a68:0);
  a72=(a10?a72:0);
  a87=(a87+a72);
  if (res[0]!=0) res[0][37]=a87;
  a87=arg[0][47];
  a72=(a26?a87:0);
  a10=(a10?a90:0);
  a72=(a72+a10);
  if (res[0]!=0) res[0][38]=a72;
  a49=(a26?a49:0);
  a72=(!a26);
  a09=(a72?a09:0);
  a49=(a49+a09);
  if (res[0]!=0) res[0][39]=a49;
  a52=(a26?a52:0);
  a55=(a72?a55:0);
  a52=(a52+a55);
  if (res[0]!=0) res[0][40]=a52;
  a61=(a26?a61:0);
  a48=(a72?a48:0);
  a61=(a61+a48);
  if (res[0]!=0) res[0][41]=a61;
  a85=(a26?a85:0);
  a19=(a72?a19:0);
  a85=(a85+a19);
  if (res[0]!=0) res[0][42]=a85;
  a64=(a26?a64:0);
  a62=(a72?a62:0);
  a64=(a64+a62);
  if (res[0]!=0) res[0][43]=a64;
  a69=(a26?a69:0);
  a60=(a72?a60:0);
  a69=(a69+a60);
  if (res[0]!=0) res[0][44]=a69;
  a70=(a26?a70:0);
  a63=(a72?a63:0);
  a70=(a70+a63);
  if (res[0]!=0) res[0][45]=a70;
  a89=(a26?a89:0);
  a68=(a72?a68:0);
  a89=(a89+a68);
  if (res[0]!=0) res[0][46]=a89;
  a26=(a26?a47:0);
  a72=(a72?a87:0);
  a26=(a26+a72);
  if (res[0]!=0) res[0][47]=a26;
  if (res[0]!=0) res[0][48]=a13;
  if (res[0]!=0) res[0][49]=a27;
  if (res[0]!=0) res[0][50]=a32;
  if (res[0]!=0) res[0][51]=a35;
  if (res[0]!=0) res[0][52]=a21;
  if (res[0]!=0) res[0][53]=a65;
  a65=arg[0][54];
  if (res[0]!=0) res[0][54]=a65;
  a65=arg[0][55];
  if (res[0]!=0) res[0][55]=a65;
  if (res[0]!=0) res[0][56]=a18;
  a15=(a20+a15);
  a15=(a15/a66);
  a15=floor(a15);
  a66=(a66*a15);
  a66=(a20-a66);
  if (res[1]!=0) res[1][0]=a66;
  a76=casadi_fmax(a76,a06);
  a76=sqrt(a76);
  if (res[1]!=0) res[1][1]=a76;
  if (res[1]!=0) res[1][2]=a92;
  a75=casadi_fmax(a75,a06);
  a75=sqrt(a75);
  if (res[1]!=0) res[1][3]=a75;
  if (res[1]!=0) res[1][4]=a02;
  a88=casadi_fmax(a88,a06);
  a88=sqrt(a88);
  if (res[1]!=0) res[1][5]=a88;
  a23=(a23-a92);
  a02=(a12+a02);
  a23=(a23/a02);
  if (res[1]!=0) res[1][6]=a23;
  if (res[1]!=0) res[1][7]=a20;
  a20=(a00<a07);
  a20=casadi_fmax(a46,a20);
  if (res[1]!=0) res[1][8]=a20;
  a20=8.;
  a20=(a20*a08);
  a00=(a00<a07);
  a20=(a20*a00);
  a79=(a79<a80);
  a20=(a20*a79);
  a79=64.;
  a79=(a79*a03);
  a05=(a05<a50);
  a79=(a79*a05);
  a20=(a20+a79);
  a03=(a12-a03);
  a01=(a01*a03);
  a14=(a14*a22);
  a14=(a12-a14);
  a12=(a12-a14);
  a01=(a01*a12);
  a20=(a20+a01);
  a20=(a20+a14);
  a17=(2.*a17);
  a20=(a20+a17);
  a17=128.;
  a17=(a17*a46);
  a17=(a17*a34);
  a20=(a20+a17);
  if (res[1]!=0) res[1][9]=a20;
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

/* initial:(u[9],p[24])->(s[57],y[10]) */
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
  if (res[0]!=0) res[0][24]=a4;
  if (res[0]!=0) res[0][25]=a4;
  if (res[0]!=0) res[0][26]=a4;
  if (res[0]!=0) res[0][27]=a4;
  if (res[0]!=0) res[0][28]=a4;
  if (res[0]!=0) res[0][29]=a4;
  if (res[0]!=0) res[0][30]=a0;
  if (res[0]!=0) res[0][31]=a1;
  if (res[0]!=0) res[0][32]=a2;
  if (res[0]!=0) res[0][33]=a3;
  if (res[0]!=0) res[0][34]=a4;
  if (res[0]!=0) res[0][35]=a6;
  if (res[0]!=0) res[0][36]=a4;
  if (res[0]!=0) res[0][37]=a7;
  if (res[0]!=0) res[0][38]=a5;
  if (res[0]!=0) res[0][39]=a0;
  if (res[0]!=0) res[0][40]=a1;
  if (res[0]!=0) res[0][41]=a2;
  if (res[0]!=0) res[0][42]=a3;
  if (res[0]!=0) res[0][43]=a4;
  if (res[0]!=0) res[0][44]=a6;
  if (res[0]!=0) res[0][45]=a4;
  if (res[0]!=0) res[0][46]=a7;
  if (res[0]!=0) res[0][47]=a5;
  if (res[0]!=0) res[0][48]=a4;
  if (res[0]!=0) res[0][49]=a4;
  if (res[0]!=0) res[0][50]=a4;
  a7=9.8066499999999994e+00;
  if (res[0]!=0) res[0][51]=a7;
  a7=25.;
  if (res[0]!=0) res[0][52]=a7;
  if (res[0]!=0) res[0][53]=a4;
  if (res[0]!=0) res[0][54]=a4;
  if (res[0]!=0) res[0][55]=a4;
  if (res[0]!=0) res[0][56]=a4;
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
