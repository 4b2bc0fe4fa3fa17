/* What the files of the core share: the state of a block, the phases of its life, and its rows. */
#ifndef BLOCK_CORE_H
#define BLOCK_CORE_H

#include "block.h"
#include "model.h"
#include "model_table.h"
#include "noise.h"

PRIVATE_FROM_HERE

#define ROOM(n) ((n) > 0 ? (n) : 1) /* C has no arrays of length zero */
#define DRAWN 64 /* samples whose noise is drawn at a time, a multiple of the four that come together */

typedef enum { INSTANTIATED, CONFIGURATION, INITIALIZATION, STEPPING, TERMINATED, N_PHASES } Phase;

/* Everything that decides what follows, and nothing derived but the outputs: this is what saving a state copies.  All
   members are eight bytes long, so there is no padding and equal states are equal bytes. */
struct BlockState {
    uint64_t layout; /* STATE_LAYOUT: what follows is a state */
    uint64_t model;  /* a number that stands for the model's token */
    uint64_t phase;
    uint64_t seed;  /* as it was set; 0: the noise is that of the instance's name */
    uint64_t name;  /* a number that stands for the instance's name; 0 for the model's own */
    uint64_t rows;  /* of inputs and of outputs: block_size in the block form, else one */
    int64_t sample; /* the last sample made; sample k belongs to time k * sample_period */
    uint64_t steps; /* communication steps so far */
    double time;
    double stop_time; /* INFINITY where there is none */
    double sample_period;
    double parameters[ROOM(N_PARAMETERS)];
    double state[ROOM(N_STATES)];
    double table[]; /* the rows of the inputs, then those of the outputs; the last row of these is the last sample's */
};

struct Block {
    struct BlockState *now;
    NoiseCache noise[ROOM(N_NOISE)];
    double normals[DRAWN * ROOM(N_NOISE)];
    double next_state[ROOM(N_STATES)];
    double constants[ROOM(N_CONSTANTS)]; /* what a step takes that follows from parameters and sample period alone */
    const double *arg[ROOM(WORK_ARG)];
    double *res[ROOM(WORK_RES)];
    long long iw[ROOM(WORK_IW)];
    double w[ROOM(WORK_W)];
    uint64_t name;      /* that of the states that it makes */
    bool constants_stale; /* a parameter or the sample period has changed since they were computed */
    bool outputs_stale; /* a start value has changed since the outputs before the first sample were computed */
    bool log_events;
    BlockLog log;
};

#define IN(phase) (1u << (phase))
#define BEFORE_STEPPING (IN(INSTANTIATED) | IN(INITIALIZATION))
#define ALIVE (BEFORE_STEPPING | IN(STEPPING))
#define ALWAYS (ALIVE | IN(CONFIGURATION) | IN(TERMINATED))

typedef enum {
    SET_TIMES, ENTER_CONFIGURATION, EXIT_CONFIGURATION, ENTER_INITIALIZATION, EXIT_INITIALIZATION, DO_STEP, TERMINATE, RESET,
    GET, SAVE, RESTORE
} Call;

/* Which call is legal when is a table in block.c; a call that is not legal now is refused. */
bool block_allowed(Block *block, Call call);
const char *block_phase_name(const Block *block);

/* The size of a state with so many rows, and one with all rows at their start values and the rest zero; NULL where memory is short. */
size_t block_size_of(uint64_t rows);
struct BlockState *block_new_rows(uint64_t rows);

/* Another state in place of the present one, which is freed. */
void block_take(Block *block, struct BlockState *state);

/* A number that stands for the model, and for how its states lie in memory ("block 4"). */
uint64_t block_model(void);
#define STATE_LAYOUT UINT64_C(0x626c6f636b203400)

/* 64 bits that tell names and states from each other: damaged or foreign ones, not forged ones. */
uint64_t block_digest(const void *data, size_t size);

/* Outputs before the first sample, and the state from which it is made. */
bool block_evaluate_initial(Block *block);

PRIVATE_TO_HERE

/* The first half of the key of all noise. */
static inline uint64_t block_noise_seed(const struct BlockState *state) {
    return state->seed ? state->seed : state->name;
}

static inline double *block_inputs(struct BlockState *state, uint64_t row) {
    return state->table + row * N_INPUTS;
}

static inline double *block_outputs(struct BlockState *state, uint64_t row) {
    return state->table + state->rows * N_INPUTS + row * N_OUTPUTS;
}

#endif
