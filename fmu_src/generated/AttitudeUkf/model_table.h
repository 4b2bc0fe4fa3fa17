/* Generated from the block AttitudeUkf; do not edit. */
#ifndef MODEL_TABLE_H
#define MODEL_TABLE_H

#include <math.h>

#include "block.h"

#define MODEL_NAME "AttitudeUkf"
#define MODEL_TOKEN_FMI2 "{5ba9bf5f-a8f5-7428-f0aa-a6314ed18480}"
#define MODEL_TOKEN_FMI3 "{f02337e4-e7e2-2686-bb93-48085f8f116e}"
#define MODEL_CONSTANTS
#define MODEL_SEED UINT64_C(0)
#define MODEL_SAMPLE_PERIOD 0.0010245901639344263

enum {
    N_INPUTS = 18,
    N_PARAMETERS = 65,
    N_OUTPUTS = 21,
    N_STATES = 359,
    N_CONSTANTS = 113,
    N_NOISE = 0,
    N_VARIABLES = 106
};

/* Room that the generated functions need. */
enum { WORK_ARG = 45, WORK_RES = 29, WORK_IW = 0, WORK_W = 3138 };

/* Rows of inputs and outputs. */
enum { IN_BLOCKS = 0, START_ROWS = 1, MAX_ROWS = 1 };

/* In a step: what a sample takes says how many, as nothing breaks a step off. */
enum { MODEL_MOST_SAMPLES = 757996 };

