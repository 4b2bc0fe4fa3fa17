/* Generated from the block HeadingEstimator; do not edit. */
#ifndef MODEL_TABLE_H
#define MODEL_TABLE_H

#include <math.h>

#include "block.h"

#define MODEL_NAME "HeadingEstimator"
#define MODEL_TOKEN_FMI2 "{fd558c0a-b982-7d26-eed8-126b8c17005a}"
#define MODEL_TOKEN_FMI3 "{ac2e81ff-f6fb-ac09-e6e3-122601aad241}"
#define MODEL_SEED UINT64_C(0)
#define MODEL_SAMPLE_PERIOD 0.0010245901639344263

enum {
    N_INPUTS = 9,
    N_PARAMETERS = 18,
    N_OUTPUTS = 10,
    N_STATES = 51,
    N_CONSTANTS = 0,
    N_NOISE = 0,
    N_VARIABLES = 39
};

/* Room that the generated functions need. */
enum { WORK_ARG = 6, WORK_RES = 2, WORK_IW = 0, WORK_W = 94 };

/* Rows of inputs and outputs. */
enum { IN_BLOCKS = 0, START_ROWS = 1, MAX_ROWS = 1 };

/* In a step: what a sample takes says how many, as nothing breaks a step off. */
enum { MODEL_MOST_SAMPLES = 16777216 };

static const BlockVariable variables[] = {
    {"time", KIND_REAL, ROLE_TIME, 0, 1, -INFINITY, INFINITY},
    {"gyro_z", KIND_REAL, ROLE_INPUT, 0, 1, -INFINITY, INFINITY},
    {"accel[1]", KIND_REAL, ROLE_INPUT, 1, 1, -INFINITY, INFINITY},
    {"accel[2]", KIND_REAL, ROLE_INPUT, 2, 1, -INFINITY, INFINITY},
    {"accel[3]", KIND_REAL, ROLE_INPUT, 3, 1, -INFINITY, INFINITY},
    {"temperature", KIND_REAL, ROLE_INPUT, 4, 1, -INFINITY, INFINITY},
    {"heading", KIND_REAL, ROLE_INPUT, 5, 1, -INFINITY, INFINITY},
    {"heading_valid", KIND_BOOLEAN, ROLE_INPUT, 6, 1, -INFINITY, INFINITY},
    {"heading_variance", KIND_REAL, ROLE_INPUT, 7, 1, -INFINITY, INFINITY},
    {"stationary", KIND_BOOLEAN, ROLE_INPUT, 8, 1, -INFINITY, INFINITY},
    {"heading0", KIND_REAL, ROLE_FIXED, 0, 1, -1000000.0, 1000000.0},
    {"bias0", KIND_REAL, ROLE_FIXED, 1, 1, -100.0, 100.0},
    {"scale_factor0", KIND_REAL, ROLE_FIXED, 2, 1, -0.9, 9.0},
    {"std0[1]", KIND_REAL, ROLE_FIXED, 3, 1, 0.0, 1000000.0},
    {"std0[2]", KIND_REAL, ROLE_FIXED, 4, 1, 0.0, 1000000.0},
    {"std0[3]", KIND_REAL, ROLE_FIXED, 5, 1, 0.0, 1.0},
    {"correlation0", KIND_REAL, ROLE_FIXED, 6, 1, -1.0, 1.0},
    {"rate_noise", KIND_REAL, ROLE_TUNABLE, 7, 1, 0.0, INFINITY},
    {"stationary_std", KIND_REAL, ROLE_TUNABLE, 8, 1, 0.0, INFINITY},
    {"rest_time", KIND_REAL, ROLE_TUNABLE, 9, 1, 0.0, INFINITY},
    {"rest_rate_tolerance", KIND_REAL, ROLE_TUNABLE, 10, 1, 0.0, INFINITY},
    {"rest_force_tolerance", KIND_REAL, ROLE_TUNABLE, 11, 1, 0.0, INFINITY},
    {"lost_rate_std", KIND_REAL, ROLE_TUNABLE, 12, 1, 0.0, INFINITY},
    {"scale_factor_walk", KIND_REAL, ROLE_TUNABLE, 13, 1, 0.0, INFINITY},
    {"gyro_error.thermal_bias.kT[3]", KIND_REAL, ROLE_TUNABLE, 14, 1, -INFINITY, INFINITY},
    {"gyro_error.thermal_bias.T0", KIND_REAL, ROLE_TUNABLE, 15, 1, -INFINITY, INFINITY},
    {"gyro_error.angle_random_walk.N[3]", KIND_REAL, ROLE_TUNABLE, 16, 1, 0.0, INFINITY},
    {"gyro_error.rate_random_walk.K[3]", KIND_REAL, ROLE_TUNABLE, 17, 1, 0.0, INFINITY},
    {"yaw", KIND_REAL, ROLE_OUTPUT, 0, 1, -INFINITY, INFINITY},
    {"heading_std", KIND_REAL, ROLE_OUTPUT, 1, 1, -INFINITY, INFINITY},
    {"bias", KIND_REAL, ROLE_OUTPUT, 2, 1, -INFINITY, INFINITY},
    {"bias_std", KIND_REAL, ROLE_OUTPUT, 3, 1, -INFINITY, INFINITY},
    {"scale_factor", KIND_REAL, ROLE_OUTPUT, 4, 1, -INFINITY, INFINITY},
    {"scale_factor_std", KIND_REAL, ROLE_OUTPUT, 5, 1, -INFINITY, INFINITY},
    {"rate", KIND_REAL, ROLE_OUTPUT, 6, 1, -INFINITY, INFINITY},
    {"turned", KIND_REAL, ROLE_OUTPUT, 7, 1, -INFINITY, INFINITY},
    {"at_rest", KIND_BOOLEAN, ROLE_OUTPUT, 8, 1, -INFINITY, INFINITY},
    {"status", KIND_INTEGER, ROLE_OUTPUT, 9, 1, -INFINITY, INFINITY},
    {"sample_period", KIND_REAL, ROLE_SAMPLING, 0, 1, 0.0, INFINITY},
};

/* Value references that mean something to every block. */
enum {
    SAMPLE_PERIOD = 38,
    SEED = N_VARIABLES, /* none: there is no noise */
};

static const double input_starts[] = {0.0, 0.0, 0.0, 9.80665, 25.0, 0.0, 0.0, 1e-06, 0.0};
static const double parameter_starts[] = {0.0, 0.0, 0.0, 0.0, 0.01, 0.03, 0.0, 0.0, 1e-05, 1.5, 0.005, 0.2, 1.0, 0.0, 0.0008726646259971648, 25.0, 5.960008507351969e-05, 5.187506387872035e-06};

/* The noise stream of each channel; there is none. */
static const uint64_t noise_channels[] = {
    0
};

#endif
