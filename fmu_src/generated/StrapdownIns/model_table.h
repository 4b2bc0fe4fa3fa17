/* Generated from the block StrapdownIns; do not edit. */
#ifndef MODEL_TABLE_H
#define MODEL_TABLE_H

#include <math.h>

#include "block.h"

#define MODEL_NAME "StrapdownIns"
#define MODEL_TOKEN_FMI2 "{42d38bf0-4ef4-25b3-9c9f-a24459d42573}"
#define MODEL_TOKEN_FMI3 "{caaf7204-ef83-355c-89fe-8e3619680438}"
#define MODEL_SEED UINT64_C(0)
#define MODEL_SAMPLE_PERIOD 0.0010245901639344263

enum {
    N_INPUTS = 21,
    N_PARAMETERS = 63,
    N_OUTPUTS = 43,
    N_STATES = 523,
    N_CONSTANTS = 0,
    N_NOISE = 0,
    N_VARIABLES = 129
};

/* Room that the generated functions need. */
enum { WORK_ARG = 33, WORK_RES = 16, WORK_IW = 0, WORK_W = 5148 };

/* Rows of inputs and outputs. */
enum { IN_BLOCKS = 0, START_ROWS = 1, MAX_ROWS = 1 };

/* In a step: what a sample takes says how many, as nothing breaks a step off. */
enum { MODEL_MOST_SAMPLES = 380237 };