static const BlockVariable variables[] = {
    {"time", KIND_REAL, ROLE_TIME, 0, 1, -INFINITY, INFINITY},
    {"gyro[1]", KIND_REAL, ROLE_INPUT, 0, 1, -INFINITY, INFINITY},
    {"gyro[2]", KIND_REAL, ROLE_INPUT, 1, 1, -INFINITY, INFINITY},
    {"gyro[3]", KIND_REAL, ROLE_INPUT, 2, 1, -INFINITY, INFINITY},
    {"accel[1]", KIND_REAL, ROLE_INPUT, 3, 1, -INFINITY, INFINITY},
    {"accel[2]", KIND_REAL, ROLE_INPUT, 4, 1, -INFINITY, INFINITY},
    {"accel[3]", KIND_REAL, ROLE_INPUT, 5, 1, -INFINITY, INFINITY},
    {"temperature", KIND_REAL, ROLE_INPUT, 6, 1, -INFINITY, INFINITY},
    {"heading", KIND_REAL, ROLE_INPUT, 7, 1, -INFINITY, INFINITY},
    {"heading_variance", KIND_REAL, ROLE_INPUT, 8, 1, -INFINITY, INFINITY},
    {"heading_valid", KIND_BOOLEAN, ROLE_INPUT, 9, 1, -INFINITY, INFINITY},
    {"heading_age", KIND_REAL, ROLE_INPUT, 10, 1, -INFINITY, INFINITY},
    {"stationary", KIND_BOOLEAN, ROLE_INPUT, 11, 1, -INFINITY, INFINITY},
    {"speed", KIND_REAL, ROLE_INPUT, 12, 1, -INFINITY, INFINITY},
    {"speed_variance", KIND_REAL, ROLE_INPUT, 13, 1, -INFINITY, INFINITY},
    {"speed_valid", KIND_BOOLEAN, ROLE_INPUT, 14, 1, -INFINITY, INFINITY},
    {"mag[1]", KIND_REAL, ROLE_INPUT, 15, 1, -INFINITY, INFINITY},
    {"mag[2]", KIND_REAL, ROLE_INPUT, 16, 1, -INFINITY, INFINITY},
    {"mag[3]", KIND_REAL, ROLE_INPUT, 17, 1, -INFINITY, INFINITY},
    {"latitude", KIND_REAL, ROLE_TUNABLE, 0, 1, -INFINITY, INFINITY},
    {"q0[1]", KIND_REAL, ROLE_FIXED, 1, 1, -1000000.0, 1000000.0},
    {"q0[2]", KIND_REAL, ROLE_FIXED, 2, 1, -1000000.0, 1000000.0},
    {"q0[3]", KIND_REAL, ROLE_FIXED, 3, 1, -1000000.0, 1000000.0},
    {"q0[4]", KIND_REAL, ROLE_FIXED, 4, 1, -1000000.0, 1000000.0},
    {"bias0[1]", KIND_REAL, ROLE_FIXED, 5, 1, -100.0, 100.0},
    {"bias0[2]", KIND_REAL, ROLE_FIXED, 6, 1, -100.0, 100.0},
    {"bias0[3]", KIND_REAL, ROLE_FIXED, 7, 1, -100.0, 100.0},
    {"std0[1]", KIND_REAL, ROLE_FIXED, 8, 1, 0.0, 1000000.0},
    {"std0[2]", KIND_REAL, ROLE_FIXED, 9, 1, 0.0, 1000000.0},
    {"std0[3]", KIND_REAL, ROLE_FIXED, 10, 1, 0.0, 1000000.0},
    {"std0[4]", KIND_REAL, ROLE_FIXED, 11, 1, 0.0, 1000000.0},
    {"std0[5]", KIND_REAL, ROLE_FIXED, 12, 1, 0.0, 1000000.0},
    {"std0[6]", KIND_REAL, ROLE_FIXED, 13, 1, 0.0, 1000000.0},
    {"gravity", KIND_REAL, ROLE_TUNABLE, 14, 1, 0.0, INFINITY},
    {"accel_std", KIND_REAL, ROLE_TUNABLE, 15, 1, 0.0, INFINITY},
    {"accel_bias_std", KIND_REAL, ROLE_TUNABLE, 16, 1, 0.0, INFINITY},
    {"accel_correlation_time", KIND_REAL, ROLE_TUNABLE, 17, 1, 0.0, INFINITY},
    {"gravity_walk", KIND_REAL, ROLE_TUNABLE, 18, 1, 0.0, INFINITY},
    {"gravity_tolerance", KIND_REAL, ROLE_TUNABLE, 19, 1, 0.0, INFINITY},
    {"motion_tolerance", KIND_REAL, ROLE_TUNABLE, 20, 1, 0.0, INFINITY},
    {"steady_tolerance", KIND_REAL, ROLE_TUNABLE, 21, 1, 0.0, INFINITY},
    {"motion_time", KIND_REAL, ROLE_TUNABLE, 22, 1, 0.0, INFINITY},
    {"push_std", KIND_REAL, ROLE_TUNABLE, 23, 1, 0.0, INFINITY},
    {"motion_share", KIND_REAL, ROLE_TUNABLE, 24, 1, 0.0, 1.0},
    {"rate_noise", KIND_REAL, ROLE_TUNABLE, 25, 1, 0.0, INFINITY},
    {"scale_std", KIND_REAL, ROLE_TUNABLE, 26, 1, 0.0, INFINITY},
    {"axes_std", KIND_REAL, ROLE_TUNABLE, 27, 1, 0.0, INFINITY},
    {"bias_noise", KIND_REAL, ROLE_TUNABLE, 28, 1, 0.0, INFINITY},
    {"bias_drift", KIND_REAL, ROLE_TUNABLE, 29, 1, 0.0, INFINITY},
    {"motion_bias", KIND_REAL, ROLE_TUNABLE, 30, 1, 0.0, INFINITY},
    {"stationary_std", KIND_REAL, ROLE_TUNABLE, 31, 1, 0.0, INFINITY},
    {"rest_time", KIND_REAL, ROLE_TUNABLE, 32, 1, 0.0, INFINITY},
    {"rest_rate_tolerance", KIND_REAL, ROLE_TUNABLE, 33, 1, 0.0, INFINITY},
    {"rest_force_tolerance", KIND_REAL, ROLE_TUNABLE, 34, 1, 0.0, INFINITY},
    {"slip_std", KIND_REAL, ROLE_TUNABLE, 35, 1, 0.0, INFINITY},
    {"speed_tolerance", KIND_REAL, ROLE_TUNABLE, 36, 1, 0.0, INFINITY},
    {"lost_rate_std", KIND_REAL, ROLE_TUNABLE, 37, 1, 0.0, INFINITY},
    {"stuck_time", KIND_REAL, ROLE_TUNABLE, 38, 1, 0.0, INFINITY},
    {"axis_stuck_time[1]", KIND_REAL, ROLE_TUNABLE, 39, 1, 0.0, 1000000.0},
    {"axis_stuck_time[2]", KIND_REAL, ROLE_TUNABLE, 40, 1, 0.0, 1000000.0},
    {"axis_stuck_time[3]", KIND_REAL, ROLE_TUNABLE, 41, 1, 0.0, 1000000.0},
    {"axis_stuck_time[4]", KIND_REAL, ROLE_TUNABLE, 42, 1, 0.0, 1000000.0},
    {"axis_stuck_time[5]", KIND_REAL, ROLE_TUNABLE, 43, 1, 0.0, 1000000.0},
    {"axis_stuck_time[6]", KIND_REAL, ROLE_TUNABLE, 44, 1, 0.0, 1000000.0},
    {"heading_memory", KIND_REAL, ROLE_TUNABLE, 45, 1, 0.0, INFINITY},
    {"declination", KIND_REAL, ROLE_TUNABLE, 46, 1, -3.141592653589793, 3.141592653589793},
    {"field_strength", KIND_REAL, ROLE_TUNABLE, 47, 1, 0.0, INFINITY},
    {"field_dip", KIND_REAL, ROLE_TUNABLE, 48, 1, -1.5707963267948966, 1.5707963267948966},
    {"field_strength_std", KIND_REAL, ROLE_TUNABLE, 49, 1, 0.0, INFINITY},
    {"field_std", KIND_REAL, ROLE_TUNABLE, 50, 1, 0.0, INFINITY},
    {"field_time", KIND_REAL, ROLE_TUNABLE, 51, 1, 0.0, INFINITY},
    {"field_turning_std", KIND_REAL, ROLE_TUNABLE, 52, 1, 0.0, INFINITY},
    {"field_noise", KIND_REAL, ROLE_TUNABLE, 53, 1, 0.0, INFINITY},
    {"field_tolerance", KIND_REAL, ROLE_TUNABLE, 54, 1, 0.0, INFINITY},
    {"gyro_error.thermal_bias.kT[1]", KIND_REAL, ROLE_TUNABLE, 55, 1, -INFINITY, INFINITY},
    {"gyro_error.thermal_bias.kT[2]", KIND_REAL, ROLE_TUNABLE, 56, 1, -INFINITY, INFINITY},
    {"gyro_error.thermal_bias.kT[3]", KIND_REAL, ROLE_TUNABLE, 57, 1, -INFINITY, INFINITY},
    {"gyro_error.thermal_bias.T0", KIND_REAL, ROLE_TUNABLE, 58, 1, -INFINITY, INFINITY},
    {"gyro_error.angle_random_walk.N[1]", KIND_REAL, ROLE_TUNABLE, 59, 1, 0.0, INFINITY},
    {"gyro_error.angle_random_walk.N[2]", KIND_REAL, ROLE_TUNABLE, 60, 1, 0.0, INFINITY},
    {"gyro_error.angle_random_walk.N[3]", KIND_REAL, ROLE_TUNABLE, 61, 1, 0.0, INFINITY},
    {"gyro_error.rate_random_walk.K[1]", KIND_REAL, ROLE_TUNABLE, 62, 1, 0.0, INFINITY},
    {"gyro_error.rate_random_walk.K[2]", KIND_REAL, ROLE_TUNABLE, 63, 1, 0.0, INFINITY},
    {"gyro_error.rate_random_walk.K[3]", KIND_REAL, ROLE_TUNABLE, 64, 1, 0.0, INFINITY},
    {"q[1]", KIND_REAL, ROLE_OUTPUT, 0, 1, -INFINITY, INFINITY},
    {"q[2]", KIND_REAL, ROLE_OUTPUT, 1, 1, -INFINITY, INFINITY},
    {"q[3]", KIND_REAL, ROLE_OUTPUT, 2, 1, -INFINITY, INFINITY},
    {"q[4]", KIND_REAL, ROLE_OUTPUT, 3, 1, -INFINITY, INFINITY},
    {"roll", KIND_REAL, ROLE_OUTPUT, 4, 1, -INFINITY, INFINITY},
    {"pitch", KIND_REAL, ROLE_OUTPUT, 5, 1, -INFINITY, INFINITY},
    {"yaw", KIND_REAL, ROLE_OUTPUT, 6, 1, -INFINITY, INFINITY},
    {"gyro_bias[1]", KIND_REAL, ROLE_OUTPUT, 7, 1, -INFINITY, INFINITY},
    {"gyro_bias[2]", KIND_REAL, ROLE_OUTPUT, 8, 1, -INFINITY, INFINITY},
    {"gyro_bias[3]", KIND_REAL, ROLE_OUTPUT, 9, 1, -INFINITY, INFINITY},
    {"std[1]", KIND_REAL, ROLE_OUTPUT, 10, 1, -INFINITY, INFINITY},
    {"std[2]", KIND_REAL, ROLE_OUTPUT, 11, 1, -INFINITY, INFINITY},
    {"std[3]", KIND_REAL, ROLE_OUTPUT, 12, 1, -INFINITY, INFINITY},
    {"std[4]", KIND_REAL, ROLE_OUTPUT, 13, 1, -INFINITY, INFINITY},
    {"std[5]", KIND_REAL, ROLE_OUTPUT, 14, 1, -INFINITY, INFINITY},
    {"std[6]", KIND_REAL, ROLE_OUTPUT, 15, 1, -INFINITY, INFINITY},
    {"quasi_static", KIND_BOOLEAN, ROLE_OUTPUT, 16, 1, -INFINITY, INFINITY},
    {"nis", KIND_REAL, ROLE_OUTPUT, 17, 1, -INFINITY, INFINITY},
    {"status", KIND_INTEGER, ROLE_OUTPUT, 18, 1, -INFINITY, INFINITY},
    {"heading_std", KIND_REAL, ROLE_OUTPUT, 19, 1, -INFINITY, INFINITY},
    {"at_rest", KIND_BOOLEAN, ROLE_OUTPUT, 20, 1, -INFINITY, INFINITY},
    {"sample_period", KIND_REAL, ROLE_SAMPLING, 0, 1, 0.0, INFINITY},
};

/* Value references that mean something to every block. */
enum {
    SAMPLE_PERIOD = 105,
    SEED = N_VARIABLES, /* none: there is no noise */
};

static const double input_starts[] = {0.0, 0.0, 0.0, 0.0, 0.0, 9.80665, 25.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
static const double parameter_starts[] = {10.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.1, 0.1, 0.1, 0.01, 0.01, 0.01, 9.80665, 0.0001, 0.0, 0.5, 0.2, 0.25, 1.0, 0.3, 1.0, 0.0, 0.0001, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1e-05, 1.5, 0.005, 0.2, 0.1, 0.01, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 1.4e-07, 2e-07, 300.0, 1e-06, 1e-07, 0.13, 0.00034906585039886593, 0.0009773843811168245, 0.0008726646259971648, 25.0, 6.0400027647350424e-05, 6.940010882346785e-05, 5.960008507351969e-05, 2.6503147900654633e-06, 4.007793097172164e-06, 5.187506387872035e-06};

/* The noise stream of each channel; there is none. */
static const uint64_t noise_channels[] = {
    0
};

#endif
