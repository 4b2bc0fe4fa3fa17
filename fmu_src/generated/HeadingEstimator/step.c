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
  const casadi_real v186=i0[22]<i2[9];
  const casadi_real v187=i0[22]+i4[0];
  const casadi_real v188=v171*v187;
  o0[22]=v188;
  const casadi_real v189=i2[9]<=v188;
  const casadi_real v190=v186*v189;
  const casadi_real v191=casadi_fmax(v188,i4[0]);
  const casadi_real v192=i4[0]/v191;
  const casadi_real v194=3.0+i4[0];
  const casadi_real v195=i4[0]/v194;
  const casadi_real v196=casadi_fmax(v192,v195);
  const casadi_real v197=v196*i0[12];
  const casadi_real v198=i0[12]-v197;
  o0[12]=v198;
  const casadi_real v199=v198*v198;
  const casadi_real v200=v196*i0[13];
  const casadi_real v201=i0[13]-v200;
  o0[13]=v201;
  const casadi_real v202=v201*v201;
  const casadi_real v203=v199+v202;
  const casadi_real v205=i2[16]*i2[16];
  const casadi_real v206=v205+1e-18;
  const casadi_real v207=v206/v188;
  const casadi_real v208=50.0*v207;
  const casadi_real v209=v203<=v208;
  const casadi_real v210=v53-i0[14];
  const casadi_real v211=v196*v210;
  const casadi_real v212=i0[14]+v211;
  o0[14]=v212;
  const casadi_real v213=v171<i0[23];
  const casadi_real v214=v181*v213;
  const casadi_real v216=v214?i0[25]:0;
  const casadi_real v217=!v214;
  const casadi_real v219=v217?i0[1]:0;
  const casadi_real v220=v216+v219;
  const casadi_real v221=v212-v220;
  const casadi_real v222=v221*v221;
  const casadi_real v225=v214?i0[29]:0;
  const casadi_real v226=!v214;
  const casadi_real v228=v226?i0[5]:0;
  const casadi_real v229=v225+v228;
  const casadi_real v230=v229+v207;
  const casadi_real v231=25.0*v230;
  const casadi_real v233=i2[16]*i2[16];
  const casadi_real v234=v233+1e-18;
  const casadi_real v235=49.0*v234;
  const casadi_real v237=casadi_fmin(v235,4e-06);
  const casadi_real v238=casadi_fmax(v231,v237);
  const casadi_real v239=v222<=v238;
  const casadi_real v240=v209*v239;
  const casadi_real v241=v190*v240;
  const casadi_real v243=v214?i0[24]:0;
  const casadi_real v245=v217?i0[0]:0;
  const casadi_real v246=v243+v245;
  const casadi_real v247=v241?v246:0;
  const casadi_real v248=!v241;
  const casadi_real v249=v248?v246:0;
  const casadi_real v250=v247+v249;
  const casadi_real v251=0.5<i1[8];
  const casadi_real v252=1.0-v251;
  const casadi_real v253=i2[16]*i2[16];
  const casadi_real v254=v253+1e-18;
  const casadi_real v257=10.0+i4[0];
  const casadi_real v258=i4[0]/v257;
  const casadi_real v259=casadi_fmax(v192,v258);
  const casadi_real v262=0.3+i4[0];
  const casadi_real v263=i4[0]/v262;
  const casadi_real v264=casadi_fmax(v192,v263);
  const casadi_real v265=v264*i0[9];
  const casadi_real v266=i0[9]-v265;
  o0[9]=v266;
  const casadi_real v267=v266-v198;
  const casadi_real v268=v267*v267;
  const casadi_real v269=v264*i0[10];
  const casadi_real v270=i0[10]-v269;
  o0[10]=v270;
  const casadi_real v271=v270-v201;
  const casadi_real v272=v271*v271;
  const casadi_real v273=v268+v272;
  const casadi_real v274=v53-i0[11];
  const casadi_real v275=v264*v274;
  const casadi_real v276=i0[11]+v275;
  o0[11]=v276;
  const casadi_real v277=v276-v212;
  const casadi_real v278=v277*v277;
  const casadi_real v279=v273+v278;
  const casadi_real v280=0.27160493827160487*v279;
  const casadi_real v281=v280-i0[21];
  const casadi_real v282=v259*v281;
  const casadi_real v283=i0[21]+v282;
  const casadi_real v284=v171*v283;
  o0[21]=v284;
  const casadi_real v285=3.0*v284;
  const casadi_real v287=1.3*v254;
  const casadi_real v288=v285-v287;
  const casadi_real v289=casadi_fmax(v288,0.0);
  const casadi_real v290=v254+v289;
  const casadi_real v291=v254/v290;
  const casadi_real v292=v182*v291;
  const casadi_real v293=1.0-v292;
  const casadi_real v294=v252*v293;
  const casadi_real v295=v52?v50:0;
  const casadi_real v296=v241?v220:0;
  const casadi_real v297=v248?v220:0;
  const casadi_real v298=v296+v297;
  const casadi_real v299=v295-v298;
  const casadi_real v301=v214?i0[26]:0;
  const casadi_real v303=v217?i0[2]:0;
  const casadi_real v304=v301+v303;
  const casadi_real v305=v241?v304:0;
  const casadi_real v306=v248?v304:0;
  const casadi_real v307=v305+v306;
  const casadi_real v308=1.0+v307;
  const casadi_real v309=v299/v308;
  const casadi_real v310=v294*v309;
  const casadi_real v311=v310*i4[0];
  const casadi_real v312=v250+v311;
  const casadi_real v314=v214?i0[28]:0;
  const casadi_real v316=v226?i0[4]:0;
  const casadi_real v317=v314+v316;
  const casadi_real v318=v241?v317:0;
  const casadi_real v319=!v241;
  const casadi_real v320=v319?v317:0;
  const casadi_real v321=v318+v320;
  const casadi_real v322=1.0-v169;
  const casadi_real v323=v294*v322;
  const casadi_real v324=v323/v308;
  const casadi_real v325=v324*i4[0];
  const casadi_real v327=i2[16]*i2[16];
  const casadi_real v328=v327+1e-18;
  const casadi_real v329=v328/v188;
  const casadi_real v330=v229+v329;
  const casadi_real v331=10.8*v330;
  const casadi_real v332=v221*v221;
  const casadi_real v333=v331<v332;
  const casadi_real v334=v221*v221;
  const casadi_real v335=v334-v330;
  const casadi_real v336=v333?v335:0;
  const casadi_real v337=v229+v336;
  const casadi_real v338=v241?v337:0;
  const casadi_real v339=v319?v229:0;
  const casadi_real v340=v338+v339;
  const casadi_real v341=v325*v340;
  const casadi_real v342=v321-v341;
  const casadi_real v343=v323/v308;
  const casadi_real v344=v343*v309;
  const casadi_real v345=v344*i4[0];
  const casadi_real v347=v214?i0[31]:0;
  const casadi_real v349=v226?i0[7]:0;
  const casadi_real v350=v347+v349;
  const casadi_real v351=v241?v350:0;
  const casadi_real v352=v319?v350:0;
  const casadi_real v353=v351+v352;
  const casadi_real v354=v345*v353;
  const casadi_real v355=v342-v354;
  const casadi_real v356=v323/v308;
  const casadi_real v358=i2[17]*i2[17];
  const casadi_real v359=i4[0]*i4[0];
  const casadi_real v360=v358*v359;
  const casadi_real v362=v360/2.0;
  const casadi_real v363=v356*v362;
  const casadi_real v364=v355-v363;
  const casadi_real v365=v358*i4[0];
  const casadi_real v367=1.0000000000000001e-20*i4[0];
  const casadi_real v368=v365+v367;
  const casadi_real v369=v340+v368;
  const casadi_real v370=i2[16]*i2[16];
  const casadi_real v371=v370+1e-18;
  const casadi_real v372=i2[16]*i2[16];
  const casadi_real v373=v372+1e-18;
  const casadi_real v374=1.3*v373;
  const casadi_real v375=v285-v374;
  const casadi_real v376=casadi_fmax(v375,0.0);
  const casadi_real v377=v182*v376;
  const casadi_real v378=v371+v377;
  const casadi_real v379=v378/i4[0];
  const casadi_real v380=0.5<i1[8];
  const casadi_real v382=i2[8]*i2[8];
  const casadi_real v383=v380*v382;
  const casadi_real v384=v379+v383;
  const casadi_real v385=v369+v384;
  const casadi_real v386=v295-v298;
  const casadi_real v387=v386*v386;
  const casadi_real v388=v387/25.0;
  const casadi_real v389=casadi_fmax(v385,v388);
  const casadi_real v390=v364/v389;
  const casadi_real v391=v390*v386;
  const casadi_real v392=v312+v391;
  const casadi_real v393=v185?v392:0;
  const casadi_real v394=!v185;
  const casadi_real v395=v394?v312:0;
  const casadi_real v396=v393+v395;
  const casadi_real v398=v214?i0[27]:0;
  const casadi_real v400=v226?i0[3]:0;
  const casadi_real v401=v398+v400;
  const casadi_real v402=v241?v401:0;
  const casadi_real v403=v319?v401:0;
  const casadi_real v404=v402+v403;
  const casadi_real v405=v214?i0[28]:0;
  const casadi_real v406=v226?i0[4]:0;
  const casadi_real v407=v405+v406;
  const casadi_real v408=v241?v407:0;
  const casadi_real v409=v319?v407:0;
  const casadi_real v410=v408+v409;
  const casadi_real v411=v325*v410;
  const casadi_real v412=v404-v411;
  const casadi_real v414=v214?i0[30]:0;
  const casadi_real v416=v226?i0[6]:0;
  const casadi_real v417=v414+v416;
  const casadi_real v418=v241?v417:0;
  const casadi_real v419=v319?v417:0;
  const casadi_real v420=v418+v419;
  const casadi_real v421=v345*v420;
  const casadi_real v422=v412-v421;
  const casadi_real v423=v355*v325;
  const casadi_real v424=v422-v423;
  const casadi_real v425=v214?i0[30]:0;
  const casadi_real v426=v226?i0[6]:0;
  const casadi_real v427=v425+v426;
  const casadi_real v428=v241?v427:0;
  const casadi_real v429=v319?v427:0;
  const casadi_real v430=v428+v429;
  const casadi_real v431=v214?i0[31]:0;
  const casadi_real v432=v226?i0[7]:0;
  const casadi_real v433=v431+v432;
  const casadi_real v434=v241?v433:0;
  const casadi_real v435=v319?v433:0;
  const casadi_real v436=v434+v435;
  const casadi_real v437=v325*v436;
  const casadi_real v438=v430-v437;
  const casadi_real v440=v214?i0[32]:0;
  const casadi_real v442=v226?i0[8]:0;
  const casadi_real v443=v440+v442;
  const casadi_real v444=v241?v443:0;
  const casadi_real v445=v319?v443:0;
  const casadi_real v446=v444+v445;
  const casadi_real v447=v345*v446;
  const casadi_real v448=v438-v447;
  const casadi_real v449=v448*v345;
  const casadi_real v450=v424-v449;
  const casadi_real v451=1./v308;
  const casadi_real v452=v451*v451;
  const casadi_real v453=i2[16]*i2[16];
  const casadi_real v454=v453+1e-18;
  const casadi_real v455=v454*i4[0];
  const casadi_real v456=i4[0]*i4[0];
  const casadi_real v457=i4[0]*v456;
  const casadi_real v458=v358*v457;
  const casadi_real v459=v458/3.0;
  const casadi_real v460=v455+v459;
  const casadi_real v461=v452*v460;
  const casadi_real v463=i2[7]*i2[7];
  const casadi_real v464=v309*v309;
  const casadi_real v465=v463*v464;
  const casadi_real v466=v465*i4[0];
  const casadi_real v467=v461+v466;
  const casadi_real v468=v323*v467;
  const casadi_real v469=v169*v294;
  const casadi_real v471=i2[12]*i2[12];
  const casadi_real v473=i0[47]+i4[0];
  const casadi_real v474=v169?v473:0;
  o0[47]=v474;
  const casadi_real v475=casadi_fmin(v474,1.0);
  const casadi_real v476=v475*v475;
  const casadi_real v477=v169*i4[0];
  const casadi_real v478=v474-v477;
  const casadi_real v479=casadi_fmin(v478,1.0);
  const casadi_real v480=v479*v479;
  const casadi_real v481=v476-v480;
  const casadi_real v482=v474-v475;
  const casadi_real v483=v478-v479;
  const casadi_real v484=v482-v483;
  const casadi_real v485=2.*v484;
  const casadi_real v486=v481+v485;
  const casadi_real v487=v471*v486;
  const casadi_real v488=v469*v487;
  const casadi_real v489=v468+v488;
  const casadi_real v490=v450+v489;
  const casadi_real v491=v390*v364;
  const casadi_real v492=v490-v491;
  const casadi_real v493=v185?v492:0;
  const casadi_real v494=!v185;
  const casadi_real v495=v494?v490:0;
  const casadi_real v496=v493+v495;
  const casadi_real v497=v14?i1[7]:0;
  const casadi_real v499=casadi_fmax(v497,1e-12);
  const casadi_real v500=v496+v499;
  const casadi_real v501=i1[5]-v396;
  const casadi_real v503=v501+3.141592653589793;
  const casadi_real v504=v503/6.283185307179586;
  const casadi_real v505=floor(v504);
  const casadi_real v506=6.283185307179586*v505;
  const casadi_real v507=v501-v506;
  const casadi_real v508=v507*v507;
  const casadi_real v509=v14?v508:0;
  const casadi_real v510=v14?v509:0;
  const casadi_real v511=v510/25.0;
  const casadi_real v512=casadi_fmax(v500,v511);
  const casadi_real v513=v496/v512;
  const casadi_real v514=v513*v507;
  const casadi_real v515=v14?v514:0;
  const casadi_real v516=v396+v515;
  const casadi_real v517=v14?v516:0;
  const casadi_real v518=!v14;
  const casadi_real v519=v518?v396:0;
  const casadi_real v520=v517+v519;
  o0[0]=v520;
  o1[7]=v520;
  const casadi_real v521=v369/v389;
  const casadi_real v522=v521*v386;
  const casadi_real v523=v298+v522;
  const casadi_real v524=v185?v523:0;
  const casadi_real v525=v394?v298:0;
  const casadi_real v526=v524+v525;
  const casadi_real v527=v340*v325;
  const casadi_real v528=v410-v527;
  const casadi_real v529=v436*v345;
  const casadi_real v530=v528-v529;
  const casadi_real v531=v530-v363;
  const casadi_real v532=v521*v364;
  const casadi_real v533=v531-v532;
  const casadi_real v534=v185?v533:0;
  const casadi_real v535=v494?v531:0;
  const casadi_real v536=v534+v535;
  const casadi_real v537=v536/v512;
  const casadi_real v538=v537*v507;
  const casadi_real v539=v14?v538:0;
  const casadi_real v540=v526+v539;
  const casadi_real v541=v14?v540:0;
  const casadi_real v542=v518?v526:0;
  const casadi_real v543=v541+v542;
  o0[1]=v543;
  o1[2]=v543;
  const casadi_real v544=v353/v389;
  const casadi_real v545=v544*v386;
  const casadi_real v546=v307+v545;
  const casadi_real v547=v185?v546:0;
  const casadi_real v548=v394?v307:0;
  const casadi_real v549=v547+v548;
  const casadi_real v550=v353*v325;
  const casadi_real v551=v420-v550;
  const casadi_real v552=v446*v345;
  const casadi_real v553=v551-v552;
  const casadi_real v554=v544*v364;
  const casadi_real v555=v553-v554;
  const casadi_real v556=v185?v555:0;
  const casadi_real v557=v494?v553:0;
  const casadi_real v558=v556+v557;
  const casadi_real v559=v558/v512;
  const casadi_real v560=v559*v507;
  const casadi_real v561=v14?v560:0;
  const casadi_real v562=v549+v561;
  const casadi_real v563=v14?v562:0;
  const casadi_real v564=v518?v549:0;
  const casadi_real v565=v563+v564;
  o0[2]=v565;
  o1[4]=v565;
  const casadi_real v566=v513*v496;
  const casadi_real v567=v496-v566;
  const casadi_real v568=v14?v567:0;
  const casadi_real v569=!v14;
  const casadi_real v570=v569?v496:0;
  const casadi_real v571=v568+v570;
  o0[3]=v571;
  const casadi_real v572=v390*v369;
  const casadi_real v573=v364-v572;
  const casadi_real v574=v185?v573:0;
  const casadi_real v575=v494?v364:0;
  const casadi_real v576=v574+v575;
  const casadi_real v577=v513*v536;
  const casadi_real v578=v576-v577;
  const casadi_real v579=v14?v578:0;
  const casadi_real v580=v569?v576:0;
  const casadi_real v581=v579+v580;
  o0[4]=v581;
  const casadi_real v582=v521*v369;
  const casadi_real v583=v369-v582;
  const casadi_real v584=v185?v583:0;
  const casadi_real v585=v494?v369:0;
  const casadi_real v586=v584+v585;
  const casadi_real v587=v537*v536;
  const casadi_real v588=v586-v587;
  const casadi_real v589=v14?v588:0;
  const casadi_real v590=v569?v586:0;
  const casadi_real v591=v589+v590;
  o0[5]=v591;
  const casadi_real v592=v390*v353;
  const casadi_real v593=v448-v592;
  const casadi_real v594=v185?v593:0;
  const casadi_real v595=v494?v448:0;
  const casadi_real v596=v594+v595;
  const casadi_real v597=v513*v558;
  const casadi_real v598=v596-v597;
  const casadi_real v599=v14?v598:0;
  const casadi_real v600=v569?v596:0;
  const casadi_real v601=v599+v600;
  o0[6]=v601;
  const casadi_real v602=v521*v353;
  const casadi_real v603=v436-v602;
  const casadi_real v604=v185?v603:0;
  const casadi_real v605=v494?v436:0;
  const casadi_real v606=v604+v605;
  const casadi_real v607=v537*v558;
  const casadi_real v608=v606-v607;
  const casadi_real v609=v14?v608:0;
  const casadi_real v610=v569?v606:0;
  const casadi_real v611=v609+v610;
  o0[7]=v611;
  const casadi_real v613=i2[13]*i2[13];
  const casadi_real v614=v613*i4[0];
  const casadi_real v615=v446+v614;
  const casadi_real v616=v544*v353;
  const casadi_real v617=v615-v616;
  const casadi_real v618=v185?v617:0;
  const casadi_real v619=v494?v615:0;
  const casadi_real v620=v618+v619;
  const casadi_real v621=v559*v558;
  const casadi_real v622=v620-v621;
  const casadi_real v623=v14?v622:0;
  const casadi_real v624=v569?v620:0;
  const casadi_real v625=v623+v624;
  o0[8]=v625;
  const casadi_real v626=0.3+i4[0];
  const casadi_real v627=i4[0]/v626;
  const casadi_real v628=casadi_fmax(v192,v627);
  const casadi_real v629=v105-i0[15];
  const casadi_real v630=v628*v629;
  const casadi_real v631=i0[15]+v630;
  o0[15]=v631;
  const casadi_real v632=v109-i0[16];
  const casadi_real v633=v628*v632;
  const casadi_real v634=i0[16]+v633;
  o0[16]=v634;
  const casadi_real v635=v114-i0[17];
  const casadi_real v636=v628*v635;
  const casadi_real v637=i0[17]+v636;
  o0[17]=v637;
  const casadi_real v638=3.0+i4[0];
  const casadi_real v639=i4[0]/v638;
  const casadi_real v640=casadi_fmax(v192,v639);
  const casadi_real v641=v105-i0[18];
  const casadi_real v642=v640*v641;
  const casadi_real v643=i0[18]+v642;
  o0[18]=v643;
  const casadi_real v644=v109-i0[19];
  const casadi_real v645=v640*v644;
  const casadi_real v646=i0[19]+v645;
  o0[19]=v646;
  const casadi_real v647=v114-i0[20];
  const casadi_real v648=v640*v647;
  const casadi_real v649=i0[20]+v648;
  o0[20]=v649;
  const casadi_real v650=v190?v240:0;
  const casadi_real v651=!v190;
  const casadi_real v652=0.0<v188;
  const casadi_real v653=i0[23]*v652;
  const casadi_real v654=v651?v653:0;
  const casadi_real v655=v650+v654;
  o0[23]=v655;
  const casadi_real v657=3.3333333333333335*i0[22];
  const casadi_real v658=floor(v657);
  const casadi_real v659=3.3333333333333335*v188;
  const casadi_real v660=floor(v659);
  const casadi_real v661=v658<v660;
  const casadi_real v663=v661?i0[33]:0;
  const casadi_real v664=!v661;
  const casadi_real v665=v664?i0[24]:0;
  const casadi_real v666=v663+v665;
  o0[24]=v666;
  const casadi_real v668=v661?i0[34]:0;
  const casadi_real v669=v664?i0[25]:0;
  const casadi_real v670=v668+v669;
  o0[25]=v670;
  const casadi_real v672=v661?i0[35]:0;
  const casadi_real v673=v664?i0[26]:0;
  const casadi_real v674=v672+v673;
  o0[26]=v674;
  const casadi_real v676=v661?i0[36]:0;
  const casadi_real v677=v664?i0[27]:0;
  const casadi_real v678=v676+v677;
  o0[27]=v678;
  const casadi_real v680=v661?i0[37]:0;
  const casadi_real v681=v664?i0[28]:0;
  const casadi_real v682=v680+v681;
  o0[28]=v682;
  const casadi_real v684=v661?i0[38]:0;
  const casadi_real v685=v664?i0[29]:0;
  const casadi_real v686=v684+v685;
  o0[29]=v686;
  const casadi_real v688=v661?i0[39]:0;
  const casadi_real v689=v664?i0[30]:0;
  const casadi_real v690=v688+v689;
  o0[30]=v690;
  const casadi_real v692=v661?i0[40]:0;
  const casadi_real v693=v664?i0[31]:0;
  const casadi_real v694=v692+v693;
  o0[31]=v694;
  const casadi_real v696=v661?i0[41]:0;
  const casadi_real v697=v664?i0[32]:0;
  const casadi_real v698=v696+v697;
  o0[32]=v698;
  const casadi_real v699=v661?v250:0;
  const casadi_real v700=!v661;
  const casadi_real v701=v700?i0[33]:0;
  const casadi_real v702=v699+v701;
  o0[33]=v702;
  const casadi_real v703=v661?v298:0;
  const casadi_real v704=v700?i0[34]:0;
  const casadi_real v705=v703+v704;
  o0[34]=v705;
  const casadi_real v706=v661?v307:0;
  const casadi_real v707=v700?i0[35]:0;
  const casadi_real v708=v706+v707;
  o0[35]=v708;
  const casadi_real v709=v661?v404:0;
  const casadi_real v710=v700?i0[36]:0;
  const casadi_real v711=v709+v710;
  o0[36]=v711;
  const casadi_real v712=v661?v321:0;
  const casadi_real v713=v700?i0[37]:0;
  const casadi_real v714=v712+v713;
  o0[37]=v714;
  const casadi_real v715=v661?v340:0;
  const casadi_real v716=v700?i0[38]:0;
  const casadi_real v717=v715+v716;
  o0[38]=v717;
  const casadi_real v718=v661?v430:0;
  const casadi_real v719=v700?i0[39]:0;
  const casadi_real v720=v718+v719;
  o0[39]=v720;
  const casadi_real v721=v661?v436:0;
  const casadi_real v722=v700?i0[40]:0;
  const casadi_real v723=v721+v722;
  o0[40]=v723;
  const casadi_real v724=v661?v446:0;
  const casadi_real v725=v700?i0[41]:0;
  const casadi_real v726=v724+v725;
  o0[41]=v726;
  o0[48]=i0[48];
  o0[49]=i0[49];
  const casadi_real v729=v520+3.141592653589793;
  const casadi_real v730=v729/6.283185307179586;
  const casadi_real v731=floor(v730);
  const casadi_real v732=6.283185307179586*v731;
  const casadi_real v733=v520-v732;
  o1[0]=v733;
  const casadi_real v734=casadi_fmax(v571,0.0);
  const casadi_real v735=sqrt(v734);
  o1[1]=v735;
  const casadi_real v736=casadi_fmax(v591,0.0);
  const casadi_real v737=sqrt(v736);
  o1[3]=v737;
  const casadi_real v738=casadi_fmax(v625,0.0);
  const casadi_real v739=sqrt(v738);
  o1[5]=v739;
  const casadi_real v740=v295-v543;
  const casadi_real v741=1.0+v565;
  const casadi_real v742=v740/v741;
  o1[6]=v742;
  const casadi_real v743=0.5<i1[8];
  const casadi_real v744=casadi_fmax(v182,v743);
  o1[8]=v744;
  const casadi_real v746=8.0*v185;
  const casadi_real v747=0.5<i1[8];
  const casadi_real v748=v746*v747;
  const casadi_real v749=v385<v389;
  const casadi_real v750=v748*v749;
  const casadi_real v752=64.0*v14;
  const casadi_real v753=v500<v512;
  const casadi_real v754=v752*v753;
  const casadi_real v755=v750+v754;
  const casadi_real v756=1.0-v14;
  const casadi_real v757=v2*v756;
  const casadi_real v758=v24*v41;
  const casadi_real v759=1.0-v758;
  const casadi_real v760=1.0-v759;
  const casadi_real v761=v757*v760;
  const casadi_real v762=v755+v761;
  const casadi_real v763=v762+v759;
  const casadi_real v764=2.*v165;
  const casadi_real v765=v763+v764;
  const casadi_real v767=128.0*v182;
  const casadi_real v768=v767*v103;
  const casadi_real v769=v765+v768;
  o1[9]=v769;
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
