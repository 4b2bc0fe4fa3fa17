/* Generated from the block LowPass; do not edit. */
#ifndef MODEL_TABLE_H
#define MODEL_TABLE_H

#include <math.h>

#include "block.h"

#define MODEL_NAME "LowPass"
#define MODEL_TOKEN_FMI2 "{e15be25a-36a7-a55b-4a8e-6c396e077893}"
#define MODEL_TOKEN_FMI3 "{7150a997-35e7-5912-984f-3311dfc8a62a}"
#define MODEL_LIMITS
#define MODEL_SEED UINT64_C(0)
#define MODEL_SAMPLE_PERIOD 0.0010245901639344263

enum {
    N_INPUTS = 6,
    N_PARAMETERS = 1,
    N_OUTPUTS = 6,
    N_STATES = 30,
    N_CONSTANTS = 0,
    N_NOISE = 0,
    N_VARIABLES = 15
};

/* Room that the generated functions need. */
enum { WORK_ARG = 6, WORK_RES = 2, WORK_IW = 0, WORK_W = 58 };

/* Rows of inputs and outputs. */
enum { IN_BLOCKS = 0, START_ROWS = 1, MAX_ROWS = 1 };

/* In a step: what a sample takes says how many, as nothing breaks a step off. */
enum { MODEL_MOST_SAMPLES = 16777216 };

static const BlockVariable variables[] = {
    {"time", KIND_REAL, ROLE_TIME, 0, 1, -INFINITY, INFINITY},
    {"gyro[1]", KIND_REAL, ROLE_INPUT, 0, 1, -INFINITY, INFINITY},
    {"gyro[2]", KIND_REAL, ROLE_INPUT, 1, 1, -INFINITY, INFINITY},
    {"gyro[3]", KIND_REAL, ROLE_INPUT, 2, 1, -INFINITY, INFINITY},
    {"accel[1]", KIND_REAL, ROLE_INPUT, 3, 1, -INFINITY, INFINITY},
    {"accel[2]", KIND_REAL, ROLE_INPUT, 4, 1, -INFINITY, INFINITY},
    {"accel[3]", KIND_REAL, ROLE_INPUT, 5, 1, -INFINITY, INFINITY},
    {"cutoff", KIND_REAL, ROLE_TUNABLE, 0, 1, 0.0, INFINITY},
    {"filtered_gyro[1]", KIND_REAL, ROLE_OUTPUT, 0, 1, -INFINITY, INFINITY},
    {"filtered_gyro[2]", KIND_REAL, ROLE_OUTPUT, 1, 1, -INFINITY, INFINITY},
    {"filtered_gyro[3]", KIND_REAL, ROLE_OUTPUT, 2, 1, -INFINITY, INFINITY},
    {"filtered_accel[1]", KIND_REAL, ROLE_OUTPUT, 3, 1, -INFINITY, INFINITY},
    {"filtered_accel[2]", KIND_REAL, ROLE_OUTPUT, 4, 1, -INFINITY, INFINITY},
    {"filtered_accel[3]", KIND_REAL, ROLE_OUTPUT, 5, 1, -INFINITY, INFINITY},
    {"sample_period", KIND_REAL, ROLE_SAMPLING, 0, 1, 0.0, INFINITY},
};

/* Value references that mean something to every block. */
enum {
    SAMPLE_PERIOD = 14,
    SEED = N_VARIABLES, /* none: there is no noise */
};

static const double input_starts[] = {0.0, 0.0, 0.0, 0.0, 0.0, 9.80665};
static const double parameter_starts[] = {10.0};

/* What the parameters must keep together, and with the sample period. */
enum { N_LIMITS = 1 };

static const char *const limit_texts[] = {
    "cutoff must be below half the sample rate",
};

/* The noise stream of each channel; there is none. */
static const uint64_t noise_channels[] = {
    0
};

#endif
