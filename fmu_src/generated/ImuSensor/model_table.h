/* Generated from the block ImuSensor; do not edit. */
#ifndef MODEL_TABLE_H
#define MODEL_TABLE_H

#include <math.h>

#include "block.h"

#define MODEL_NAME "ImuSensor"
#define MODEL_TOKEN_FMI2 "{5e31d50a-51b5-5c8a-6d92-fdb7a8de765a}"
#define MODEL_TOKEN_FMI3 "{e81db4f4-7182-8a99-9782-9d5767e0fcb5}"
#define MODEL_SEED UINT64_C(0)
#define MODEL_SAMPLE_PERIOD 0.0010245901639344263

enum {
    N_INPUTS = 7,
    N_PARAMETERS = 10,
    N_OUTPUTS = 7,
    N_STATES = 3,
    N_CONSTANTS = 0,
    N_NOISE = 6,
    N_VARIABLES = 27
};

/* Room that the generated functions need. */
enum { WORK_ARG = 6, WORK_RES = 2, WORK_IW = 0, WORK_W = 9 };

/* Rows of inputs and outputs. */
enum { IN_BLOCKS = 0, START_ROWS = 1, MAX_ROWS = 1 };

/* In a step: what a sample takes says how many, as nothing breaks a step off. */
enum { MODEL_MOST_SAMPLES = 16777216 };

static const BlockVariable variables[] = {
    {"time", KIND_REAL, ROLE_TIME, 0, 1, -INFINITY, INFINITY},
    {"rate[1]", KIND_REAL, ROLE_INPUT, 0, 1, -INFINITY, INFINITY},
    {"rate[2]", KIND_REAL, ROLE_INPUT, 1, 1, -INFINITY, INFINITY},
    {"rate[3]", KIND_REAL, ROLE_INPUT, 2, 1, -INFINITY, INFINITY},
    {"specific_force[1]", KIND_REAL, ROLE_INPUT, 3, 1, -INFINITY, INFINITY},
    {"specific_force[2]", KIND_REAL, ROLE_INPUT, 4, 1, -INFINITY, INFINITY},
    {"specific_force[3]", KIND_REAL, ROLE_INPUT, 5, 1, -INFINITY, INFINITY},
    {"temperature", KIND_REAL, ROLE_INPUT, 6, 1, -INFINITY, INFINITY},
    {"gyro_error.thermal_bias.kT[1]", KIND_REAL, ROLE_TUNABLE, 0, 1, -INFINITY, INFINITY},
    {"gyro_error.thermal_bias.kT[2]", KIND_REAL, ROLE_TUNABLE, 1, 1, -INFINITY, INFINITY},
    {"gyro_error.thermal_bias.kT[3]", KIND_REAL, ROLE_TUNABLE, 2, 1, -INFINITY, INFINITY},
    {"gyro_error.thermal_bias.T0", KIND_REAL, ROLE_TUNABLE, 3, 1, -INFINITY, INFINITY},
    {"gyro_error.angle_random_walk.N[1]", KIND_REAL, ROLE_TUNABLE, 4, 1, 0.0, INFINITY},
    {"gyro_error.angle_random_walk.N[2]", KIND_REAL, ROLE_TUNABLE, 5, 1, 0.0, INFINITY},
    {"gyro_error.angle_random_walk.N[3]", KIND_REAL, ROLE_TUNABLE, 6, 1, 0.0, INFINITY},
    {"gyro_error.rate_random_walk.K[1]", KIND_REAL, ROLE_TUNABLE, 7, 1, 0.0, INFINITY},
    {"gyro_error.rate_random_walk.K[2]", KIND_REAL, ROLE_TUNABLE, 8, 1, 0.0, INFINITY},
    {"gyro_error.rate_random_walk.K[3]", KIND_REAL, ROLE_TUNABLE, 9, 1, 0.0, INFINITY},
    {"gyro[1]", KIND_REAL, ROLE_OUTPUT, 0, 1, -INFINITY, INFINITY},
    {"gyro[2]", KIND_REAL, ROLE_OUTPUT, 1, 1, -INFINITY, INFINITY},
    {"gyro[3]", KIND_REAL, ROLE_OUTPUT, 2, 1, -INFINITY, INFINITY},
    {"accel[1]", KIND_REAL, ROLE_OUTPUT, 3, 1, -INFINITY, INFINITY},
    {"accel[2]", KIND_REAL, ROLE_OUTPUT, 4, 1, -INFINITY, INFINITY},
    {"accel[3]", KIND_REAL, ROLE_OUTPUT, 5, 1, -INFINITY, INFINITY},
    {"measured_temperature", KIND_REAL, ROLE_OUTPUT, 6, 1, -INFINITY, INFINITY},
    {"sample_period", KIND_REAL, ROLE_SAMPLING, 0, 1, 0.0, INFINITY},
    {"seed", KIND_UNSIGNED, ROLE_SAMPLING, 1, 1, 0.0, INFINITY},
};

/* Value references that mean something to every block. */
enum {
    SAMPLE_PERIOD = 25,
    SEED = 26,
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
