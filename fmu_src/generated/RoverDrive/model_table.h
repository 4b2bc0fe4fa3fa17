/* Generated from the block RoverDrive; do not edit. */
#ifndef MODEL_TABLE_H
#define MODEL_TABLE_H

#include <math.h>

#include "block.h"

#define MODEL_NAME "RoverDrive"
#define MODEL_TOKEN_FMI2 "{8e50aaee-ec14-024a-dd3f-9c652e2f2d48}"
#define MODEL_TOKEN_FMI3 "{38cd6c37-1232-7bea-f281-fe6192bde396}"
#define MODEL_LIMITS
#define MODEL_SEED UINT64_C(0)
#define MODEL_SAMPLE_PERIOD 0.0010245901639344263

enum {
    N_INPUTS = 2,
    N_PARAMETERS = 56,
    N_OUTPUTS = 27,
    N_STATES = 45,
    N_CONSTANTS = 0,
    N_NOISE = 0,
    N_VARIABLES = 87
};

/* Room that the generated functions need. */
enum { WORK_ARG = 6, WORK_RES = 2, WORK_IW = 0, WORK_W = 673 };

/* Rows of inputs and outputs. */
enum { IN_BLOCKS = 0, START_ROWS = 1, MAX_ROWS = 1 };

/* In a step: what a sample takes says how many, as nothing breaks a step off. */
enum { MODEL_MOST_SAMPLES = 1489129 };

