#include "noise.h"

#include <math.h>

/* ---- Philox4x64-10 ---------------------------------------------------------------------------------------------- */

static const uint64_t MULTIPLIER[2] = {UINT64_C(0xD2E7470EE14C6C93), UINT64_C(0xCA5A826395121157)};
static const uint64_t WEYL[2] = {UINT64_C(0x9E3779B97F4A7C15), UINT64_C(0xBB67AE8584CAA73B)};

#if defined(__SIZEOF_INT128__) && !defined(NOISE_PORTABLE)
__extension__ typedef unsigned __int128 uint128;

static uint64_t high_product(uint64_t a, uint64_t b) {
    return (uint64_t) (((uint128) a * b) >> 64);
}
#else
static uint64_t high_product(uint64_t a, uint64_t b) {
    const uint64_t low = UINT64_C(0xFFFFFFFF);
    uint64_t a0 = a & low, a1 = a >> 32, b0 = b & low, b1 = b >> 32;
    uint64_t middle = a1 * b0 + ((a0 * b0) >> 32);
    uint64_t carry = a0 * b1 + (middle & low);
    return a1 * b1 + (middle >> 32) + (carry >> 32);
}
#endif

void philox4x64(const uint64_t key[2], const uint64_t counter[4], uint64_t words[4]) {
    uint64_t x0 = counter[0], x1 = counter[1], x2 = counter[2], x3 = counter[3];
    uint64_t k0 = key[0], k1 = key[1];
    for (int round = 0; round < 10; round++) {
        uint64_t high0 = high_product(MULTIPLIER[0], x0), low0 = MULTIPLIER[0] * x0;
        uint64_t high1 = high_product(MULTIPLIER[1], x2), low1 = MULTIPLIER[1] * x2;
        x0 = high1 ^ x1 ^ k0;
        x1 = low1;
        x2 = high0 ^ x3 ^ k1;
        x3 = low0;
        k0 += WEYL[0];
        k1 += WEYL[1];
    }
    words[0] = x0;
    words[1] = x1;
    words[2] = x2;
    words[3] = x3;
}

/* ---- the inverse normal distribution ------------------------------------------------------------------------------
   Wichura, "Algorithm AS 241: the percentage points of the normal distribution", Applied Statistics 37 (1988),
   477-484, routine PPND16: relative error about 1e-16.  Coefficients of numerator and denominator, degree 0 first. */

static const double A[8] = {
    3.3871328727963666080e0, 1.3314166789178437745e2, 1.9715909503065514427e3, 1.3731693765509461125e4,
    4.5921953931549871457e4, 6.7265770927008700853e4, 3.3430575583588128105e4, 2.5090809287301226727e3};
static const double B[8] = {
    1.0, 4.2313330701600911252e1, 6.8718700749205790830e2, 5.3941960214247511077e3,
    2.1213794301586595867e4, 3.9307895800092710610e4, 2.8729085735721942674e4, 5.2264952788528545610e3};
static const double C[8] = {
    1.42343711074968357734e0, 4.63033784615654529590e0, 5.76949722146069140550e0, 3.64784832476320460504e0,
    1.27045825245236838258e0, 2.41780725177450611770e-1, 2.27238449892691845833e-2, 7.74545014278341407640e-4};
static const double D[8] = {
    1.0, 2.05319162663775882187e0, 1.67638483018380384940e0, 6.89767334985100004550e-1,
    1.48103976427480074590e-1, 1.51986665636164571966e-2, 5.47593808499534494600e-4, 1.05075007164441684324e-9};
static const double E[8] = {
    6.65790464350110377720e0, 5.46378491116411436990e0, 1.78482653991729133580e0, 2.96560571828504891230e-1,
    2.65321895265761230930e-2, 1.24266094738807843860e-3, 2.71155556874348757815e-5, 2.01033439929228813265e-7};
static const double F[8] = {
    1.0, 5.99832206555887937690e-1, 1.36929880922735805310e-1, 1.48753612908506148525e-2,
    7.86869131145613259100e-4, 1.84631831751005468180e-5, 1.42151175831644588870e-7, 2.04426310338993978564e-15};

static double ratio(const double a[8], const double b[8], double x) {
    double numerator = a[7], denominator = b[7];
    for (int i = 6; i >= 0; i--) {
        numerator = numerator * x + a[i];
        denominator = denominator * x + b[i];
    }
    return numerator / denominator;
}

double noise_normal(uint64_t word) {
    /* p - 1/2 for p at the middle of one of 2^53 equal cells.  Centred like this it is exact, and so is the
       probability of either tail, which as a number in (0, 1) would round to 1 in the last cell. */
    double q = ((double) ((int64_t) (word >> 11) - (INT64_C(1) << 52)) + 0.5) * 0x1p-53;
    double size = fabs(q);
    if (size <= 0.425) {
        return q * ratio(A, B, 0.180625 - q * q);
    }
    double r = sqrt(-log(0.5 - size));
    double z = r <= 5.0 ? ratio(C, D, r - 1.6) : ratio(E, F, r - 5.0);
    return q < 0.0 ? -z : z;
}

/* ---- one sample of one channel ---------------------------------------------------------------------------------- */

void noise_forget(NoiseCache *cache) {
    cache->block = UINT64_MAX; /* no sample is in it: a block is a sample number over 4 */
}

double noise_at(NoiseCache *cache, uint64_t seed, uint64_t channel, int64_t sample) {
    uint64_t block = (uint64_t) sample >> 2;
    if (cache->block != block) {
        /* numpy counts up before it draws, so its first four words have counter 1. */
        const uint64_t key[2] = {seed, channel}, counter[4] = {block + 1, 0, 0, 0};
        philox4x64(key, counter, cache->words);
        cache->block = block;
    }
    return noise_normal(cache->words[sample & 3]);
}
