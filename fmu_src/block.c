#include "block.h"

#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "model_table.h"
#include "noise.h"

#define ROOM(n) ((n) > 0 ? (n) : 1) /* C has no arrays of length zero */

typedef enum { INSTANTIATED, INITIALIZATION, STEPPING, TERMINATED, N_PHASES } Phase;

/* Everything that decides what follows, and nothing derived: this is what saving a state copies.  All members are
   eight bytes long, so there is no padding and equal states are equal bytes. */
struct BlockState {
    uint64_t phase;
    uint64_t seed;
    int64_t sample;  /* the last sample made; sample k belongs to time k * sample_period */
    uint64_t steps;  /* communication steps so far */
    double values[N_VARIABLES];
    double state[ROOM(N_STATES)];
};

struct Block {
    struct BlockState now;
    NoiseCache noise[ROOM(N_NOISE)];
    double normals[ROOM(N_NOISE)];
    double next_state[ROOM(N_STATES)];
    const double *arg[ROOM(WORK_ARG)];
    double *res[ROOM(WORK_RES)];
    long long iw[ROOM(WORK_IW)];
    double w[ROOM(WORK_W)];
    bool outputs_stale; /* a start value has changed since the outputs before the first sample were computed */
    bool log_events;
    BlockLog log;
};

int MODEL_STEP(const double **arg, double **res, long long *iw, double *w, int memory);
int MODEL_INITIAL(const double **arg, double **res, long long *iw, double *w, int memory);

/* ---- messages --------------------------------------------------------------------------------------------------- */

static void write_log(const BlockLog *log, bool is_error, const char *format, va_list arguments) {
    char message[512];
    vsnprintf(message, sizeof message, format, arguments);
    if (log->write) {
        log->write(log->owner, is_error, is_error ? LOG_ERROR : LOG_EVENTS, message);
    }
}

/* Errors are always told; what merely happens, only where somebody asked. */
bool block_refuse(Block *block, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    if (block) {
        write_log(&block->log, true, format, arguments);
    }
    va_end(arguments);
    return false;
}

static void tell(const Block *block, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    if (block->log_events) {
        write_log(&block->log, false, format, arguments);
    }
    va_end(arguments);
}

bool block_refuse_variable(Block *block, uint32_t reference, const char *reason) {
    if (reference >= N_VARIABLES) {
        return block_refuse(block, "%s has no variable with value reference %lu", MODEL_NAME, (unsigned long) reference);
    }
    return block_refuse(block, "%s: variable %s %s", MODEL_NAME, variables[reference].name, reason);
}

bool block_log_events(Block *block, bool on, size_t n, const char *const categories[]) {
    if (!block) {
        return false;
    }
    for (size_t i = 0; i < n; i++) {
        if (strcmp(categories[i], LOG_EVENTS) != 0 && strcmp(categories[i], LOG_ERROR) != 0) {
            return block_refuse(block, "%s has no log category %s", MODEL_NAME, categories[i]);
        }
    }
    bool named = n == 0;
    for (size_t i = 0; i < n; i++) {
        named = named || strcmp(categories[i], LOG_EVENTS) == 0;
    }
    block->log_events = named ? on : block->log_events;
    return true;
}

/* ---- which call is legal when ------------------------------------------------------------------------------------ */

#define IN(phase) (1u << (phase))
#define BEFORE_STEPPING (IN(INSTANTIATED) | IN(INITIALIZATION))
#define ALIVE (BEFORE_STEPPING | IN(STEPPING))
#define ALWAYS (ALIVE | IN(TERMINATED))

typedef enum { START_TIME, ENTER_INITIALIZATION, EXIT_INITIALIZATION, DO_STEP, TERMINATE, RESET, GET, SAVE, RESTORE } Call;

static const struct {
    const char *name;
    unsigned phases;
} calls[] = {
    [START_TIME] = {"setting the start time", IN(INSTANTIATED)},
    [ENTER_INITIALIZATION] = {"entering initialization", IN(INSTANTIATED)},
    [EXIT_INITIALIZATION] = {"leaving initialization", IN(INITIALIZATION)},
    [DO_STEP] = {"a step", IN(STEPPING)},
    [TERMINATE] = {"terminating", IN(STEPPING)},
    [RESET] = {"a reset", ALWAYS},
    [GET] = {"getting a value", ALWAYS},
    [SAVE] = {"saving a state", ALWAYS},
    [RESTORE] = {"restoring a state", ALWAYS},
};

