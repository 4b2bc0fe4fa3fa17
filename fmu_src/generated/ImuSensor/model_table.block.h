/* Generated from the block ImuSensor; do not edit. */
#ifndef MODEL_TABLE_H
#define MODEL_TABLE_H

#include <math.h>

#include "block.h"

#define MODEL_NAME "ImuSensor"
#define MODEL_TOKEN_FMI2 "{65f8ac0c-2ec3-c2cb-af00-663d62df3e6b}"
#define MODEL_TOKEN_FMI3 "{a74de4a9-3275-4d9e-f211-07e4081c4543}"
#define MODEL_SEED UINT64_C(0)
#define MODEL_SAMPLE_PERIOD 0.0010245901639344263

enum {
    N_INPUTS = 7,
    N_PARAMETERS = 10,
    N_OUTPUTS = 7,
    N_STATES = 3,
    N_CONSTANTS = 0,
    N_NOISE = 6,
    N_VARIABLES = 14
};

/* Room that the generated functions need. */
enum { WORK_ARG = 6, WORK_RES = 2, WORK_IW = 0, WORK_W = 9 };

/* Rows of inputs and outputs. */
enum { IN_BLOCKS = 1, START_ROWS = 976, MAX_ROWS = 16777216 };

/* In a step: what a sample takes says how many, as nothing breaks a step off. */
enum { MODEL_MOST_SAMPLES = 16777216 };

static const BlockVariable variables[] = {
    {"time", KIND_REAL, ROLE_TIME, 0, 1, -INFINITY, INFINITY},
    {"block_size", KIND_UNSIGNED, ROLE_STRUCTURAL, 0, 1, 1.0, 16777216.0},
    {"rate", KIND_REAL, ROLE_INPUT, 0, 3, -INFINITY, INFINITY},
    {"specific_force", KIND_REAL, ROLE_INPUT, 3, 3, -INFINITY, INFINITY},
    {"temperature", KIND_REAL, ROLE_INPUT, 6, 1, -INFINITY, INFINITY},
    {"gyro_error.thermal_bias.kT", KIND_REAL, ROLE_TUNABLE, 0, 3, -INFINITY, INFINITY},
    {"gyro_error.thermal_bias.T0", KIND_REAL, ROLE_TUNABLE, 3, 1, -INFINITY, INFINITY},
    {"gyro_error.angle_random_walk.N", KIND_REAL, ROLE_TUNABLE, 4, 3, 0.0, INFINITY},
    {"gyro_error.rate_random_walk.K", KIND_REAL, ROLE_TUNABLE, 7, 3, 0.0, INFINITY},
    {"gyro", KIND_REAL, ROLE_OUTPUT, 0, 3, -INFINITY, INFINITY},
    {"accel", KIND_REAL, ROLE_OUTPUT, 3, 3, -INFINITY, INFINITY},
    {"measured_temperature", KIND_REAL, ROLE_OUTPUT, 6, 1, -INFINITY, INFINITY},
    {"sample_period", KIND_REAL, ROLE_SAMPLING, 0, 1, 0.0, INFINITY},
    {"seed", KIND_UNSIGNED, ROLE_SAMPLING, 1, 1, 0.0, INFINITY},
};

/* Value references that mean something to every block. */
enum {
    SAMPLE_PERIOD = 12,
    SEED = 13,
};

static const double input_starts[] = {0.0, 0.0, 0.0, 0.0, 0.0, 9.80665, 25.0};
static const double parameter_starts[] = {0.00034906585039886593, 0.0009773843811168245, 0.0008726646259971648, 25.0, 6.0400027647350424e-05, 6.940010882346785e-05, 5.960008507351969e-05, 2.6503147900654633e-06, 4.007793097172164e-06, 5.187506387872035e-06};

/* The noise stream of each channel. */
static const uint64_t noise_channels[] = {
    UINT64_C(2090672062), /* gyro_error.angle_random_walk.w[1] */
    UINT64_C(1471171709), /* gyro_error.angle_random_walk.w[2] */
    UINT64_C(1319861564), /* gyro_error.angle_random_walk.w[3] */
    UINT64_C(269997735), /* gyro_error.rate_random_walk.w[1] */
    UINT64_C(993690980), /* gyro_error.rate_random_walk.w[2] */
    UINT64_C(572634149), /* gyro_error.rate_random_walk.w[3] */
};

#endif
