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
  const casadi_real *restrict i0=arg[0];
  const casadi_real *restrict i1=arg[1];
  const casadi_real *restrict i2=arg[2];
  const casadi_real *restrict i4=arg[4];
  casadi_real *restrict o0=res[0];
  casadi_real *restrict o1=res[1];
  const casadi_real v2=0.5<i1[6];
  const casadi_real v4=fabs(i1[5]);
  const casadi_real v6=v4<=1000000.0;
  const casadi_real v7=v2*v6;
  const casadi_real v9=fabs(i1[7]);
  const casadi_real v10=v9<=1000000.0;
  const casadi_real v11=v7*v10;
  const casadi_real v13=0.0<=i1[7];
  const casadi_real v14=v11*v13;
  const casadi_real v16=0.5<i1[8];
  const casadi_real v18=i0[12]*i0[12];
  const casadi_real v20=i0[13]*i0[13];
  const casadi_real v21=v18+v20;
  const casadi_real v23=fabs(i1[0]);
  const casadi_real v24=v23<=1000000.0;
  const casadi_real v25=fabs(i1[0]);
  const casadi_real v28=3.141592653589793/i4[0];
  const casadi_real v29=v25<=v28;
  const casadi_real v30=v24*v29;
  const casadi_real v31=v30?i1[0]:0;
  const casadi_real v32=!v30;
  const casadi_real v34=v32?i0[42]:0;
  const casadi_real v35=v31+v34;
  o0[42]=v35;
  o0[50]=i0[50];
  const casadi_real v37=v35-i0[50];
  const casadi_real v40=fabs(i1[4]);
  const casadi_real v41=v40<=1000000.0;
  const casadi_real v42=v41?i1[4]:0;
  const casadi_real v43=!v41;
  const casadi_real v45=v43?i0[46]:0;
  const casadi_real v46=v42+v45;
  o0[46]=v46;
  const casadi_real v48=v46-i2[15];
  const casadi_real v49=i2[14]*v48;
  const casadi_real v50=v37-v49;
  const casadi_real v51=fabs(v50);
  const casadi_real v52=v51<=1000000.0;
  const casadi_real v53=v52?v50:0;
  const casadi_real v55=v53-i0[14];
  const casadi_real v56=v55*v55;
  const casadi_real v57=v21+v56;
  const casadi_real v59=i2[10]*i2[10];
  const casadi_real v62=i2[16]*i2[16];
  const casadi_real v64=v62+1e-18;
  const casadi_real v65=v64/i4[0];
  const casadi_real v66=30.0*v65;
  const casadi_real v67=v59+v66;
  const casadi_real v68=v57<=v67;
  const casadi_real v71=fabs(i1[1]);
  const casadi_real v72=v71<=1000000.0;
  const casadi_real v74=fabs(i1[2]);
  const casadi_real v75=v74<=1000000.0;
  const casadi_real v76=v72*v75;
  const casadi_real v78=fabs(i1[3]);
  const casadi_real v79=v78<=1000000.0;
  const casadi_real v80=v76*v79;
  const casadi_real v81=v72?i1[1]:0;
  const casadi_real v82=!v72;
  const casadi_real v84=v82?i0[43]:0;
  const casadi_real v85=v81+v84;
  o0[43]=v85;
  const casadi_real v86=v85*v85;
  const casadi_real v87=v75?i1[2]:0;
  const casadi_real v88=!v75;
  const casadi_real v90=v88?i0[44]:0;
  const casadi_real v91=v87+v90;
  o0[44]=v91;
  const casadi_real v92=v91*v91;
  const casadi_real v93=v86+v92;
  const casadi_real v94=v79?i1[3]:0;
  const casadi_real v95=!v79;
  const casadi_real v97=v95?i0[45]:0;
  const casadi_real v98=v94+v97;
  o0[45]=v98;
  const casadi_real v99=v98*v98;
  const casadi_real v100=v93+v99;
  const casadi_real v101=0.0<v100;
  const casadi_real v102=v80*v101;
  const casadi_real v103=1.0-v102;
  const casadi_real v104=!v103;
  const casadi_real v105=v104?v85:0;
  const casadi_real v107=v105-i0[18];
  const casadi_real v108=v107*v107;
  const casadi_real v109=v104?v91:0;
  const casadi_real v111=v109-i0[19];
  const casadi_real v112=v111*v111;
  const casadi_real v113=v108+v112;
  const casadi_real v114=v104?v98:0;
  const casadi_real v116=v114-i0[20];
  const casadi_real v117=v116*v116;
  const casadi_real v118=v113+v117;
  const casadi_real v120=i2[11]*i2[11];
  const casadi_real v122=v120+3.0000000000000004e-07;
  const casadi_real v123=v118<=v122;
  const casadi_real v124=v68*v123;
  const casadi_real v126=i0[15]-i0[18];
  const casadi_real v127=v126*v126;
  const casadi_real v129=i0[16]-i0[19];
  const casadi_real v130=v129*v129;
  const casadi_real v131=v127+v130;
  const casadi_real v133=i0[17]-i0[20];
  const casadi_real v134=v133*v133;
  const casadi_real v135=v131+v134;
  const casadi_real v137=0.1*i2[11];
  const casadi_real v138=v137*v137;
  const casadi_real v140=3.681818181818183e-07*i4[0];
  const casadi_real v141=v138+v140;
  const casadi_real v142=v135<=v141;
  const casadi_real v143=v124*v142;
  const casadi_real v145=i0[9]-i0[12];
  const casadi_real v146=v145*v145;
  const casadi_real v148=i0[10]-i0[13];
  const casadi_real v149=v148*v148;
  const casadi_real v150=v146+v149;
  const casadi_real v152=i0[11]-i0[14];
  const casadi_real v153=v152*v152;
  const casadi_real v154=v150+v153;
  const casadi_real v155=0.5*i2[10];
  const casadi_real v156=v155*v155;
  const casadi_real v158=36.81818181818183*v65;
  const casadi_real v159=v158*i4[0];
  const casadi_real v160=v156+v159;
  const casadi_real v161=v154<=v160;
  const casadi_real v162=v143*v161;
  const casadi_real v163=1.0-v29;
  const casadi_real v164=v24*v163;
  const casadi_real v165=0.0<v164;
  const casadi_real v166=1.0-v165;
  const casadi_real v167=v24*v166;
  const casadi_real v168=v167*v52;
  const casadi_real v169=1.0-v168;
  const casadi_real v170=1.0-v169;
  const casadi_real v171=v162*v170;
  const casadi_real v174=i2[9]<=i0[22];
  const casadi_real v175=v171*v174;
  const casadi_real v177=v175*i0[23];
  const casadi_real v178=0.0<i2[9];
  const casadi_real v179=0.5<i1[8];
  const casadi_real v180=1.0-v179;
  const casadi_real v181=v178*v180;
  const casadi_real v182=v177*v181;
  const casadi_real v183=casadi_fmax(v16,v182);
  const casadi_real v184=1.0-v169;
  const casadi_real v185=v183*v184;
  const casadi_real v186=v171<i0[23];
  const casadi_real v187=v181*v186;
  const casadi_real v189=v187?i0[24]:0;
  const casadi_real v190=!v187;
  const casadi_real v192=v190?i0[0]:0;
  const casadi_real v193=v189+v192;
  const casadi_real v194=0.5<i1[8];
  const casadi_real v195=1.0-v194;
  const casadi_real v196=i2[16]*i2[16];
  const casadi_real v197=v196+1e-18;
  const casadi_real v200=i0[22]+i4[0];
  const casadi_real v201=v171*v200;
  o0[22]=v201;
  const casadi_real v202=casadi_fmax(v201,i4[0]);
  const casadi_real v203=i4[0]/v202;
  const casadi_real v205=10.0+i4[0];
  const casadi_real v206=i4[0]/v205;
  const casadi_real v207=casadi_fmax(v203,v206);
  const casadi_real v210=0.3+i4[0];
  const casadi_real v211=i4[0]/v210;
  const casadi_real v212=casadi_fmax(v203,v211);
  const casadi_real v213=v212*i0[9];
  const casadi_real v214=i0[9]-v213;
  o0[9]=v214;
  const casadi_real v215=3.0+i4[0];
  const casadi_real v216=i4[0]/v215;
  const casadi_real v217=casadi_fmax(v203,v216);
  const casadi_real v218=v217*i0[12];
  const casadi_real v219=i0[12]-v218;
  o0[12]=v219;
  const casadi_real v220=v214-v219;
  const casadi_real v221=v220*v220;
  const casadi_real v222=v212*i0[10];
  const casadi_real v223=i0[10]-v222;
  o0[10]=v223;
  const casadi_real v224=v217*i0[13];
  const casadi_real v225=i0[13]-v224;
  o0[13]=v225;
  const casadi_real v226=v223-v225;
  const casadi_real v227=v226*v226;
  const casadi_real v228=v221+v227;
  const casadi_real v229=v53-i0[11];
  const casadi_real v230=v212*v229;
  const casadi_real v231=i0[11]+v230;
  o0[11]=v231;
  const casadi_real v232=v53-i0[14];
  const casadi_real v233=v217*v232;
  const casadi_real v234=i0[14]+v233;
  o0[14]=v234;
  const casadi_real v235=v231-v234;
  const casadi_real v236=v235*v235;
  const casadi_real v237=v228+v236;
  const casadi_real v238=0.27160493827160487*v237;
  const casadi_real v239=v238-i0[21];
  const casadi_real v240=v207*v239;
  const casadi_real v241=i0[21]+v240;
  const casadi_real v242=v171*v241;
  o0[21]=v242;
  const casadi_real v243=3.0*v242;
  const casadi_real v245=1.3*v197;
  const casadi_real v246=v243-v245;
  const casadi_real v247=casadi_fmax(v246,0.0);
  const casadi_real v248=v197+v247;
  const casadi_real v249=v197/v248;
  const casadi_real v250=v182*v249;
  const casadi_real v251=1.0-v250;
  const casadi_real v252=v195*v251;
  const casadi_real v253=v52?v50:0;
  const casadi_real v255=v187?i0[25]:0;
  const casadi_real v257=v190?i0[1]:0;
  const casadi_real v258=v255+v257;
  const casadi_real v259=v253-v258;
  const casadi_real v261=v187?i0[26]:0;
  const casadi_real v263=v190?i0[2]:0;
  const casadi_real v264=v261+v263;
  const casadi_real v265=1.0+v264;
  const casadi_real v266=v259/v265;
  const casadi_real v267=v252*v266;
  const casadi_real v268=v267*i4[0];
  const casadi_real v269=v193+v268;
  const casadi_real v271=v187?i0[28]:0;
  const casadi_real v272=!v187;
  const casadi_real v274=v272?i0[4]:0;
  const casadi_real v275=v271+v274;
  const casadi_real v276=1.0-v169;
  const casadi_real v277=v252*v276;
  const casadi_real v278=v277/v265;
  const casadi_real v279=v278*i4[0];
  const casadi_real v281=v187?i0[29]:0;
  const casadi_real v283=v272?i0[5]:0;
  const casadi_real v284=v281+v283;
  const casadi_real v285=v279*v284;
  const casadi_real v286=v275-v285;
  const casadi_real v287=v277/v265;
  const casadi_real v288=v287*v266;
  const casadi_real v289=v288*i4[0];
  const casadi_real v291=v187?i0[31]:0;
  const casadi_real v293=v272?i0[7]:0;
  const casadi_real v294=v291+v293;
  const casadi_real v295=v289*v294;
  const casadi_real v296=v286-v295;
  const casadi_real v297=v277/v265;
  const casadi_real v299=i2[17]*i2[17];
  const casadi_real v300=i4[0]*i4[0];
  const casadi_real v301=v299*v300;
  const casadi_real v303=v301/2.0;
  const casadi_real v304=v297*v303;
  const casadi_real v305=v296-v304;
  const casadi_real v306=v299*i4[0];
  const casadi_real v308=1.0000000000000001e-20*i4[0];
  const casadi_real v309=v306+v308;
  const casadi_real v310=v284+v309;
  const casadi_real v311=i2[16]*i2[16];
  const casadi_real v312=v311+1e-18;
  const casadi_real v313=i2[16]*i2[16];
  const casadi_real v314=v313+1e-18;
  const casadi_real v315=1.3*v314;
  const casadi_real v316=v243-v315;
  const casadi_real v317=casadi_fmax(v316,0.0);
  const casadi_real v318=v182*v317;
  const casadi_real v319=v312+v318;
  const casadi_real v320=v319/i4[0];
  const casadi_real v321=0.5<i1[8];
  const casadi_real v323=i2[8]*i2[8];
  const casadi_real v324=v321*v323;
  const casadi_real v325=v320+v324;
  const casadi_real v326=v310+v325;
  const casadi_real v327=v253-v258;
  const casadi_real v328=v327*v327;
  const casadi_real v330=v328/25.0;
  const casadi_real v331=casadi_fmax(v326,v330);
  const casadi_real v332=v305/v331;
  const casadi_real v333=v332*v327;
  const casadi_real v334=v269+v333;
  const casadi_real v335=v185?v334:0;
  const casadi_real v336=!v185;
  const casadi_real v337=v336?v269:0;
  const casadi_real v338=v335+v337;
  const casadi_real v340=v187?i0[27]:0;
  const casadi_real v342=v272?i0[3]:0;
  const casadi_real v343=v340+v342;
  const casadi_real v344=v187?i0[28]:0;
  const casadi_real v345=v272?i0[4]:0;
  const casadi_real v346=v344+v345;
  const casadi_real v347=v279*v346;
  const casadi_real v348=v343-v347;
  const casadi_real v350=v187?i0[30]:0;
  const casadi_real v352=v272?i0[6]:0;
  const casadi_real v353=v350+v352;
  const casadi_real v354=v289*v353;
  const casadi_real v355=v348-v354;
  const casadi_real v356=v296*v279;
  const casadi_real v357=v355-v356;
  const casadi_real v358=v187?i0[30]:0;
  const casadi_real v359=v272?i0[6]:0;
  const casadi_real v360=v358+v359;
  const casadi_real v361=v187?i0[31]:0;
  const casadi_real v362=v272?i0[7]:0;
  const casadi_real v363=v361+v362;
  const casadi_real v364=v279*v363;
  const casadi_real v365=v360-v364;
  const casadi_real v367=v187?i0[32]:0;
  const casadi_real v369=v272?i0[8]:0;
  const casadi_real v370=v367+v369;
  const casadi_real v371=v289*v370;
  const casadi_real v372=v365-v371;
  const casadi_real v373=v372*v289;
  const casadi_real v374=v357-v373;
  const casadi_real v375=1./v265;
  const casadi_real v376=v375*v375;
  const casadi_real v377=i2[16]*i2[16];
  const casadi_real v378=v377+1e-18;
  const casadi_real v379=v378*i4[0];
  const casadi_real v380=i4[0]*i4[0];
  const casadi_real v381=i4[0]*v380;
  const casadi_real v382=v299*v381;
  const casadi_real v383=v382/3.0;
  const casadi_real v384=v379+v383;
  const casadi_real v385=v376*v384;
  const casadi_real v387=i2[7]*i2[7];
  const casadi_real v388=v266*v266;
  const casadi_real v389=v387*v388;
  const casadi_real v390=v389*i4[0];
  const casadi_real v391=v385+v390;
  const casadi_real v392=v277*v391;
  const casadi_real v393=v169*v252;
  const casadi_real v395=i2[12]*i2[12];
  const casadi_real v397=i0[47]+i4[0];
  const casadi_real v398=v169?v397:0;
  o0[47]=v398;
  const casadi_real v399=casadi_fmin(v398,1.0);
  const casadi_real v400=v399*v399;
  const casadi_real v401=v169*i4[0];
  const casadi_real v402=v398-v401;
  const casadi_real v403=casadi_fmin(v402,1.0);
  const casadi_real v404=v403*v403;
  const casadi_real v405=v400-v404;
  const casadi_real v406=v398-v399;
  const casadi_real v407=v402-v403;
  const casadi_real v408=v406-v407;
  const casadi_real v409=2.*v408;
  const casadi_real v410=v405+v409;
  const casadi_real v411=v395*v410;
  const casadi_real v412=v393*v411;
  const casadi_real v413=v392+v412;
  const casadi_real v414=v374+v413;
  const casadi_real v415=v332*v305;
  const casadi_real v416=v414-v415;
  const casadi_real v417=v185?v416:0;
  const casadi_real v418=!v185;
  const casadi_real v419=v418?v414:0;
  const casadi_real v420=v417+v419;
  const casadi_real v421=v14?i1[7]:0;
  const casadi_real v423=casadi_fmax(v421,1e-12);
  const casadi_real v424=v420+v423;
  const casadi_real v425=i1[5]-v338;
  const casadi_real v427=v425+3.141592653589793;
  const casadi_real v428=v427/6.283185307179586;
  const casadi_real v429=floor(v428);
  const casadi_real v430=6.283185307179586*v429;
  const casadi_real v431=v425-v430;
  const casadi_real v432=v431*v431;
  const casadi_real v433=v14?v432:0;
  const casadi_real v434=v14?v433:0;
  const casadi_real v435=v434/25.0;
  const casadi_real v436=casadi_fmax(v424,v435);
  const casadi_real v437=v420/v436;
  const casadi_real v438=v437*v431;
  const casadi_real v439=v14?v438:0;
  const casadi_real v440=v338+v439;
  const casadi_real v441=v14?v440:0;
  const casadi_real v442=!v14;
  const casadi_real v443=v442?v338:0;
  const casadi_real v444=v441+v443;
  o0[0]=v444;
  o1[7]=v444;
  const casadi_real v445=v310/v331;
  const casadi_real v446=v445*v327;
  const casadi_real v447=v258+v446;
  const casadi_real v448=v185?v447:0;
  const casadi_real v449=v336?v258:0;
  const casadi_real v450=v448+v449;
  const casadi_real v451=v284*v279;
  const casadi_real v452=v346-v451;
  const casadi_real v453=v363*v289;
  const casadi_real v454=v452-v453;
  const casadi_real v455=v454-v304;
  const casadi_real v456=v445*v305;
  const casadi_real v457=v455-v456;
  const casadi_real v458=v185?v457:0;
  const casadi_real v459=v418?v455:0;
  const casadi_real v460=v458+v459;
  const casadi_real v461=v460/v436;
  const casadi_real v462=v461*v431;
  const casadi_real v463=v14?v462:0;
  const casadi_real v464=v450+v463;
  const casadi_real v465=v14?v464:0;
  const casadi_real v466=v442?v450:0;
  const casadi_real v467=v465+v466;
  o0[1]=v467;
  o1[2]=v467;
  const casadi_real v468=v294/v331;
  const casadi_real v469=v468*v327;
  const casadi_real v470=v264+v469;
  const casadi_real v471=v185?v470:0;
  const casadi_real v472=v336?v264:0;
  const casadi_real v473=v471+v472;
  const casadi_real v474=v294*v279;
  const casadi_real v475=v353-v474;
  const casadi_real v476=v370*v289;
  const casadi_real v477=v475-v476;
  const casadi_real v478=v468*v305;
  const casadi_real v479=v477-v478;
  const casadi_real v480=v185?v479:0;
  const casadi_real v481=v418?v477:0;
  const casadi_real v482=v480+v481;
  const casadi_real v483=v482/v436;
  const casadi_real v484=v483*v431;
  const casadi_real v485=v14?v484:0;
  const casadi_real v486=v473+v485;
  const casadi_real v487=v14?v486:0;
  const casadi_real v488=v442?v473:0;
  const casadi_real v489=v487+v488;
  o0[2]=v489;
  o1[4]=v489;
  const casadi_real v490=v437*v420;
  const casadi_real v491=v420-v490;
  const casadi_real v492=v14?v491:0;
  const casadi_real v493=!v14;
  const casadi_real v494=v493?v420:0;
  const casadi_real v495=v492+v494;
  o0[3]=v495;
  const casadi_real v496=v332*v310;
  const casadi_real v497=v305-v496;
  const casadi_real v498=v185?v497:0;
  const casadi_real v499=v418?v305:0;
  const casadi_real v500=v498+v499;
  const casadi_real v501=v437*v460;
  const casadi_real v502=v500-v501;
  const casadi_real v503=v14?v502:0;
  const casadi_real v504=v493?v500:0;
  const casadi_real v505=v503+v504;
  o0[4]=v505;
  const casadi_real v506=v445*v310;
  const casadi_real v507=v310-v506;
  const casadi_real v508=v185?v507:0;
  const casadi_real v509=v418?v310:0;
  const casadi_real v510=v508+v509;
  const casadi_real v511=v461*v460;
  const casadi_real v512=v510-v511;
  const casadi_real v513=v14?v512:0;
  const casadi_real v514=v493?v510:0;
  const casadi_real v515=v513+v514;
  o0[5]=v515;
  const casadi_real v516=v332*v294;
  const casadi_real v517=v372-v516;
  const casadi_real v518=v185?v517:0;
  const casadi_real v519=v418?v372:0;
  const casadi_real v520=v518+v519;
  const casadi_real v521=v437*v482;
  const casadi_real v522=v520-v521;
  const casadi_real v523=v14?v522:0;
  const casadi_real v524=v493?v520:0;
  const casadi_real v525=v523+v524;
  o0[6]=v525;
  const casadi_real v526=v445*v294;
  const casadi_real v527=v363-v526;
  const casadi_real v528=v185?v527:0;
  const casadi_real v529=v418?v363:0;
  const casadi_real v530=v528+v529;
  const casadi_real v531=v461*v482;
  const casadi_real v532=v530-v531;
  const casadi_real v533=v14?v532:0;
  const casadi_real v534=v493?v530:0;
  const casadi_real v535=v533+v534;
  o0[7]=v535;
  const casadi_real v537=i2[13]*i2[13];
  const casadi_real v538=v537*i4[0];
  const casadi_real v539=v370+v538;
  const casadi_real v540=v468*v294;
  const casadi_real v541=v539-v540;
  const casadi_real v542=v185?v541:0;
  const casadi_real v543=v418?v539:0;
  const casadi_real v544=v542+v543;
  const casadi_real v545=v483*v482;
  const casadi_real v546=v544-v545;
  const casadi_real v547=v14?v546:0;
  const casadi_real v548=v493?v544:0;
  const casadi_real v549=v547+v548;
  o0[8]=v549;
  const casadi_real v550=0.3+i4[0];
  const casadi_real v551=i4[0]/v550;
  const casadi_real v552=casadi_fmax(v203,v551);
  const casadi_real v553=v105-i0[15];
  const casadi_real v554=v552*v553;
  const casadi_real v555=i0[15]+v554;
  o0[15]=v555;
  const casadi_real v556=v109-i0[16];
  const casadi_real v557=v552*v556;
  const casadi_real v558=i0[16]+v557;
  o0[16]=v558;
  const casadi_real v559=v114-i0[17];
  const casadi_real v560=v552*v559;
  const casadi_real v561=i0[17]+v560;
  o0[17]=v561;
  const casadi_real v562=3.0+i4[0];
  const casadi_real v563=i4[0]/v562;
  const casadi_real v564=casadi_fmax(v203,v563);
  const casadi_real v565=v105-i0[18];
  const casadi_real v566=v564*v565;
  const casadi_real v567=i0[18]+v566;
  o0[18]=v567;
  const casadi_real v568=v109-i0[19];
  const casadi_real v569=v564*v568;
  const casadi_real v570=i0[19]+v569;
  o0[19]=v570;
  const casadi_real v571=v114-i0[20];
  const casadi_real v572=v564*v571;
  const casadi_real v573=i0[20]+v572;
  o0[20]=v573;
  const casadi_real v574=i0[22]<i2[9];
  const casadi_real v575=i2[9]<=v201;
  const casadi_real v576=v574*v575;
  const casadi_real v577=v219*v219;
  const casadi_real v578=v225*v225;
  const casadi_real v579=v577+v578;
  const casadi_real v581=i2[16]*i2[16];
  const casadi_real v582=v581+1e-18;
  const casadi_real v583=v582/v201;
  const casadi_real v584=50.0*v583;
  const casadi_real v585=v579<=v584;
  const casadi_real v586=v234-v258;
  const casadi_real v587=v586*v586;
  const casadi_real v588=v284+v583;
  const casadi_real v589=25.0*v588;
  const casadi_real v590=casadi_fmax(v589,0.0);
  const casadi_real v591=v587<=v590;
  const casadi_real v592=v585*v591;
  const casadi_real v593=v576?v592:0;
  const casadi_real v594=!v576;
  const casadi_real v595=0.0<v201;
  const casadi_real v596=i0[23]*v595;
  const casadi_real v597=v594?v596:0;
  const casadi_real v598=v593+v597;
  o0[23]=v598;
  const casadi_real v600=3.3333333333333335*i0[22];
  const casadi_real v601=floor(v600);
  const casadi_real v602=3.3333333333333335*v201;
  const casadi_real v603=floor(v602);
  const casadi_real v604=v601<v603;
  const casadi_real v606=v604?i0[33]:0;
  const casadi_real v607=!v604;
  const casadi_real v608=v607?i0[24]:0;
  const casadi_real v609=v606+v608;
  o0[24]=v609;
  const casadi_real v611=v604?i0[34]:0;
  const casadi_real v612=v607?i0[25]:0;
  const casadi_real v613=v611+v612;
  o0[25]=v613;
  const casadi_real v615=v604?i0[35]:0;
  const casadi_real v616=v607?i0[26]:0;
  const casadi_real v617=v615+v616;
  o0[26]=v617;
  const casadi_real v619=v604?i0[36]:0;
  const casadi_real v620=v607?i0[27]:0;
  const casadi_real v621=v619+v620;
  o0[27]=v621;
  const casadi_real v623=v604?i0[37]:0;
  const casadi_real v624=v607?i0[28]:0;
  const casadi_real v625=v623+v624;
  o0[28]=v625;
  const casadi_real v627=v604?i0[38]:0;
  const casadi_real v628=v607?i0[29]:0;
  const casadi_real v629=v627+v628;
  o0[29]=v629;
  const casadi_real v631=v604?i0[39]:0;
  const casadi_real v632=v607?i0[30]:0;
  const casadi_real v633=v631+v632;
  o0[30]=v633;
  const casadi_real v635=v604?i0[40]:0;
  const casadi_real v636=v607?i0[31]:0;
  const casadi_real v637=v635+v636;
  o0[31]=v637;
  const casadi_real v639=v604?i0[41]:0;
  const casadi_real v640=v607?i0[32]:0;
  const casadi_real v641=v639+v640;
  o0[32]=v641;
  const casadi_real v642=v604?v193:0;
  const casadi_real v643=!v604;
  const casadi_real v644=v643?i0[33]:0;
  const casadi_real v645=v642+v644;
  o0[33]=v645;
  const casadi_real v646=v604?v258:0;
  const casadi_real v647=v643?i0[34]:0;
  const casadi_real v648=v646+v647;
  o0[34]=v648;
  const casadi_real v649=v604?v264:0;
  const casadi_real v650=v643?i0[35]:0;
  const casadi_real v651=v649+v650;
  o0[35]=v651;
  const casadi_real v652=v604?v343:0;
  const casadi_real v653=v643?i0[36]:0;
  const casadi_real v654=v652+v653;
  o0[36]=v654;
  const casadi_real v655=v604?v275:0;
  const casadi_real v656=v643?i0[37]:0;
  const casadi_real v657=v655+v656;
  o0[37]=v657;
  const casadi_real v658=v604?v284:0;
  const casadi_real v659=v643?i0[38]:0;
  const casadi_real v660=v658+v659;
  o0[38]=v660;
  const casadi_real v661=v604?v360:0;
  const casadi_real v662=v643?i0[39]:0;
  const casadi_real v663=v661+v662;
  o0[39]=v663;
  const casadi_real v664=v604?v363:0;
  const casadi_real v665=v643?i0[40]:0;
  const casadi_real v666=v664+v665;
  o0[40]=v666;
  const casadi_real v667=v604?v370:0;
  const casadi_real v668=v643?i0[41]:0;
  const casadi_real v669=v667+v668;
  o0[41]=v669;
  o0[48]=i0[48];
  o0[49]=i0[49];
  const casadi_real v672=v444+3.141592653589793;
  const casadi_real v673=v672/6.283185307179586;
  const casadi_real v674=floor(v673);
  const casadi_real v675=6.283185307179586*v674;
  const casadi_real v676=v444-v675;
  o1[0]=v676;
  const casadi_real v677=casadi_fmax(v495,0.0);
  const casadi_real v678=sqrt(v677);
  o1[1]=v678;
  const casadi_real v679=casadi_fmax(v515,0.0);
  const casadi_real v680=sqrt(v679);
  o1[3]=v680;
  const casadi_real v681=casadi_fmax(v549,0.0);
  const casadi_real v682=sqrt(v681);
  o1[5]=v682;
  const casadi_real v683=v253-v467;
  const casadi_real v684=1.0+v489;
  const casadi_real v685=v683/v684;
  o1[6]=v685;
  const casadi_real v686=0.5<i1[8];
  const casadi_real v687=casadi_fmax(v182,v686);
  o1[8]=v687;
  const casadi_real v689=8.0*v185;
  const casadi_real v690=0.5<i1[8];
  const casadi_real v691=v689*v690;
  const casadi_real v692=v326<v331;
  const casadi_real v693=v691*v692;
  const casadi_real v695=64.0*v14;
  const casadi_real v696=v424<v436;
  const casadi_real v697=v695*v696;
  const casadi_real v698=v693+v697;
  const casadi_real v699=1.0-v14;
  const casadi_real v700=v2*v699;
  const casadi_real v701=v24*v41;
  const casadi_real v702=1.0-v701;
  const casadi_real v703=1.0-v702;
  const casadi_real v704=v700*v703;
  const casadi_real v705=v698+v704;
  const casadi_real v706=v705+v702;
  const casadi_real v707=2.*v165;
  const casadi_real v708=v706+v707;
  const casadi_real v710=128.0*v182;
  const casadi_real v711=v710*v103;
  const casadi_real v712=v708+v711;
  o1[9]=v712;
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
  const casadi_real *restrict i1=arg[1];
  casadi_real *restrict o0=res[0];
  casadi_real *restrict o1=res[1];
  o0[0]=i1[0];
  o0[24]=i1[0];
  o0[33]=i1[0];
  o1[7]=i1[0];
  o0[1]=i1[1];
  o0[25]=i1[1];
  o0[34]=i1[1];
  o1[2]=i1[1];
  o0[2]=i1[2];
  o0[26]=i1[2];
  o0[35]=i1[2];
  o1[4]=i1[2];
  const casadi_real v4=i1[3]*i1[3];
  o0[3]=v4;
  o0[27]=v4;
  o0[36]=v4;
  o0[4]=0.0;
  o0[6]=0.0;
  o0[9]=0.0;
  o0[10]=0.0;
  o0[11]=0.0;
  o0[12]=0.0;
  o0[13]=0.0;
  o0[14]=0.0;
  o0[15]=0.0;
  o0[16]=0.0;
  o0[17]=0.0;
  o0[18]=0.0;
  o0[19]=0.0;
  o0[20]=0.0;
  o0[21]=0.0;
  o0[22]=0.0;
  o0[23]=0.0;
  o0[28]=0.0;
  o0[30]=0.0;
  o0[37]=0.0;
  o0[39]=0.0;
  o0[42]=0.0;
  o0[43]=0.0;
  o0[44]=0.0;
  o0[47]=0.0;
  o0[48]=0.0;
  o0[49]=0.0;
  o0[50]=0.0;
  o1[8]=0.0;
  o1[9]=0.0;
  const casadi_real v7=i1[4]*i1[4];
  o0[5]=v7;
  o0[29]=v7;
  o0[38]=v7;
  const casadi_real v9=i1[6]*i1[4];
  const casadi_real v11=v9*i1[5];
  o0[7]=v11;
  o0[31]=v11;
  o0[40]=v11;
  const casadi_real v12=i1[5]*i1[5];
  o0[8]=v12;
  o0[32]=v12;
  o0[41]=v12;
  o0[45]=9.80665;
  o0[46]=25.0;
  const casadi_real v17=i1[0]+3.141592653589793;
  const casadi_real v18=v17/6.283185307179586;
  const casadi_real v19=floor(v18);
  const casadi_real v20=6.283185307179586*v19;
  const casadi_real v21=i1[0]-v20;
  o1[0]=v21;
  const casadi_real v22=casadi_fmax(v4,0.0);
  const casadi_real v23=sqrt(v22);
  o1[1]=v23;
  const casadi_real v24=casadi_fmax(v7,0.0);
  const casadi_real v25=sqrt(v24);
  o1[3]=v25;
  const casadi_real v26=casadi_fmax(v12,0.0);
  const casadi_real v27=sqrt(v26);
  o1[5]=v27;
  const casadi_real v29=1.0+i1[2];
  const casadi_real v30=i1[1]/v29;
  const casadi_real v31=-v30;
  o1[6]=v31;
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