static const unsigned settable[] = {
    [ROLE_TIME] = 0,
    [ROLE_INPUT] = ALIVE,
    [ROLE_TUNABLE] = ALIVE,
    [ROLE_FIXED] = BEFORE_STEPPING,
    [ROLE_OUTPUT] = 0,
};

static const char *const phase_names[] = {"instantiated", "in initialization", "stepping", "terminated"};

static bool allowed(Block *block, Call call) {
    if (!block) {
        return false;
    }
    if (calls[call].phases & IN(block->now.phase)) {
        return true;
    }
    return block_refuse(block, "%s: %s is not allowed while %s", MODEL_NAME, calls[call].name, phase_names[block->now.phase]);
}

/* ---- life --------------------------------------------------------------------------------------------------------- */

static void set_start_values(Block *block) {
    memset(&block->now, 0, sizeof block->now);
    for (size_t i = 0; i < N_VARIABLES; i++) {
        block->now.values[i] = variables[i].start;
    }
    block->now.seed = MODEL_SEED;
    block->outputs_stale = true;
}

static void forget_noise(Block *block) {
    for (size_t i = 0; i < N_NOISE; i++) {
        noise_forget(&block->noise[i]);
    }
}

Block *block_create(const char *token, BlockLog log, bool log_events) {
    Block *block = calloc(1, sizeof *block);
    if (!block) {
        return NULL;
    }
    block->log = log;
    block->log_events = log_events;
    if (!token || strcmp(token, MODEL_TOKEN) != 0) {
        block_refuse(block, "%s has the token %s, not %s", MODEL_NAME, MODEL_TOKEN, token ? token : "(none)");
        free(block);
        return NULL;
    }
    set_start_values(block);
    forget_noise(block);
    return block;
}

void block_free(Block *block) {
    free(block);
}

bool block_reset(Block *block) {
    if (!allowed(block, RESET)) {
        return false;
    }
    set_start_values(block);
    forget_noise(block);
    return true;
}

bool block_set_start_time(Block *block, double start_time) {
    if (!allowed(block, START_TIME)) {
        return false;
    }
    if (!isfinite(start_time)) {
        return block_refuse(block, "%s: the start time %g is not a time", MODEL_NAME, start_time);
    }
    block->now.values[TIME] = start_time;
    return true;
}

bool block_enter_initialization(Block *block) {
    if (!allowed(block, ENTER_INITIALIZATION)) {
        return false;
    }
    block->now.phase = INITIALIZATION;
    return true;
}

bool block_terminate(Block *block) {
    if (!allowed(block, TERMINATE)) {
        return false;
    }
    block->now.phase = TERMINATED;
    tell(block, "%s: terminated at %.17g s after sample %lld", MODEL_NAME, block->now.values[TIME],
         (long long) block->now.sample);
    return true;
}

/* ---- the model's two functions ------------------------------------------------------------------------------------ */

/* Outputs before the first sample, and the state from which it is made. */
static bool evaluate_initial(Block *block) {
    block->arg[0] = &block->now.values[FIRST_PARAMETER];
    block->res[0] = block->now.state;
    block->res[1] = &block->now.values[FIRST_OUTPUT];
    block->outputs_stale = false;
    return MODEL_INITIAL(block->arg, block->res, block->iw, block->w, 0) == 0;
}

static bool evaluate_step(Block *block, int64_t sample) {
    struct BlockState *now = &block->now;
    for (size_t i = 0; i < N_NOISE; i++) {
        block->normals[i] = noise_at(&block->noise[i], now->seed, noise_channels[i], sample);
    }
    const double *arguments[] = {now->state, &now->values[FIRST_INPUT], &now->values[FIRST_PARAMETER], block->normals,
                                 &now->values[SAMPLE_PERIOD]};
    memcpy(block->arg, arguments, sizeof arguments);
    block->res[0] = block->next_state;
    block->res[1] = &now->values[FIRST_OUTPUT];
    if (MODEL_STEP(block->arg, block->res, block->iw, block->w, 0) != 0) {
        return false;
    }
    memcpy(now->state, block->next_state, sizeof now->state);
    now->sample = sample;
    return true;
}

/* ---- time --------------------------------------------------------------------------------------------------------- */

