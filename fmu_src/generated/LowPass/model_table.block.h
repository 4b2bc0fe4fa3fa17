/* Generated from the block LowPass; do not edit. */
#ifndef MODEL_TABLE_H
#define MODEL_TABLE_H

#include <math.h>

#include "block.h"

#define MODEL_NAME "LowPass"
#define MODEL_TOKEN_FMI2 "{deaa4cfd-2802-5209-1d01-2fa8e1ba07bb}"
#define MODEL_TOKEN_FMI3 "{6dda08f3-8317-597d-06b3-fc03d385a012}"
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
    N_VARIABLES = 8
};

/* Room that the generated functions need. */
enum { WORK_ARG = 6, WORK_RES = 2, WORK_IW = 0, WORK_W = 58 };

/* Rows of inputs and outputs. */
enum { IN_BLOCKS = 1, START_ROWS = 976, MAX_ROWS = 16777216 };

/* In a step: what a sample takes says how many, as nothing breaks a step off. */
enum { MODEL_MOST_SAMPLES = 16777216 };

static const BlockVariable variables[] = {
    {"time", KIND_REAL, ROLE_TIME, 0, 1, -INFINITY, INFINITY},
    {"block_size", KIND_UNSIGNED, ROLE_STRUCTURAL, 0, 1, 1.0, 16777216.0},
    {"gyro", KIND_REAL, ROLE_INPUT, 0, 3, -INFINITY, INFINITY},
    {"accel", KIND_REAL, ROLE_INPUT, 3, 3, -INFINITY, INFINITY},
    {"cutoff", KIND_REAL, ROLE_TUNABLE, 0, 1, 0.0, INFINITY},
    {"filtered_gyro", KIND_REAL, ROLE_OUTPUT, 0, 3, -INFINITY, INFINITY},
    {"filtered_accel", KIND_REAL, ROLE_OUTPUT, 3, 3, -INFINITY, INFINITY},
    {"sample_period", KIND_REAL, ROLE_SAMPLING, 0, 1, 0.0, INFINITY},
};

/* Value references that mean something to every block. */
enum {
    SAMPLE_PERIOD = 7,
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