static const BlockVariable variables[] = {
    {"time", KIND_REAL, ROLE_TIME, 0, 1, -INFINITY, INFINITY},
    {"gyro[1]", KIND_REAL, ROLE_INPUT, 0, 1, -INFINITY, INFINITY},
    {"gyro[2]", KIND_REAL, ROLE_INPUT, 1, 1, -INFINITY, INFINITY},
    {"gyro[3]", KIND_REAL, ROLE_INPUT, 2, 1, -INFINITY, INFINITY},
    {"accel[1]", KIND_REAL, ROLE_INPUT, 3, 1, -INFINITY, INFINITY},
    {"accel[2]", KIND_REAL, ROLE_INPUT, 4, 1, -INFINITY, INFINITY},
    {"accel[3]", KIND_REAL, ROLE_INPUT, 5, 1, -INFINITY, INFINITY},
    {"temperature", KIND_REAL, ROLE_INPUT, 6, 1, -INFINITY, INFINITY},
    {"stationary", KIND_BOOLEAN, ROLE_INPUT, 7, 1, -INFINITY, INFINITY},
    {"speed_valid", KIND_BOOLEAN, ROLE_INPUT, 8, 1, -INFINITY, INFINITY},
    {"speed", KIND_REAL, ROLE_INPUT, 9, 1, -INFINITY, INFINITY},
    {"speed_variance", KIND_REAL, ROLE_INPUT, 10, 1, 0.0, INFINITY},
    {"position_valid", KIND_BOOLEAN, ROLE_INPUT, 11, 1, -INFINITY, INFINITY},
    {"position_measured[1]", KIND_REAL, ROLE_INPUT, 12, 1, -INFINITY, INFINITY},
    {"position_measured[2]", KIND_REAL, ROLE_INPUT, 13, 1, -INFINITY, INFINITY},
    {"position_measured[3]", KIND_REAL, ROLE_INPUT, 14, 1, -INFINITY, INFINITY},
    {"position_variance", KIND_REAL, ROLE_INPUT, 15, 1, 0.0, INFINITY},
    {"velocity_valid", KIND_BOOLEAN, ROLE_INPUT, 16, 1, -INFINITY, INFINITY},
    {"velocity_measured[1]", KIND_REAL, ROLE_INPUT, 17, 1, -INFINITY, INFINITY},
    {"velocity_measured[2]", KIND_REAL, ROLE_INPUT, 18, 1, -INFINITY, INFINITY},
    {"velocity_measured[3]", KIND_REAL, ROLE_INPUT, 19, 1, -INFINITY, INFINITY},
    {"velocity_variance", KIND_REAL, ROLE_INPUT, 20, 1, 0.0, INFINITY},
    {"latitude", KIND_REAL, ROLE_TUNABLE, 0, 1, -INFINITY, INFINITY},
    {"gravity", KIND_REAL, ROLE_TUNABLE, 1, 1, 0.001, INFINITY},
    {"heading0", KIND_REAL, ROLE_FIXED, 2, 1, -INFINITY, INFINITY},
    {"heading_std0", KIND_REAL, ROLE_FIXED, 3, 1, 0.0, INFINITY},
    {"tilt0", KIND_REAL, ROLE_FIXED, 4, 1, 0.0, INFINITY},
    {"roll0", KIND_REAL, ROLE_FIXED, 5, 1, -INFINITY, INFINITY},
    {"pitch0", KIND_REAL, ROLE_FIXED, 6, 1, -INFINITY, INFINITY},
    {"tilt_std0", KIND_REAL, ROLE_FIXED, 7, 1, 0.0, INFINITY},
    {"velocity0[1]", KIND_REAL, ROLE_FIXED, 8, 1, -INFINITY, INFINITY},
    {"velocity0[2]", KIND_REAL, ROLE_FIXED, 9, 1, -INFINITY, INFINITY},
    {"velocity0[3]", KIND_REAL, ROLE_FIXED, 10, 1, -INFINITY, INFINITY},
    {"velocity_std0", KIND_REAL, ROLE_FIXED, 11, 1, 0.0, INFINITY},
    {"climb_std0", KIND_REAL, ROLE_FIXED, 12, 1, 0.0, INFINITY},
    {"position_std0", KIND_REAL, ROLE_FIXED, 13, 1, 0.0, INFINITY},
    {"gyro_bias0[1]", KIND_REAL, ROLE_FIXED, 14, 1, -INFINITY, INFINITY},
    {"gyro_bias0[2]", KIND_REAL, ROLE_FIXED, 15, 1, -INFINITY, INFINITY},
    {"gyro_bias0[3]", KIND_REAL, ROLE_FIXED, 16, 1, -INFINITY, INFINITY},
    {"gyro_bias_std0[1]", KIND_REAL, ROLE_FIXED, 17, 1, 0.0, INFINITY},
    {"gyro_bias_std0[2]", KIND_REAL, ROLE_FIXED, 18, 1, 0.0, INFINITY},
    {"gyro_bias_std0[3]", KIND_REAL, ROLE_FIXED, 19, 1, 0.0, INFINITY},
    {"accel_bias_std0[1]", KIND_REAL, ROLE_FIXED, 20, 1, 0.0, INFINITY},
    {"accel_bias_std0[2]", KIND_REAL, ROLE_FIXED, 21, 1, 0.0, INFINITY},
    {"accel_bias_std0[3]", KIND_REAL, ROLE_FIXED, 22, 1, 0.0, INFINITY},
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
    {"lever_arm[1]", KIND_REAL, ROLE_FIXED, 33, 1, -INFINITY, INFINITY},
    {"lever_arm[2]", KIND_REAL, ROLE_FIXED, 34, 1, -INFINITY, INFINITY},
    {"lever_arm[3]", KIND_REAL, ROLE_FIXED, 35, 1, -INFINITY, INFINITY},
    {"antenna[1]", KIND_REAL, ROLE_FIXED, 36, 1, -INFINITY, INFINITY},
    {"antenna[2]", KIND_REAL, ROLE_FIXED, 37, 1, -INFINITY, INFINITY},
    {"antenna[3]", KIND_REAL, ROLE_FIXED, 38, 1, -INFINITY, INFINITY},
    {"clipped_rate_std[1]", KIND_REAL, ROLE_TUNABLE, 39, 1, 0.0, INFINITY},
    {"clipped_rate_std[2]", KIND_REAL, ROLE_TUNABLE, 40, 1, 0.0, INFINITY},
    {"clipped_rate_std[3]", KIND_REAL, ROLE_TUNABLE, 41, 1, 0.0, INFINITY},
    {"clipped_force_std[1]", KIND_REAL, ROLE_TUNABLE, 42, 1, 0.0, INFINITY},
    {"clipped_force_std[2]", KIND_REAL, ROLE_TUNABLE, 43, 1, 0.0, INFINITY},
    {"clipped_force_std[3]", KIND_REAL, ROLE_TUNABLE, 44, 1, 0.0, INFINITY},
    {"top_speed", KIND_REAL, ROLE_TUNABLE, 45, 1, 0.001, INFINITY},
    {"top_acceleration", KIND_REAL, ROLE_TUNABLE, 46, 1, 0.001, INFINITY},
    {"top_turn_rate", KIND_REAL, ROLE_TUNABLE, 47, 1, 0.001, INFINITY},
    {"speed_scale_std", KIND_REAL, ROLE_FIXED, 48, 1, 0.0, INFINITY},
    {"speed_late_std", KIND_REAL, ROLE_FIXED, 49, 1, 0.0, INFINITY},
    {"lever_arm_std", KIND_REAL, ROLE_FIXED, 50, 1, 0.0, INFINITY},
    {"crab_std", KIND_REAL, ROLE_TUNABLE, 51, 1, 0.0, INFINITY},
    {"crab_time", KIND_REAL, ROLE_TUNABLE, 52, 1, 0.001, INFINITY},
    {"gyro_error.thermal_bias.kT[1]", KIND_REAL, ROLE_TUNABLE, 53, 1, -INFINITY, INFINITY},
    {"gyro_error.thermal_bias.kT[2]", KIND_REAL, ROLE_TUNABLE, 54, 1, -INFINITY, INFINITY},
    {"gyro_error.thermal_bias.kT[3]", KIND_REAL, ROLE_TUNABLE, 55, 1, -INFINITY, INFINITY},
    {"gyro_error.thermal_bias.T0", KIND_REAL, ROLE_TUNABLE, 56, 1, -INFINITY, INFINITY},
    {"gyro_error.angle_random_walk.N[1]", KIND_REAL, ROLE_TUNABLE, 57, 1, 0.0, INFINITY},
    {"gyro_error.angle_random_walk.N[2]", KIND_REAL, ROLE_TUNABLE, 58, 1, 0.0, INFINITY},
    {"gyro_error.angle_random_walk.N[3]", KIND_REAL, ROLE_TUNABLE, 59, 1, 0.0, INFINITY},
    {"gyro_error.rate_random_walk.K[1]", KIND_REAL, ROLE_TUNABLE, 60, 1, 0.0, INFINITY},
    {"gyro_error.rate_random_walk.K[2]", KIND_REAL, ROLE_TUNABLE, 61, 1, 0.0, INFINITY},
    {"gyro_error.rate_random_walk.K[3]", KIND_REAL, ROLE_TUNABLE, 62, 1, 0.0, INFINITY},
    {"q[1]", KIND_REAL, ROLE_OUTPUT, 0, 1, -INFINITY, INFINITY},
    {"q[2]", KIND_REAL, ROLE_OUTPUT, 1, 1, -INFINITY, INFINITY},
    {"q[3]", KIND_REAL, ROLE_OUTPUT, 2, 1, -INFINITY, INFINITY},
    {"q[4]", KIND_REAL, ROLE_OUTPUT, 3, 1, -INFINITY, INFINITY},
    {"roll", KIND_REAL, ROLE_OUTPUT, 4, 1, -INFINITY, INFINITY},
    {"pitch", KIND_REAL, ROLE_OUTPUT, 5, 1, -INFINITY, INFINITY},
    {"yaw", KIND_REAL, ROLE_OUTPUT, 6, 1, -INFINITY, INFINITY},
    {"velocity[1]", KIND_REAL, ROLE_OUTPUT, 7, 1, -INFINITY, INFINITY},
    {"velocity[2]", KIND_REAL, ROLE_OUTPUT, 8, 1, -INFINITY, INFINITY},
    {"velocity[3]", KIND_REAL, ROLE_OUTPUT, 9, 1, -INFINITY, INFINITY},
    {"position[1]", KIND_REAL, ROLE_OUTPUT, 10, 1, -INFINITY, INFINITY},
    {"position[2]", KIND_REAL, ROLE_OUTPUT, 11, 1, -INFINITY, INFINITY},
    {"position[3]", KIND_REAL, ROLE_OUTPUT, 12, 1, -INFINITY, INFINITY},
    {"gyro_bias[1]", KIND_REAL, ROLE_OUTPUT, 13, 1, -INFINITY, INFINITY},
    {"gyro_bias[2]", KIND_REAL, ROLE_OUTPUT, 14, 1, -INFINITY, INFINITY},
    {"gyro_bias[3]", KIND_REAL, ROLE_OUTPUT, 15, 1, -INFINITY, INFINITY},
    {"accel_bias[1]", KIND_REAL, ROLE_OUTPUT, 16, 1, -INFINITY, INFINITY},
    {"accel_bias[2]", KIND_REAL, ROLE_OUTPUT, 17, 1, -INFINITY, INFINITY},
    {"accel_bias[3]", KIND_REAL, ROLE_OUTPUT, 18, 1, -INFINITY, INFINITY},
    {"attitude_std[1]", KIND_REAL, ROLE_OUTPUT, 19, 1, -INFINITY, INFINITY},
    {"attitude_std[2]", KIND_REAL, ROLE_OUTPUT, 20, 1, -INFINITY, INFINITY},
    {"attitude_std[3]", KIND_REAL, ROLE_OUTPUT, 21, 1, -INFINITY, INFINITY},
    {"velocity_std[1]", KIND_REAL, ROLE_OUTPUT, 22, 1, -INFINITY, INFINITY},
    {"velocity_std[2]", KIND_REAL, ROLE_OUTPUT, 23, 1, -INFINITY, INFINITY},
    {"velocity_std[3]", KIND_REAL, ROLE_OUTPUT, 24, 1, -INFINITY, INFINITY},
    {"position_std[1]", KIND_REAL, ROLE_OUTPUT, 25, 1, -INFINITY, INFINITY},
    {"position_std[2]", KIND_REAL, ROLE_OUTPUT, 26, 1, -INFINITY, INFINITY},
    {"position_std[3]", KIND_REAL, ROLE_OUTPUT, 27, 1, -INFINITY, INFINITY},
    {"gyro_bias_std[1]", KIND_REAL, ROLE_OUTPUT, 28, 1, -INFINITY, INFINITY},
    {"gyro_bias_std[2]", KIND_REAL, ROLE_OUTPUT, 29, 1, -INFINITY, INFINITY},
    {"gyro_bias_std[3]", KIND_REAL, ROLE_OUTPUT, 30, 1, -INFINITY, INFINITY},
    {"accel_bias_std[1]", KIND_REAL, ROLE_OUTPUT, 31, 1, -INFINITY, INFINITY},
    {"accel_bias_std[2]", KIND_REAL, ROLE_OUTPUT, 32, 1, -INFINITY, INFINITY},
    {"accel_bias_std[3]", KIND_REAL, ROLE_OUTPUT, 33, 1, -INFINITY, INFINITY},
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
    SAMPLE_PERIOD = 128,
    SEED = N_VARIABLES, /* none: there is no noise */
};

static const double input_starts[] = {0.0, 0.0, 0.0, 0.0, 0.0, 9.80665, 25.0, 0.0, 0.0, 0.0, 0.01, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.01};
static const double parameter_starts[] = {10.0, 9.80665, 0.0, 0.001, 0.0, 0.0, 0.0, 0.3, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.1, 0.1, 0.1, 0.5, 0.5, 0.5, 1.0, 1.0, 0.001, 1.0, 0.3, 1.0, 0.0, 0.02, 0.01, 0.1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0, 5.0, 2.0, 0.02, 0.0, 0.1, 0.01, 10.0, 0.00034906585039886593, 0.0009773843811168245, 0.0008726646259971648, 25.0, 6.0400027647350424e-05, 6.940010882346785e-05, 5.960008507351969e-05, 2.6503147900654633e-06, 4.007793097172164e-06, 5.187506387872035e-06};

/* The noise stream of each channel; there is none. */
static const uint64_t noise_channels[] = {
    0
};

#endif