/* How far, in sample periods, a communication point may fall short of a sample's time and still mean it.  Masters that
   count nanoseconds are off by up to 1 ns, at 10 kHz 1e-5 periods; those that add up their steps by at most one rounding
   of the time per step. */
static double slack(const struct BlockState *now, double time) {
    return 1e-5 + (double) (now->steps + 1) * DBL_EPSILON * fabs(time) / now->values[SAMPLE_PERIOD];
}

/* The last sample at or before a time, from the time itself: nothing is added up, so nothing drifts. */
static double last_sample(const struct BlockState *now, double time) {
    return floor(time / now->values[SAMPLE_PERIOD] + fmin(slack(now, time), 0.01));
}

bool block_exit_initialization(Block *block) {
    if (!allowed(block, EXIT_INITIALIZATION)) {
        return false;
    }
    struct BlockState *now = &block->now;
    if (!evaluate_initial(block)) {
        return block_refuse(block, "%s: its initial state cannot be evaluated", MODEL_NAME);
    }
    double sample = last_sample(now, now->values[TIME]);
    if (!(fabs(sample) < 0x1p53)) {
        return block_refuse(block, "%s: %g s is too far from zero to count samples", MODEL_NAME, now->values[TIME]);
    }
    now->sample = (int64_t) sample;
    now->phase = STEPPING;
    forget_noise(block);
    tell(block, "%s: initialized at %.17g s, sample period %.17g s, seed %llu", MODEL_NAME, now->values[TIME],
         now->values[SAMPLE_PERIOD], (unsigned long long) now->seed);
    return true;
}

static bool step_fits(Block *block, double time, double step) {
    const struct BlockState *now = &block->now;
    if (!(step > 0.0) || !isfinite(time + step)) {
        return block_refuse(block, "%s: a step of %g s from %g s is not possible", MODEL_NAME, step, time);
    }
    if (!(fabs(time - now->values[TIME]) < 0.5 * now->values[SAMPLE_PERIOD])) {
        return block_refuse(block, "%s: a step from %.17g s, but the last one ended at %.17g s", MODEL_NAME, time,
                            now->values[TIME]);
    }
    if (!(fabs(last_sample(now, time + step)) < 0x1p53)) {
        return block_refuse(block, "%s: %g s is too far from zero to count samples", MODEL_NAME, time + step);
    }
    return true;
}

bool block_do_step(Block *block, double time, double step) {
    if (!allowed(block, DO_STEP) || !step_fits(block, time, step)) {
        return false;
    }
    struct BlockState *now = &block->now;
    int64_t last = (int64_t) last_sample(now, time + step);
    for (int64_t sample = now->sample + 1; sample <= last; sample++) {
        if (!evaluate_step(block, sample)) {
            return block_refuse(block, "%s: sample %lld cannot be evaluated", MODEL_NAME, (long long) sample);
        }
    }
    now->values[TIME] = time + step;
    now->steps++;
    return true;
}

double block_time(const Block *block) {
    return block->now.values[TIME];
}

/* ---- values ------------------------------------------------------------------------------------------------------- */

int32_t block_integer(double value) {
    return isnan(value) ? 0 : (int32_t) rint(fmin(fmax(value, INT32_MIN), INT32_MAX));
}

bool block_is_seed(uint32_t reference) {
    return reference < N_VARIABLES && variables[reference].kind == KIND_SEED;
}

static bool known(Block *block, uint32_t reference, Kind kind) {
    if (reference < N_VARIABLES && variables[reference].kind == kind) {
        return true;
    }
    return block_refuse_variable(block, reference, "is of another type");
}

static bool may_set(Block *block, uint32_t reference, Kind kind) {
    if (!block || !known(block, reference, kind)) {
        return false;
    }
    unsigned phases = settable[variables[reference].role];
    if (phases & IN(block->now.phase)) {
        return true;
    }
    return block_refuse_variable(block, reference, phases ? "cannot be set any more" : "cannot be set");
}

/* Before the first sample the outputs follow from the parameters, so they are computed when somebody looks. */
static bool may_get(Block *block, uint32_t reference, Kind kind) {
    if (!allowed(block, GET) || !known(block, reference, kind)) {
        return false;
    }
    if (block->outputs_stale && variables[reference].role == ROLE_OUTPUT && !evaluate_initial(block)) {
        return block_refuse_variable(block, reference, "cannot be evaluated");
    }
    return true;
}

