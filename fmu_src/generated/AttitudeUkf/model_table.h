/* Generated from the block AttitudeUkf; do not edit. */
#ifndef MODEL_TABLE_H
#define MODEL_TABLE_H

#include <math.h>

#include "block.h"

#define MODEL_NAME "AttitudeUkf"
#define MODEL_TOKEN "{a1049ad4-671c-8757-38a6-dcff354cb102}"
#define MODEL_STEP step
#define MODEL_INITIAL initial
#define MODEL_SEED UINT64_C(0)

enum {
    N_INPUTS = 11,
    N_PARAMETERS = 32,
    N_OUTPUTS = 19,
    N_STATES = 43,
    N_NOISE = 0,
    N_VARIABLES = 65
};

/* Room that the generated functions need. */
enum { WORK_ARG = 5, WORK_RES = 2, WORK_IW = 0, WORK_W = 238 };

/* Places in the table of variables, which are value references. */
enum {
    TIME = 0,
    FIRST_INPUT = TIME + 1,
    FIRST_PARAMETER = FIRST_INPUT + N_INPUTS,
    FIRST_OUTPUT = FIRST_PARAMETER + N_PARAMETERS,
    SAMPLE_PERIOD = FIRST_OUTPUT + N_OUTPUTS,
    SEED = SAMPLE_PERIOD + 1
};

static const BlockVariable variables[] = {
    {"time", KIND_REAL, ROLE_TIME, 0.0},
    {"gyro[1]", KIND_REAL, ROLE_INPUT, 0.0},
    {"gyro[2]", KIND_REAL, ROLE_INPUT, 0.0},
    {"gyro[3]", KIND_REAL, ROLE_INPUT, 0.0},
    {"accel[1]", KIND_REAL, ROLE_INPUT, 0.0},
    {"accel[2]", KIND_REAL, ROLE_INPUT, 0.0},
    {"accel[3]", KIND_REAL, ROLE_INPUT, 9.80665},
    {"temperature", KIND_REAL, ROLE_INPUT, 25.0},
    {"heading", KIND_REAL, ROLE_INPUT, 0.0},
    {"heading_variance", KIND_REAL, ROLE_INPUT, 0.0},
    {"heading_valid", KIND_BOOLEAN, ROLE_INPUT, 0.0},
    {"stationary", KIND_BOOLEAN, ROLE_INPUT, 0.0},
    {"latitude", KIND_REAL, ROLE_TUNABLE, 10.0},
    {"q0[1]", KIND_REAL, ROLE_TUNABLE, 1.0},
    {"q0[2]", KIND_REAL, ROLE_TUNABLE, 0.0},
    {"q0[3]", KIND_REAL, ROLE_TUNABLE, 0.0},
    {"q0[4]", KIND_REAL, ROLE_TUNABLE, 0.0},
    {"bias0[1]", KIND_REAL, ROLE_TUNABLE, 0.0},
    {"bias0[2]", KIND_REAL, ROLE_TUNABLE, 0.0},
    {"bias0[3]", KIND_REAL, ROLE_TUNABLE, 0.0},
    {"std0[1]", KIND_REAL, ROLE_TUNABLE, 0.1},
    {"std0[2]", KIND_REAL, ROLE_TUNABLE, 0.1},
    {"std0[3]", KIND_REAL, ROLE_TUNABLE, 0.1},
    {"std0[4]", KIND_REAL, ROLE_TUNABLE, 0.01},
    {"std0[5]", KIND_REAL, ROLE_TUNABLE, 0.01},
    {"std0[6]", KIND_REAL, ROLE_TUNABLE, 0.01},
    {"gravity", KIND_REAL, ROLE_TUNABLE, 9.80665},
    {"accel_std", KIND_REAL, ROLE_TUNABLE, 0.1},
    {"accel_correlation_time", KIND_REAL, ROLE_TUNABLE, 0.5},
    {"gravity_walk", KIND_REAL, ROLE_TUNABLE, 0.2},
    {"gravity_tolerance", KIND_REAL, ROLE_TUNABLE, 0.25},
    {"motion_tolerance", KIND_REAL, ROLE_TUNABLE, 1.0},
    {"stationary_std", KIND_REAL, ROLE_TUNABLE, 1e-05},
    {"lost_rate_std", KIND_REAL, ROLE_TUNABLE, 1.0},
    {"gyro_error.thermal_bias.kT[1]", KIND_REAL, ROLE_TUNABLE, 0.00034906585039886593},
    {"gyro_error.thermal_bias.kT[2]", KIND_REAL, ROLE_TUNABLE, 0.0009773843811168245},
    {"gyro_error.thermal_bias.kT[3]", KIND_REAL, ROLE_TUNABLE, 0.0008726646259971648},
    {"gyro_error.thermal_bias.T0", KIND_REAL, ROLE_TUNABLE, 25.0},
    {"gyro_error.angle_random_walk.N[1]", KIND_REAL, ROLE_TUNABLE, 6.0400027647350424e-05},
    {"gyro_error.angle_random_walk.N[2]", KIND_REAL, ROLE_TUNABLE, 6.940010882346785e-05},
    {"gyro_error.angle_random_walk.N[3]", KIND_REAL, ROLE_TUNABLE, 5.960008507351969e-05},
    {"gyro_error.rate_random_walk.K[1]", KIND_REAL, ROLE_TUNABLE, 2.6503147900654633e-06},
    {"gyro_error.rate_random_walk.K[2]", KIND_REAL, ROLE_TUNABLE, 4.007793097172164e-06},
    {"gyro_error.rate_random_walk.K[3]", KIND_REAL, ROLE_TUNABLE, 5.187506387872035e-06},
    {"q[1]", KIND_REAL, ROLE_OUTPUT, 1.0},
    {"q[2]", KIND_REAL, ROLE_OUTPUT, 0.0},
    {"q[3]", KIND_REAL, ROLE_OUTPUT, 0.0},
    {"q[4]", KIND_REAL, ROLE_OUTPUT, 0.0},
    {"roll", KIND_REAL, ROLE_OUTPUT, 0.0},
    {"pitch", KIND_REAL, ROLE_OUTPUT, 0.0},
    {"yaw", KIND_REAL, ROLE_OUTPUT, 0.0},
    {"gyro_bias[1]", KIND_REAL, ROLE_OUTPUT, 0.0},
    {"gyro_bias[2]", KIND_REAL, ROLE_OUTPUT, 0.0},
    {"gyro_bias[3]", KIND_REAL, ROLE_OUTPUT, 0.0},
    {"std[1]", KIND_REAL, ROLE_OUTPUT, 0.0},
    {"std[2]", KIND_REAL, ROLE_OUTPUT, 0.0},
    {"std[3]", KIND_REAL, ROLE_OUTPUT, 0.0},
    {"std[4]", KIND_REAL, ROLE_OUTPUT, 0.0},
    {"std[5]", KIND_REAL, ROLE_OUTPUT, 0.0},
    {"std[6]", KIND_REAL, ROLE_OUTPUT, 0.0},
    {"quasi_static", KIND_BOOLEAN, ROLE_OUTPUT, 0.0},
    {"nis", KIND_REAL, ROLE_OUTPUT, 0.0},
    {"status", KIND_INTEGER, ROLE_OUTPUT, 0.0},
    {"sample_period", KIND_REAL, ROLE_FIXED, 0.0010245901639344263},
    {"seed", KIND_SEED, ROLE_FIXED, 0.0},
};

/* The noise stream of each channel; there is none. */
static const uint64_t noise_channels[] = {
    0
};

#endif