static const BlockVariable variables[] = {
    {"time", KIND_REAL, ROLE_TIME, 0, 1, -INFINITY, INFINITY},
    {"speed_command", KIND_REAL, ROLE_INPUT, 0, 1, -INFINITY, INFINITY},
    {"turn_rate_command", KIND_REAL, ROLE_INPUT, 1, 1, -INFINITY, INFINITY},
    {"drive", KIND_INTEGER, ROLE_FIXED, 0, 1, 0.0, 4.0},
    {"start_time", KIND_REAL, ROLE_FIXED, 1, 1, 0.0, INFINITY},
    {"heading0", KIND_REAL, ROLE_FIXED, 2, 1, -INFINITY, INFINITY},
    {"cruise_speed", KIND_REAL, ROLE_FIXED, 3, 1, 1e-06, INFINITY},
    {"length", KIND_REAL, ROLE_FIXED, 4, 1, 0.001, INFINITY},
    {"radius", KIND_REAL, ROLE_FIXED, 5, 1, 0.001, INFINITY},
    {"angle", KIND_REAL, ROLE_FIXED, 6, 1, 0.001, INFINITY},
    {"spot_turn_rate", KIND_REAL, ROLE_FIXED, 7, 1, 1e-06, INFINITY},
    {"pause", KIND_REAL, ROLE_FIXED, 8, 1, 0.0, INFINITY},
    {"ramp_time", KIND_REAL, ROLE_FIXED, 9, 1, 0.01, INFINITY},
    {"roughness", KIND_REAL, ROLE_FIXED, 10, 1, 0.0, INFINITY},
    {"terrain", KIND_INTEGER, ROLE_FIXED, 11, 1, 0.0, 67108857.0},
    {"boulders", KIND_BOOLEAN, ROLE_FIXED, 12, 1, -INFINITY, INFINITY},
    {"boulder_height[1]", KIND_REAL, ROLE_FIXED, 13, 1, 0.0, INFINITY},
    {"boulder_height[2]", KIND_REAL, ROLE_FIXED, 14, 1, 0.0, INFINITY},
    {"boulder_height[3]", KIND_REAL, ROLE_FIXED, 15, 1, 0.0, INFINITY},
    {"boulder_width[1]", KIND_REAL, ROLE_FIXED, 16, 1, 0.001, INFINITY},
    {"boulder_width[2]", KIND_REAL, ROLE_FIXED, 17, 1, 0.001, INFINITY},
    {"boulder_width[3]", KIND_REAL, ROLE_FIXED, 18, 1, 0.001, INFINITY},
    {"boulder_forward[1]", KIND_REAL, ROLE_FIXED, 19, 1, -INFINITY, INFINITY},
    {"boulder_forward[2]", KIND_REAL, ROLE_FIXED, 20, 1, -INFINITY, INFINITY},
    {"boulder_forward[3]", KIND_REAL, ROLE_FIXED, 21, 1, -INFINITY, INFINITY},
    {"boulder_left[1]", KIND_REAL, ROLE_FIXED, 22, 1, -INFINITY, INFINITY},
    {"boulder_left[2]", KIND_REAL, ROLE_FIXED, 23, 1, -INFINITY, INFINITY},
    {"boulder_left[3]", KIND_REAL, ROLE_FIXED, 24, 1, -INFINITY, INFINITY},
    {"gravity", KIND_REAL, ROLE_FIXED, 25, 1, 0.0, INFINITY},
    {"rotation_rate", KIND_REAL, ROLE_FIXED, 26, 1, -INFINITY, INFINITY},
    {"latitude", KIND_REAL, ROLE_FIXED, 27, 1, -1.5707963267948966, 1.5707963267948966},
    {"solar_day", KIND_REAL, ROLE_FIXED, 28, 1, 1.0, INFINITY},
    {"solar_declination", KIND_REAL, ROLE_FIXED, 29, 1, -1.5707963267948966, 1.5707963267948966},
    {"hour_angle", KIND_REAL, ROLE_FIXED, 30, 1, -INFINITY, INFINITY},
    {"field_strength", KIND_REAL, ROLE_FIXED, 31, 1, 0.0, INFINITY},
    {"field_dip", KIND_REAL, ROLE_FIXED, 32, 1, -1.5707963267948966, 1.5707963267948966},
    {"field_declination", KIND_REAL, ROLE_FIXED, 33, 1, -INFINITY, INFINITY},
    {"lever_arm[1]", KIND_REAL, ROLE_FIXED, 34, 1, -INFINITY, INFINITY},
    {"lever_arm[2]", KIND_REAL, ROLE_FIXED, 35, 1, -INFINITY, INFINITY},
    {"lever_arm[3]", KIND_REAL, ROLE_FIXED, 36, 1, -INFINITY, INFINITY},
    {"start_temperature", KIND_REAL, ROLE_FIXED, 37, 1, -INFINITY, INFINITY},
    {"warm_up", KIND_REAL, ROLE_FIXED, 38, 1, -INFINITY, INFINITY},
    {"warm_up_time", KIND_REAL, ROLE_FIXED, 39, 1, 0.001, INFINITY},
    {"temperature_swing", KIND_REAL, ROLE_FIXED, 40, 1, 0.0, INFINITY},
    {"warmest_hour_angle", KIND_REAL, ROLE_FIXED, 41, 1, -INFINITY, INFINITY},
    {"motor_frequency", KIND_REAL, ROLE_FIXED, 42, 1, 0.001, INFINITY},
    {"motor_rate[1]", KIND_REAL, ROLE_FIXED, 43, 1, 0.0, INFINITY},
    {"motor_rate[2]", KIND_REAL, ROLE_FIXED, 44, 1, 0.0, INFINITY},
    {"motor_rate[3]", KIND_REAL, ROLE_FIXED, 45, 1, 0.0, INFINITY},
    {"motor_force[1]", KIND_REAL, ROLE_FIXED, 46, 1, 0.0, INFINITY},
    {"motor_force[2]", KIND_REAL, ROLE_FIXED, 47, 1, 0.0, INFINITY},
    {"motor_force[3]", KIND_REAL, ROLE_FIXED, 48, 1, 0.0, INFINITY},
    {"tread_spacing", KIND_REAL, ROLE_FIXED, 49, 1, 0.001, INFINITY},
    {"tread_rate[1]", KIND_REAL, ROLE_FIXED, 50, 1, 0.0, INFINITY},
    {"tread_rate[2]", KIND_REAL, ROLE_FIXED, 51, 1, 0.0, INFINITY},
    {"tread_rate[3]", KIND_REAL, ROLE_FIXED, 52, 1, 0.0, INFINITY},
    {"tread_force[1]", KIND_REAL, ROLE_FIXED, 53, 1, 0.0, INFINITY},
    {"tread_force[2]", KIND_REAL, ROLE_FIXED, 54, 1, 0.0, INFINITY},
    {"tread_force[3]", KIND_REAL, ROLE_FIXED, 55, 1, 0.0, INFINITY},
    {"q[1]", KIND_REAL, ROLE_OUTPUT, 0, 1, -INFINITY, INFINITY},
    {"q[2]", KIND_REAL, ROLE_OUTPUT, 1, 1, -INFINITY, INFINITY},
    {"q[3]", KIND_REAL, ROLE_OUTPUT, 2, 1, -INFINITY, INFINITY},
    {"q[4]", KIND_REAL, ROLE_OUTPUT, 3, 1, -INFINITY, INFINITY},
    {"roll", KIND_REAL, ROLE_OUTPUT, 4, 1, -INFINITY, INFINITY},
    {"pitch", KIND_REAL, ROLE_OUTPUT, 5, 1, -INFINITY, INFINITY},
    {"yaw", KIND_REAL, ROLE_OUTPUT, 6, 1, -INFINITY, INFINITY},
    {"rate[1]", KIND_REAL, ROLE_OUTPUT, 7, 1, -INFINITY, INFINITY},
    {"rate[2]", KIND_REAL, ROLE_OUTPUT, 8, 1, -INFINITY, INFINITY},
    {"rate[3]", KIND_REAL, ROLE_OUTPUT, 9, 1, -INFINITY, INFINITY},
    {"specific_force[1]", KIND_REAL, ROLE_OUTPUT, 10, 1, -INFINITY, INFINITY},
    {"specific_force[2]", KIND_REAL, ROLE_OUTPUT, 11, 1, -INFINITY, INFINITY},
    {"specific_force[3]", KIND_REAL, ROLE_OUTPUT, 12, 1, -INFINITY, INFINITY},
    {"position[1]", KIND_REAL, ROLE_OUTPUT, 13, 1, -INFINITY, INFINITY},
    {"position[2]", KIND_REAL, ROLE_OUTPUT, 14, 1, -INFINITY, INFINITY},
    {"position[3]", KIND_REAL, ROLE_OUTPUT, 15, 1, -INFINITY, INFINITY},
    {"speed", KIND_REAL, ROLE_OUTPUT, 16, 1, -INFINITY, INFINITY},
    {"turn_rate", KIND_REAL, ROLE_OUTPUT, 17, 1, -INFINITY, INFINITY},
    {"temperature", KIND_REAL, ROLE_OUTPUT, 18, 1, -INFINITY, INFINITY},
    {"sun[1]", KIND_REAL, ROLE_OUTPUT, 19, 1, -INFINITY, INFINITY},
    {"sun[2]", KIND_REAL, ROLE_OUTPUT, 20, 1, -INFINITY, INFINITY},
    {"sun[3]", KIND_REAL, ROLE_OUTPUT, 21, 1, -INFINITY, INFINITY},
    {"sun_visible", KIND_BOOLEAN, ROLE_OUTPUT, 22, 1, -INFINITY, INFINITY},
    {"mag[1]", KIND_REAL, ROLE_OUTPUT, 23, 1, -INFINITY, INFINITY},
    {"mag[2]", KIND_REAL, ROLE_OUTPUT, 24, 1, -INFINITY, INFINITY},
    {"mag[3]", KIND_REAL, ROLE_OUTPUT, 25, 1, -INFINITY, INFINITY},
    {"standing", KIND_BOOLEAN, ROLE_OUTPUT, 26, 1, -INFINITY, INFINITY},
    {"sample_period", KIND_REAL, ROLE_SAMPLING, 0, 1, 0.0, INFINITY},
};

/* Value references that mean something to every block. */
enum {
    SAMPLE_PERIOD = 86,
    SEED = N_VARIABLES, /* none: there is no noise */
};

static const double input_starts[] = {0.0, 0.0};
static const double parameter_starts[] = {4.0, 60.0, 0.0, 0.01, 5.0, 1.25, 3.141592653589793, 0.02, 0.0, 2.0, 0.005, 0.0, 0.0, 0.15, 0.15, 0.0, 0.6, 0.6, 0.6, 1.5, 3.0, 4.0, 0.6, -0.6, 0.0, 9.80665, 7.292115e-05, 0.9114109353914389, 86400.0, 0.0, 0.0, 4.8957e-05, 1.17308, 0.000209, 0.0, 0.0, 0.0, 20.0, 6.0, 500.0, 0.0, 0.5235987755982988, 80.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.02, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};

/* What the parameters must keep together, and with the sample period. */
enum { N_LIMITS = 2 };

static const char *const limit_texts[] = {
    "roughness and boulders are too high for the suspension, which can follow 0.7 m between two wheels",
    "the drive is shorter than its ramp_time; make it slower or longer",
};

/* The noise stream of each channel; there is none. */
static const uint64_t noise_channels[] = {
    0
};

#endif
