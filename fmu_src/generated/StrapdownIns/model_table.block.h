/* Generated from the block StrapdownIns; do not edit. */
#ifndef MODEL_TABLE_H
#define MODEL_TABLE_H

#include <math.h>

#include "block.h"

#define MODEL_NAME "StrapdownIns"
#define MODEL_TOKEN_FMI2 "{b875aa3b-5d73-b8aa-2ee1-70eb2f9534a4}"
#define MODEL_TOKEN_FMI3 "{245c2dee-4740-1a4e-5115-766656c2df9d}"
#define MODEL_SEED UINT64_C(0)
#define MODEL_SAMPLE_PERIOD 0.0010245901639344263

enum {
    N_INPUTS = 21,
    N_PARAMETERS = 63,
    N_OUTPUTS = 43,
    N_STATES = 523,
    N_CONSTANTS = 0,
    N_NOISE = 0,
    N_VARIABLES = 79
};

/* Room that the generated functions need. */
enum { WORK_ARG = 33, WORK_RES = 16, WORK_IW = 0, WORK_W = 5148 };

/* Rows of inputs and outputs. */
enum { IN_BLOCKS = 1, START_ROWS = 976, MAX_ROWS = 380237 };

/* In a step: what a sample takes says how many, as nothing breaks a step off. */
enum { MODEL_MOST_SAMPLES = 380237 };