bool block_get(Block *block, uint32_t reference, Kind kind, double *value) {
    if (!may_get(block, reference, kind)) {
        return false;
    }
    *value = block->now.values[reference];
    return true;
}

bool block_set(Block *block, uint32_t reference, Kind kind, double value) {
    if (!may_set(block, reference, kind)) {
        return false;
    }
    if (reference == SAMPLE_PERIOD && !(value > 0.0 && isfinite(value))) {
        return block_refuse_variable(block, reference, "must be positive and finite");
    }
    block->now.values[reference] = value;
    block->outputs_stale = block->now.phase < STEPPING;
    return true;
}

bool block_get_seed(Block *block, uint32_t reference, uint64_t *seed) {
    if (!may_get(block, reference, KIND_SEED)) {
        return false;
    }
    *seed = block->now.seed;
    return true;
}

bool block_set_seed(Block *block, uint32_t reference, uint64_t seed) {
    if (!may_set(block, reference, KIND_SEED)) {
        return false;
    }
    block->now.seed = seed;
    return true;
}

/* ---- saved states ------------------------------------------------------------------------------------------------- */

typedef struct {
    char magic[8];
    uint64_t model;
    uint64_t check;
} Seal;

/* FNV-1a (Fowler, Noll, Vo), 64 bits: tells a damaged or foreign state, not a forged one. */
static uint64_t digest(const void *data, size_t size) {
    const unsigned char *bytes = data;
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    for (size_t i = 0; i < size; i++) {
        hash = (hash ^ bytes[i]) * UINT64_C(0x100000001b3);
    }
    return hash;
}

static Seal seal_of(const BlockState *state) {
    Seal seal = {{'b', 'l', 'o', 'c', 'k', ' ', '1', 0}, digest(MODEL_TOKEN, strlen(MODEL_TOKEN)), digest(state, sizeof *state)};
    return seal;
}

bool block_save(Block *block, void **state) {
    if (!allowed(block, SAVE) || !state) {
        return false;
    }
    if (!*state && !(*state = malloc(sizeof(BlockState)))) {
        return block_refuse(block, "%s: no memory for a state", MODEL_NAME);
    }
    memcpy(*state, &block->now, sizeof(BlockState));
    return true;
}

bool block_restore(Block *block, const void *state) {
    if (!allowed(block, RESTORE)) {
        return false;
    }
    if (!state) {
        return block_refuse(block, "%s: there is no state to restore", MODEL_NAME);
    }
    memcpy(&block->now, state, sizeof(BlockState));
    block->outputs_stale = block->now.phase < STEPPING;
    forget_noise(block); /* it may have been another seed's */
    return true;
}

void block_release(void **state) {
    if (state) {
        free(*state);
        *state = NULL;
    }
}

size_t block_serialized_size(void) {
    return sizeof(Seal) + sizeof(BlockState);
}

bool block_serialize(Block *block, const void *state, uint8_t *bytes, size_t size) {
    if (!allowed(block, SAVE)) {
        return false;
    }
    if (!state || !bytes || size < block_serialized_size()) {
        return block_refuse(block, "%s: a serialized state needs %zu bytes", MODEL_NAME, block_serialized_size());
    }
    Seal seal = seal_of(state);
    memcpy(bytes, &seal, sizeof seal);
    memcpy(bytes + sizeof seal, state, sizeof(BlockState));
    return true;
}

bool block_deserialize(Block *block, const uint8_t *bytes, size_t size, void **state) {
    if (!allowed(block, RESTORE) || !state) {
        return false;
    }
    if (!bytes || size != block_serialized_size()) {
        return block_refuse(block, "%s: %zu bytes are no state, which has %zu", MODEL_NAME, size, block_serialized_size());
    }
    BlockState read;
    memcpy(&read, bytes + sizeof(Seal), sizeof read);
    Seal seal = seal_of(&read);
    if (memcmp(bytes, &seal, sizeof seal) != 0 || read.phase >= N_PHASES) {
        return block_refuse(block, "%s: the bytes are another model's state, or damaged", MODEL_NAME);
    }
    if (!(*state = malloc(sizeof read))) {
        return block_refuse(block, "%s: no memory for a state", MODEL_NAME);
    }
    memcpy(*state, &read, sizeof read);
    return true;
}
