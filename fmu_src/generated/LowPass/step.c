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
  const casadi_real *restrict i0=arg[0];
  const casadi_real *restrict i1=arg[1];
  const casadi_real *restrict i2=arg[2];
  const casadi_real *restrict i4=arg[4];
  casadi_real *restrict o0=res[0];
  casadi_real *restrict o1=res[1];
  const casadi_real v2=fabs(i1[0]);
  const casadi_real v4=v2<INFINITY;
  const casadi_real v5=casadi_fmax(i0[0],v4);
  o0[0]=v5;
  const casadi_real v8=fabs(i1[1]);
  const casadi_real v9=v8<INFINITY;
  const casadi_real v10=casadi_fmax(i0[1],v9);
  o0[1]=v10;
  const casadi_real v13=fabs(i1[2]);
  const casadi_real v14=v13<INFINITY;
  const casadi_real v15=casadi_fmax(i0[2],v14);
  o0[2]=v15;
  const casadi_real v18=fabs(i1[3]);
  const casadi_real v19=v18<INFINITY;
  const casadi_real v20=casadi_fmax(i0[3],v19);
  o0[3]=v20;
  const casadi_real v23=fabs(i1[4]);
  const casadi_real v24=v23<INFINITY;
  const casadi_real v25=casadi_fmax(i0[4],v24);
  o0[4]=v25;
  const casadi_real v28=fabs(i1[5]);
  const casadi_real v29=v28<INFINITY;
  const casadi_real v30=casadi_fmax(i0[5],v29);
  o0[5]=v30;
  const casadi_real v31=v4?i1[0]:0;
  const casadi_real v32=!v4;
  const casadi_real v33=!i0[0];
  const casadi_real v34=v33?v4:0;
  const casadi_real v35=v34?i1[0]:0;
  const casadi_real v36=!v34;
  const casadi_real v38=v36?i0[6]:0;
  const casadi_real v39=v35+v38;
  o0[12]=v39;
  const casadi_real v40=v32?v39:0;
  const casadi_real v41=v31+v40;
  o0[6]=v41;
  const casadi_real v42=v9?i1[1]:0;
  const casadi_real v43=!v9;
  const casadi_real v44=!i0[1];
  const casadi_real v45=v44?v9:0;
  const casadi_real v46=v45?i1[1]:0;
  const casadi_real v47=!v45;
  const casadi_real v49=v47?i0[7]:0;
  const casadi_real v50=v46+v49;
  o0[13]=v50;
  const casadi_real v51=v43?v50:0;
  const casadi_real v52=v42+v51;
  o0[7]=v52;
  const casadi_real v53=v14?i1[2]:0;
  const casadi_real v54=!v14;
  const casadi_real v55=!i0[2];
  const casadi_real v56=v55?v14:0;
  const casadi_real v57=v56?i1[2]:0;
  const casadi_real v58=!v56;
  const casadi_real v60=v58?i0[8]:0;
  const casadi_real v61=v57+v60;
  o0[14]=v61;
  const casadi_real v62=v54?v61:0;
  const casadi_real v63=v53+v62;
  o0[8]=v63;
  const casadi_real v64=v19?i1[3]:0;
  const casadi_real v65=!v19;
  const casadi_real v66=!i0[3];
  const casadi_real v67=v66?v19:0;
  const casadi_real v68=v67?i1[3]:0;
  const casadi_real v69=!v67;
  const casadi_real v71=v69?i0[9]:0;
  const casadi_real v72=v68+v71;
  o0[15]=v72;
  const casadi_real v73=v65?v72:0;
  const casadi_real v74=v64+v73;
  o0[9]=v74;
  const casadi_real v75=v24?i1[4]:0;
  const casadi_real v76=!v24;
  const casadi_real v77=!i0[4];
  const casadi_real v78=v77?v24:0;
  const casadi_real v79=v78?i1[4]:0;
  const casadi_real v80=!v78;
  const casadi_real v82=v80?i0[10]:0;
  const casadi_real v83=v79+v82;
  o0[16]=v83;
  const casadi_real v84=v76?v83:0;
  const casadi_real v85=v75+v84;
  o0[10]=v85;
  const casadi_real v86=v29?i1[5]:0;
  const casadi_real v87=!v29;
  const casadi_real v88=!i0[5];
  const casadi_real v89=v88?v29:0;
  const casadi_real v90=v89?i1[5]:0;
  const casadi_real v91=!v89;
  const casadi_real v93=v91?i0[11]:0;
  const casadi_real v94=v90+v93;
  o0[17]=v94;
  const casadi_real v95=v87?v94:0;
  const casadi_real v96=v86+v95;
  o0[11]=v96;
  const casadi_real v99=0.0<i2[0];
  const casadi_real v104=6.283185307179586*i2[0];
  const casadi_real v106=v104*i4[0];
  const casadi_real v107=v106/2.0;
  const casadi_real v108=0.6366197723675814*v107;
  const casadi_real v110=v108+0.5;
  const casadi_real v111=floor(v110);
  const casadi_real v113=v111/4.0;
  const casadi_real v114=floor(v113);
  const casadi_real v115=4.0*v114;
  const casadi_real v116=v111-v115;
  const casadi_real v117=2.0<=v116;
  const casadi_real v118=2.*v117;
  const casadi_real v119=1.0-v118;
  const casadi_real v120=v116/2.0;
  const casadi_real v121=floor(v120);
  const casadi_real v122=2.*v121;
  const casadi_real v123=v116-v122;
  const casadi_real v125=1.570796251296997*v111;
  const casadi_real v126=v107-v125;
  const casadi_real v128=7.549789415861596e-08*v111;
  const casadi_real v129=v126-v128;
  const casadi_real v131=5.390302858158119e-15*v111;
  const casadi_real v132=v129-v131;
  const casadi_real v133=v132*v132;
  const casadi_real v134=v133/2.0;
  const casadi_real v135=1.0-v134;
  const casadi_real v136=v133*v133;
  const casadi_real v138=(-1.1358536521387682e-11)*v133;
  const casadi_real v140=v138+2.087570084197473e-09;
  const casadi_real v141=v140*v133;
  const casadi_real v143=v141+(-2.755731417929674e-07);
  const casadi_real v144=v143*v133;
  const casadi_real v146=v144+2.4801587288851704e-05;
  const casadi_real v147=v146*v133;
  const casadi_real v149=v147+(-0.0013888888888873056);
  const casadi_real v150=v149*v133;
  const casadi_real v152=v150+0.041666666666666595;
  const casadi_real v153=v136*v152;
  const casadi_real v154=v135+v153;
  const casadi_real v155=v123?v154:0;
  const casadi_real v156=!v123;
  const casadi_real v158=1.5896230157654656e-10*v133;
  const casadi_real v160=v158+(-2.5050747762857807e-08);
  const casadi_real v161=v160*v133;
  const casadi_real v163=v161+2.7557313621385722e-06;
  const casadi_real v164=v163*v133;
  const casadi_real v166=v164+(-0.0001984126982958954);
  const casadi_real v167=v166*v133;
  const casadi_real v169=v167+0.008333333333322118;
  const casadi_real v170=v169*v133;
  const casadi_real v172=v170+(-0.1666666666666663);
  const casadi_real v173=v133*v172;
  const casadi_real v174=v132*v173;
  const casadi_real v175=v132+v174;
  const casadi_real v176=v156?v175:0;
  const casadi_real v177=v155+v176;
  const casadi_real v178=v119*v177;
  const casadi_real v179=0.6366197723675814*v107;
  const casadi_real v180=v179+0.5;
  const casadi_real v181=floor(v180);
  const casadi_real v182=v181+1.0;
  const casadi_real v183=v182/4.0;
  const casadi_real v184=floor(v183);
  const casadi_real v185=4.0*v184;
  const casadi_real v186=v182-v185;
  const casadi_real v187=2.0<=v186;
  const casadi_real v188=2.*v187;
  const casadi_real v189=1.0-v188;
  const casadi_real v190=v186/2.0;
  const casadi_real v191=floor(v190);
  const casadi_real v192=2.*v191;
  const casadi_real v193=v186-v192;
  const casadi_real v194=1.570796251296997*v181;
  const casadi_real v195=v107-v194;
  const casadi_real v196=7.549789415861596e-08*v181;
  const casadi_real v197=v195-v196;
  const casadi_real v198=5.390302858158119e-15*v181;
  const casadi_real v199=v197-v198;
  const casadi_real v200=v199*v199;
  const casadi_real v201=v200/2.0;
  const casadi_real v202=1.0-v201;
  const casadi_real v203=v200*v200;
  const casadi_real v204=(-1.1358536521387682e-11)*v200;
  const casadi_real v205=v204+2.087570084197473e-09;
  const casadi_real v206=v205*v200;
  const casadi_real v207=v206+(-2.755731417929674e-07);
  const casadi_real v208=v207*v200;
  const casadi_real v209=v208+2.4801587288851704e-05;
  const casadi_real v210=v209*v200;
  const casadi_real v211=v210+(-0.0013888888888873056);
  const casadi_real v212=v211*v200;
  const casadi_real v213=v212+0.041666666666666595;
  const casadi_real v214=v203*v213;
  const casadi_real v215=v202+v214;
  const casadi_real v216=v193?v215:0;
  const casadi_real v217=!v193;
  const casadi_real v218=1.5896230157654656e-10*v200;
  const casadi_real v219=v218+(-2.5050747762857807e-08);
  const casadi_real v220=v219*v200;
  const casadi_real v221=v220+2.7557313621385722e-06;
  const casadi_real v222=v221*v200;
  const casadi_real v223=v222+(-0.0001984126982958954);
  const casadi_real v224=v223*v200;
  const casadi_real v225=v224+0.008333333333322118;
  const casadi_real v226=v225*v200;
  const casadi_real v227=v226+(-0.1666666666666663);
  const casadi_real v228=v200*v227;
  const casadi_real v229=v199*v228;
  const casadi_real v230=v199+v229;
  const casadi_real v231=v217?v230:0;
  const casadi_real v232=v216+v231;
  const casadi_real v233=v189*v232;
  const casadi_real v234=v178/v233;
  const casadi_real v235=v234*v234;
  const casadi_real v237=1.4142135623730951*v234;
  const casadi_real v238=1.0+v237;
  const casadi_real v239=v234*v234;
  const casadi_real v240=v238+v239;
  const casadi_real v241=v235/v240;
  const casadi_real v242=v241*v41;
  const casadi_real v243=2.*v241;
  const casadi_real v244=v243*v39;
  const casadi_real v245=v242+v244;
  const casadi_real v246=v34?i1[0]:0;
  const casadi_real v247=!v34;
  const casadi_real v249=v247?i0[12]:0;
  const casadi_real v250=v246+v249;
  const casadi_real v251=v241*v250;
  const casadi_real v252=v245+v251;
  const casadi_real v253=v234*v234;
  const casadi_real v254=v253-1.0;
  const casadi_real v255=2.*v254;
  const casadi_real v256=v255/v240;
  const casadi_real v257=v34?i1[0]:0;
  const casadi_real v258=!v34;
  const casadi_real v260=v258?i0[18]:0;
  const casadi_real v261=v257+v260;
  o0[24]=v261;
  const casadi_real v262=v256*v261;
  const casadi_real v263=v252-v262;
  const casadi_real v264=1.4142135623730951*v234;
  const casadi_real v265=1.0-v264;
  const casadi_real v266=v234*v234;
  const casadi_real v267=v265+v266;
  const casadi_real v268=v267/v240;
  const casadi_real v269=v34?i1[0]:0;
  const casadi_real v270=!v34;
  const casadi_real v272=v270?i0[24]:0;
  const casadi_real v273=v269+v272;
  const casadi_real v274=v268*v273;
  const casadi_real v275=v263-v274;
  const casadi_real v276=v99?v275:0;
  const casadi_real v277=!v99;
  const casadi_real v278=v277?v41:0;
  const casadi_real v279=v276+v278;
  o0[18]=v279;
  const casadi_real v280=v241*v52;
  const casadi_real v281=v243*v50;
  const casadi_real v282=v280+v281;
  const casadi_real v283=v45?i1[1]:0;
  const casadi_real v284=!v45;
  const casadi_real v286=v284?i0[13]:0;
  const casadi_real v287=v283+v286;
  const casadi_real v288=v241*v287;
  const casadi_real v289=v282+v288;
  const casadi_real v290=v45?i1[1]:0;
  const casadi_real v291=!v45;
  const casadi_real v293=v291?i0[19]:0;
  const casadi_real v294=v290+v293;
  o0[25]=v294;
  const casadi_real v295=v256*v294;
  const casadi_real v296=v289-v295;
  const casadi_real v297=v45?i1[1]:0;
  const casadi_real v298=!v45;
  const casadi_real v300=v298?i0[25]:0;
  const casadi_real v301=v297+v300;
  const casadi_real v302=v268*v301;
  const casadi_real v303=v296-v302;
  const casadi_real v304=v99?v303:0;
  const casadi_real v305=v277?v52:0;
  const casadi_real v306=v304+v305;
  o0[19]=v306;
  const casadi_real v307=v241*v63;
  const casadi_real v308=v243*v61;
  const casadi_real v309=v307+v308;
  const casadi_real v310=v56?i1[2]:0;
  const casadi_real v311=!v56;
  const casadi_real v313=v311?i0[14]:0;
  const casadi_real v314=v310+v313;
  const casadi_real v315=v241*v314;
  const casadi_real v316=v309+v315;
  const casadi_real v317=v56?i1[2]:0;
  const casadi_real v318=!v56;
  const casadi_real v320=v318?i0[20]:0;
  const casadi_real v321=v317+v320;
  o0[26]=v321;
  const casadi_real v322=v256*v321;
  const casadi_real v323=v316-v322;
  const casadi_real v324=v56?i1[2]:0;
  const casadi_real v325=!v56;
  const casadi_real v327=v325?i0[26]:0;
  const casadi_real v328=v324+v327;
  const casadi_real v329=v268*v328;
  const casadi_real v330=v323-v329;
  const casadi_real v331=v99?v330:0;
  const casadi_real v332=v277?v63:0;
  const casadi_real v333=v331+v332;
  o0[20]=v333;
  const casadi_real v334=v241*v74;
  const casadi_real v335=v243*v72;
  const casadi_real v336=v334+v335;
  const casadi_real v337=v67?i1[3]:0;
  const casadi_real v338=!v67;
  const casadi_real v340=v338?i0[15]:0;
  const casadi_real v341=v337+v340;
  const casadi_real v342=v241*v341;
  const casadi_real v343=v336+v342;
  const casadi_real v344=v67?i1[3]:0;
  const casadi_real v345=!v67;
  const casadi_real v347=v345?i0[21]:0;
  const casadi_real v348=v344+v347;
  o0[27]=v348;
  const casadi_real v349=v256*v348;
  const casadi_real v350=v343-v349;
  const casadi_real v351=v67?i1[3]:0;
  const casadi_real v352=!v67;
  const casadi_real v354=v352?i0[27]:0;
  const casadi_real v355=v351+v354;
  const casadi_real v356=v268*v355;
  const casadi_real v357=v350-v356;
  const casadi_real v358=v99?v357:0;
  const casadi_real v359=v277?v74:0;
  const casadi_real v360=v358+v359;
  o0[21]=v360;
  const casadi_real v361=v241*v85;
  const casadi_real v362=v243*v83;
  const casadi_real v363=v361+v362;
  const casadi_real v364=v78?i1[4]:0;
  const casadi_real v365=!v78;
  const casadi_real v367=v365?i0[16]:0;
  const casadi_real v368=v364+v367;
  const casadi_real v369=v241*v368;
  const casadi_real v370=v363+v369;
  const casadi_real v371=v78?i1[4]:0;
  const casadi_real v372=!v78;
  const casadi_real v374=v372?i0[22]:0;
  const casadi_real v375=v371+v374;
  o0[28]=v375;
  const casadi_real v376=v256*v375;
  const casadi_real v377=v370-v376;
  const casadi_real v378=v78?i1[4]:0;
  const casadi_real v379=!v78;
  const casadi_real v381=v379?i0[28]:0;
  const casadi_real v382=v378+v381;
  const casadi_real v383=v268*v382;
  const casadi_real v384=v377-v383;
  const casadi_real v385=v99?v384:0;
  const casadi_real v386=v277?v85:0;
  const casadi_real v387=v385+v386;
  o0[22]=v387;
  const casadi_real v388=v241*v96;
  const casadi_real v389=v243*v94;
  const casadi_real v390=v388+v389;
  const casadi_real v391=v89?i1[5]:0;
  const casadi_real v392=!v89;
  const casadi_real v394=v392?i0[17]:0;
  const casadi_real v395=v391+v394;
  const casadi_real v396=v241*v395;
  const casadi_real v397=v390+v396;
  const casadi_real v398=v89?i1[5]:0;
  const casadi_real v399=!v89;
  const casadi_real v401=v399?i0[23]:0;
  const casadi_real v402=v398+v401;
  o0[29]=v402;
  const casadi_real v403=v256*v402;
  const casadi_real v404=v397-v403;
  const casadi_real v405=v89?i1[5]:0;
  const casadi_real v406=!v89;
  const casadi_real v408=v406?i0[29]:0;
  const casadi_real v409=v405+v408;
  const casadi_real v410=v268*v409;
  const casadi_real v411=v404-v410;
  const casadi_real v412=v99?v411:0;
  const casadi_real v413=v277?v96:0;
  const casadi_real v414=v412+v413;
  o0[23]=v414;
  const casadi_real v415=v4?v279:0;
  const casadi_real v416=!v4;
  const casadi_real v417=v416?i1[0]:0;
  const casadi_real v418=v415+v417;
  o1[0]=v418;
  const casadi_real v419=v9?v306:0;
  const casadi_real v420=!v9;
  const casadi_real v421=v420?i1[1]:0;
  const casadi_real v422=v419+v421;
  o1[1]=v422;
  const casadi_real v423=v14?v333:0;
  const casadi_real v424=!v14;
  const casadi_real v425=v424?i1[2]:0;
  const casadi_real v426=v423+v425;
  o1[2]=v426;
  const casadi_real v427=v19?v360:0;
  const casadi_real v428=!v19;
  const casadi_real v429=v428?i1[3]:0;
  const casadi_real v430=v427+v429;
  o1[3]=v430;
  const casadi_real v431=v24?v387:0;
  const casadi_real v432=!v24;
  const casadi_real v433=v432?i1[4]:0;
  const casadi_real v434=v431+v433;
  o1[4]=v434;
  const casadi_real v435=v29?v414:0;
  const casadi_real v436=!v29;
  const casadi_real v437=v436?i1[5]:0;
  const casadi_real v438=v435+v437;
  o1[5]=v438;
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
  const casadi_real *restrict i0=arg[0];
  const casadi_real *restrict i1=arg[1];
  casadi_real *restrict o0=res[0];
  const casadi_real v2=2.*i0[0];
  const casadi_real v4=v2*i1[0];
  const casadi_real v5=1.0<=v4;
  o0[0]=v5;
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