static const BlockVariable variables[] = {
    {"time", KIND_REAL, ROLE_TIME, 0, 1, -INFINITY, INFINITY},
    {"block_size", KIND_UNSIGNED, ROLE_STRUCTURAL, 0, 1, 1.0, 380237.0},
    {"gyro", KIND_REAL, ROLE_INPUT, 0, 3, -INFINITY, INFINITY},
    {"accel", KIND_REAL, ROLE_INPUT, 3, 3, -INFINITY, INFINITY},
    {"temperature", KIND_REAL, ROLE_INPUT, 6, 1, -INFINITY, INFINITY},
    {"stationary", KIND_BOOLEAN, ROLE_INPUT, 7, 1, -INFINITY, INFINITY},
    {"speed_valid", KIND_BOOLEAN, ROLE_INPUT, 8, 1, -INFINITY, INFINITY},
    {"speed", KIND_REAL, ROLE_INPUT, 9, 1, -INFINITY, INFINITY},
    {"speed_variance", KIND_REAL, ROLE_INPUT, 10, 1, 0.0, INFINITY},
    {"position_valid", KIND_BOOLEAN, ROLE_INPUT, 11, 1, -INFINITY, INFINITY},
    {"position_measured", KIND_REAL, ROLE_INPUT, 12, 3, -INFINITY, INFINITY},
    {"position_variance", KIND_REAL, ROLE_INPUT, 15, 1, 0.0, INFINITY},
    {"velocity_valid", KIND_BOOLEAN, ROLE_INPUT, 16, 1, -INFINITY, INFINITY},
    {"velocity_measured", KIND_REAL, ROLE_INPUT, 17, 3, -INFINITY, INFINITY},
    {"velocity_variance", KIND_REAL, ROLE_INPUT, 20, 1, 0.0, INFINITY},
    {"latitude", KIND_REAL, ROLE_TUNABLE, 0, 1, -INFINITY, INFINITY},
    {"gravity", KIND_REAL, ROLE_TUNABLE, 1, 1, 0.001, INFINITY},
    {"heading0", KIND_REAL, ROLE_FIXED, 2, 1, -INFINITY, INFINITY},
    {"heading_std0", KIND_REAL, ROLE_FIXED, 3, 1, 0.0, INFINITY},
    {"tilt0", KIND_REAL, ROLE_FIXED, 4, 1, 0.0, INFINITY},
    {"roll0", KIND_REAL, ROLE_FIXED, 5, 1, -INFINITY, INFINITY},
    {"pitch0", KIND_REAL, ROLE_FIXED, 6, 1, -INFINITY, INFINITY},
    {"tilt_std0", KIND_REAL, ROLE_FIXED, 7, 1, 0.0, INFINITY},
    {"velocity0", KIND_REAL, ROLE_FIXED, 8, 3, -INFINITY, INFINITY},
    {"velocity_std0", KIND_REAL, ROLE_FIXED, 11, 1, 0.0, INFINITY},
    {"climb_std0", KIND_REAL, ROLE_FIXED, 12, 1, 0.0, INFINITY},
    {"position_std0", KIND_REAL, ROLE_FIXED, 13, 1, 0.0, INFINITY},
    {"gyro_bias0", KIND_REAL, ROLE_FIXED, 14, 3, -INFINITY, INFINITY},
    {"gyro_bias_std0", KIND_REAL, ROLE_FIXED, 17, 3, 0.0, INFINITY},
    {"accel_bias_std0", KIND_REAL, ROLE_FIXED, 20, 3, 0.0, INFINITY},
    {"zupt", KIND_REAL, ROLE_TUNABLE, 23, 1, 0.0, INFINITY},
    {"zaru", KIND_REAL, ROLE_TUNABLE, 24, 1, 0.0, INFINITY},
    {"zupt_std", KIND_REAL, ROLE_TUNABLE, 25, 1, 1e-06, INFINITY},
    {"detect", KIND_REAL, ROLE_TUNABLE, 26, 1, 0.0, INFINITY},
    {"rest_window", KIND_REAL, ROLE_TUNABLE, 27, 1, 0.001, INFINITY},
    {"rest_noise", KIND_REAL, ROLE_TUNABLE, 28, 1, 0.001, INFINITY},
    {"nhc", KIND_REAL, ROLE_TUNABLE, 29, 1, 0.0, INFINITY},
    {"nhc_std", KIND_REAL, ROLE_TUNABLE, 30, 1, 1e-06, INFINITY},
    {"nhc_angle_std", KIND_REAL, ROLE_TUNABLE, 31, 1, 0.0, INFINITY},
    {"nhc_time", KIND_REAL, ROLE_TUNABLE, 32, 1, 0.0, INFINITY},
    {"lever_arm", KIND_REAL, ROLE_FIXED, 33, 3, -INFINITY, INFINITY},
    {"antenna", KIND_REAL, ROLE_FIXED, 36, 3, -INFINITY, INFINITY},
    {"clipped_rate_std", KIND_REAL, ROLE_TUNABLE, 39, 3, 0.0, INFINITY},
    {"clipped_force_std", KIND_REAL, ROLE_TUNABLE, 42, 3, 0.0, INFINITY},
    {"top_speed", KIND_REAL, ROLE_TUNABLE, 45, 1, 0.001, INFINITY},
    {"top_acceleration", KIND_REAL, ROLE_TUNABLE, 46, 1, 0.001, INFINITY},
    {"top_turn_rate", KIND_REAL, ROLE_TUNABLE, 47, 1, 0.001, INFINITY},
    {"speed_scale_std", KIND_REAL, ROLE_FIXED, 48, 1, 0.0, INFINITY},
    {"speed_late_std", KIND_REAL, ROLE_FIXED, 49, 1, 0.0, INFINITY},
    {"lever_arm_std", KIND_REAL, ROLE_FIXED, 50, 1, 0.0, INFINITY},
    {"crab_std", KIND_REAL, ROLE_TUNABLE, 51, 1, 0.0, INFINITY},
    {"crab_time", KIND_REAL, ROLE_TUNABLE, 52, 1, 0.001, INFINITY},
    {"gyro_error.thermal_bias.kT", KIND_REAL, ROLE_TUNABLE, 53, 3, -INFINITY, INFINITY},
    {"gyro_error.thermal_bias.T0", KIND_REAL, ROLE_TUNABLE, 56, 1, -INFINITY, INFINITY},
    {"gyro_error.angle_random_walk.N", KIND_REAL, ROLE_TUNABLE, 57, 3, 0.0, INFINITY},
    {"gyro_error.rate_random_walk.K", KIND_REAL, ROLE_TUNABLE, 60, 3, 0.0, INFINITY},
    {"q", KIND_REAL, ROLE_OUTPUT, 0, 4, -INFINITY, INFINITY},
    {"roll", KIND_REAL, ROLE_OUTPUT, 4, 1, -INFINITY, INFINITY},
    {"pitch", KIND_REAL, ROLE_OUTPUT, 5, 1, -INFINITY, INFINITY},
    {"yaw", KIND_REAL, ROLE_OUTPUT, 6, 1, -INFINITY, INFINITY},
    {"velocity", KIND_REAL, ROLE_OUTPUT, 7, 3, -INFINITY, INFINITY},
    {"position", KIND_REAL, ROLE_OUTPUT, 10, 3, -INFINITY, INFINITY},
    {"gyro_bias", KIND_REAL, ROLE_OUTPUT, 13, 3, -INFINITY, INFINITY},
    {"accel_bias", KIND_REAL, ROLE_OUTPUT, 16, 3, -INFINITY, INFINITY},
    {"attitude_std", KIND_REAL, ROLE_OUTPUT, 19, 3, -INFINITY, INFINITY},
    {"velocity_std", KIND_REAL, ROLE_OUTPUT, 22, 3, -INFINITY, INFINITY},
    {"position_std", KIND_REAL, ROLE_OUTPUT, 25, 3, -INFINITY, INFINITY},
    {"gyro_bias_std", KIND_REAL, ROLE_OUTPUT, 28, 3, -INFINITY, INFINITY},
    {"accel_bias_std", KIND_REAL, ROLE_OUTPUT, 31, 3, -INFINITY, INFINITY},
    {"position_correlation", KIND_REAL, ROLE_OUTPUT, 34, 1, -INFINITY, INFINITY},
    {"zupt_nis", KIND_REAL, ROLE_OUTPUT, 35, 1, -INFINITY, INFINITY},
    {"zaru_nis", KIND_REAL, ROLE_OUTPUT, 36, 1, -INFINITY, INFINITY},
    {"nhc_nis", KIND_REAL, ROLE_OUTPUT, 37, 1, -INFINITY, INFINITY},
    {"position_nis", KIND_REAL, ROLE_OUTPUT, 38, 1, -INFINITY, INFINITY},
    {"velocity_nis", KIND_REAL, ROLE_OUTPUT, 39, 1, -INFINITY, INFINITY},
    {"speed_nis", KIND_REAL, ROLE_OUTPUT, 40, 1, -INFINITY, INFINITY},
    {"at_rest", KIND_BOOLEAN, ROLE_OUTPUT, 41, 1, -INFINITY, INFINITY},
    {"status", KIND_INTEGER, ROLE_OUTPUT, 42, 1, -INFINITY, INFINITY},
    {"sample_period", KIND_REAL, ROLE_SAMPLING, 0, 1, 0.0, INFINITY},
};

/* Value references that mean something to every block. */
enum {
    SAMPLE_PERIOD = 78,
    SEED = N_VARIABLES, /* none: there is no noise */
};

static const double input_starts[] = {0.0, 0.0, 0.0, 0.0, 0.0, 9.80665, 25.0, 0.0, 0.0, 0.0, 0.01, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.01};
static const double parameter_starts[] = {10.0, 9.80665, 0.0, 0.001, 0.0, 0.0, 0.0, 0.3, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.1, 0.1, 0.1, 0.5, 0.5, 0.5, 1.0, 1.0, 0.001, 1.0, 0.3, 1.0, 0.0, 0.02, 0.01, 0.1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0, 5.0, 2.0, 0.02, 0.0, 0.1, 0.01, 10.0, 0.00034906585039886593, 0.0009773843811168245, 0.0008726646259971648, 25.0, 6.0400027647350424e-05, 6.940010882346785e-05, 5.960008507351969e-05, 2.6503147900654633e-06, 4.007793097172164e-06, 5.187506387872035e-06};

/* The noise stream of each channel; there is none. */
static const uint64_t noise_channels[] = {
    0
};

#endif
