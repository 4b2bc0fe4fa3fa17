/* The normals of the co-simulation units for PyImu.Noise.normalByC: noise.c beside it, under a prefix of its own. */
#ifndef PYIMU_NORMAL
#define PYIMU_NORMAL

#define MODEL_PREFIX pyimu_modelica_
#include "noise.c"

double pyimu_normal(double seed, double channel, double sample) {
    NoiseCache cache;
    noise_forget(&cache);
    return noise_at(&cache, (uint64_t) seed, (uint64_t) channel, (int64_t) sample);
}

#endif
