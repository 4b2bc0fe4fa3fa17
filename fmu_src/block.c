#include "block_core.h"

#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
        if (!categories || !categories[i]) {
            return block_refuse(block, "%s: log category %zu is missing", MODEL_NAME, i + 1);
        }
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

static const struct {
    const char *name;
    unsigned phases;
} calls[] = {
    [SET_TIMES] = {"setting the start time", IN(INSTANTIATED)},
    [ENTER_CONFIGURATION] = {"entering configuration", IN(INSTANTIATED)},
    [EXIT_CONFIGURATION] = {"leaving configuration", IN(CONFIGURATION)},
    [ENTER_INITIALIZATION] = {"entering initialization", IN(INSTANTIATED)},
    [EXIT_INITIALIZATION] = {"leaving initialization", IN(INITIALIZATION)},
    [DO_STEP] = {"a step", IN(STEPPING)},
    [TERMINATE] = {"terminating", IN(STEPPING)},
    [RESET] = {"a reset", ALWAYS},
    [GET] = {"getting a value", ALWAYS},
    [SAVE] = {"saving a state", ALWAYS},
    [RESTORE] = {"restoring a state", ALWAYS},
};

static const char *const phase_names[] = {"instantiated", "in configuration", "in initialization", "stepping", "terminated"};

const char *block_phase_name(const Block *block) {
    return phase_names[block->now->phase];
}

bool block_allowed(Block *block, Call call) {
    if (!block) {
        return false;
    }
    if (calls[call].phases & IN(block->now->phase)) {
        return true;
    }
    return block_refuse(block, "%s: %s is not allowed while %s", MODEL_NAME, calls[call].name, block_phase_name(block));
}

/* ---- life --------------------------------------------------------------------------------------------------------- */

size_t block_size_of(uint64_t rows) {
    return sizeof(struct BlockState) + (size_t) rows * (N_INPUTS + N_OUTPUTS) * sizeof(double);
}

struct BlockState *block_new_rows(uint64_t rows) {
    struct BlockState *state = calloc(1, block_size_of(rows));
    if (state) {
        state->layout = STATE_LAYOUT;
        state->model = block_model();
        state->rows = rows;
        for (uint64_t row = 0; row < rows; row++) {
            memcpy(block_inputs(state, row), input_starts, N_INPUTS * sizeof(double));
        }
    }
    return state;
}

static struct BlockState *new_state(const Block *block) {
    struct BlockState *state = block_new_rows(START_ROWS);
    if (state) {
        state->name = block->name;
        memcpy(state->parameters, parameter_starts, N_PARAMETERS * sizeof(double));
        state->stop_time = INFINITY;
        state->sample_period = MODEL_SAMPLE_PERIOD;
        state->seed = MODEL_SEED;
    }
    return state;
}

static void forget_noise(Block *block) {
    for (int i = 0; i < N_NOISE; i++) {
        noise_forget(&block->noise[i]);
    }
}

void block_take(Block *block, struct BlockState *state) {
    free(block->now);
    block->now = state;
    block->constants_stale = true;
    block->outputs_stale = state->phase < STEPPING;
    forget_noise(block); /* it may have been another seed's */
}

/* FMI 2 and FMI 3 have tokens of their own, as masters take units of equal tokens for one file. */
static const char *token_of(int version) {
    static const char *const tokens[] = {MODEL_TOKEN_FMI2, MODEL_TOKEN_FMI3};
    return tokens[version - 2];
}

Block *block_create(const char *name, int version, const char *token, BlockLog log, bool log_events) {
    Block *block = calloc(1, sizeof *block);
    if (!block) {
        return NULL;
    }
    block->name = name ? block_digest(name, strlen(name)) ^ block_digest(MODEL_NAME, strlen(MODEL_NAME)) : 0;
    block->log = log;
    block->log_events = log_events;
    if (!token || strcmp(token, token_of(version)) != 0) {
        block_refuse(block, "%s has the token %s, not %s", MODEL_NAME, token_of(version), token ? token : "(none)");
        free(block);
        return NULL;
    }
    struct BlockState *state = new_state(block);
    if (!state) {
        block_refuse(block, "%s: no memory for %d rows", MODEL_NAME, START_ROWS);
        free(block);
        return NULL;
    }
    block_take(block, state);
    return block;
}

void block_free(Block *block) {
    if (block) {
        free(block->now);
        free(block);
    }
}

bool block_reset(Block *block) {
    if (!block_allowed(block, RESET)) {
        return false;
    }
    struct BlockState *state = new_state(block);
    if (!state) {
        return block_refuse(block, "%s: no memory for %d rows", MODEL_NAME, START_ROWS);
    }
    block_take(block, state);
    return true;
}

bool block_enter_configuration(Block *block) {
    if (!block_allowed(block, ENTER_CONFIGURATION)) {
        return false;
    }
    if (!IN_BLOCKS) {
        return block_refuse(block, "%s has nothing to configure", MODEL_NAME);
    }
    block->now->phase = CONFIGURATION;
    return true;
}

bool block_exit_configuration(Block *block) {
    if (!block_allowed(block, EXIT_CONFIGURATION)) {
        return false;
    }
    block->now->phase = INSTANTIATED;
    return true;
}

bool block_set_times(Block *block, double start_time, double stop_time) {
    if (!block_allowed(block, SET_TIMES)) {
        return false;
    }
    if (!isfinite(start_time)) {
        return block_refuse(block, "%s: the start time %g is not a time", MODEL_NAME, start_time);
    }
    if (!(stop_time >= start_time)) {
        return block_refuse(block, "%s: the stop time %g is not a time from %g on", MODEL_NAME, stop_time, start_time);
    }
    block->now->time = start_time;
    block->now->stop_time = stop_time;
    return true;
}

bool block_enter_initialization(Block *block) {
    if (!block_allowed(block, ENTER_INITIALIZATION)) {
        return false;
    }
    block->now->phase = INITIALIZATION;
    return true;
}

bool block_terminate(Block *block) {
    if (!block_allowed(block, TERMINATE)) {
        return false;
    }
    block->now->phase = TERMINATED;
    tell(block, "%s: terminated at %.17g s after sample %lld", MODEL_NAME, block->now->time,
         (long long) block->now->sample);
    return true;
}

/* ---- the model's two functions ------------------------------------------------------------------------------------ */

/* The rows from the first one that was not made, all as the last one made; where none was, as the last sample before. */
static void hold_outputs(struct BlockState *now, uint64_t made) {
    const double *last = block_outputs(now, made > 0 ? made - 1 : now->rows - 1);
    for (uint64_t row = made; row < now->rows; row++) {
        memmove(block_outputs(now, row), last, N_OUTPUTS * sizeof(double));
    }
}

bool block_evaluate_initial(Block *block) {
    struct BlockState *now = block->now;
    block->arg[0] = block_inputs(now, 0);
    block->arg[1] = now->parameters;
    block->res[0] = now->state;
    block->res[1] = block_outputs(now, 0);
    block->outputs_stale = false;
    bool done = model_initial(block->arg, block->res, block->iw, block->w) == 0;
    hold_outputs(now, 1);
    return done;
}

/* What the parameters must keep together, and with the sample period. */
static bool within_limits(Block *block) {
#ifdef MODEL_LIMITS
    double broken[N_LIMITS];
    block->arg[0] = block->now->parameters;
    block->arg[1] = &block->now->sample_period;
    block->res[0] = broken;
    if (model_limits(block->arg, block->res, block->iw, block->w) != 0) {
        return block_refuse(block, "%s: its limits cannot be evaluated", MODEL_NAME);
    }
    for (size_t i = 0; i < N_LIMITS; i++) {
        if (broken[i] != 0.0) {
            return block_refuse(block, "%s: %s", MODEL_NAME, limit_texts[i]);
        }
    }
#else
    (void) block;
#endif
    return true;
}

/* An output that is a whole number says how the model fares, as a filter's status does: each change of it is told. */
static void tell_changes(const Block *block, const double *before, const double *after) {
    for (size_t i = 0; i < N_VARIABLES; i++) {
        const BlockVariable *v = &variables[i];
        if (v->role == ROLE_OUTPUT && v->kind == KIND_INTEGER && before[v->first] != after[v->first]) {
            tell(block, "%s: %s is %g after sample %lld", MODEL_NAME, v->name, after[v->first], (long long) block->now->sample);
        }
    }
}

/* Once for many samples. */
static bool evaluate_constants(Block *block) {
    if (block->constants_stale && !within_limits(block)) {
        return false; /* parameters that were set while stepping need go together only once a step is made */
    }
#ifdef MODEL_CONSTANTS
    if (block->constants_stale) {
        block->arg[0] = block->now->parameters;
        block->arg[1] = &block->now->sample_period;
        block->res[0] = block->constants;
        if (model_constants(block->arg, block->res, block->iw, block->w) != 0) {
            return block_refuse(block, "%s: its constants cannot be evaluated", MODEL_NAME);
        }
    }
#endif
    block->constants_stale = false;
    return true;
}

static bool evaluate_step(Block *block, int64_t sample, uint64_t row, const double *normals) {
    struct BlockState *now = block->now;
    double before[ROOM(N_OUTPUTS)];
    if (block->log_events) {
        memcpy(before, block_outputs(now, row > 0 ? row - 1 : now->rows - 1), N_OUTPUTS * sizeof *before);
    }
    const double *arguments[] = {now->state, block_inputs(now, row), now->parameters, normals, &now->sample_period,
                                 block->constants};
    memcpy(block->arg, arguments, sizeof arguments);
    block->res[0] = block->next_state;
    block->res[1] = block_outputs(now, row);
    if (model_step(block->arg, block->res, block->iw, block->w) != 0) {
        return false;
    }
    memcpy(now->state, block->next_state, sizeof now->state);
    now->sample = sample;
    if (block->log_events) {
        tell_changes(block, before, block_outputs(now, row));
    }
    return true;
}

/* The noise of the samples from `first` on, at most to `last`; gives how many.  One sample alone takes a word out of the
   four in its cache; many take all four at once. */
static size_t draw(Block *block, int64_t first, int64_t last) {
    size_t most = DRAWN - ((uint64_t) first & 3);
    size_t n = (uint64_t) (last - first) < most ? (size_t) (last - first) + 1 : most;
    if (n > 1) {
        noise_fill(block->normals, block_noise_seed(block->now), noise_channels, N_NOISE, first, n);
        return n;
    }
    for (int i = 0; i < N_NOISE; i++) {
        block->normals[i] = noise_at(&block->noise[i], block_noise_seed(block->now), noise_channels[i], first);
    }
    return n;
}

/* In the block form sample i of a step belongs to row i; else there is one row, which all of them share. */
static bool make_samples(Block *block, int64_t last) {
    const int64_t before = block->now->sample;
    bool done = evaluate_constants(block);
    while (done && block->now->sample < last) {
        const int64_t first = block->now->sample + 1;
        const size_t n = draw(block, first, last);
        for (size_t i = 0; i < n && done; i++) {
            const int64_t sample = first + (int64_t) i;
            const uint64_t row = IN_BLOCKS ? (uint64_t) (sample - before - 1) : 0;
            done = evaluate_step(block, sample, row, block->normals + i * N_NOISE)
                   || block_refuse(block, "%s: sample %lld cannot be evaluated", MODEL_NAME, (long long) sample);
        }
    }
    if (IN_BLOCKS) {
        hold_outputs(block->now, (uint64_t) (block->now->sample - before));
    }
    return done;
}

/* ---- time --------------------------------------------------------------------------------------------------------- */

/* How far, in sample periods, a communication point may fall short of a sample's time and still mean it.  Masters that
   count nanoseconds are off by up to 1 ns, at 10 kHz 1e-5 periods; those that add up their steps by at most one rounding
   of the time per step. */
static double slack(const struct BlockState *now, double time) {
    return 1e-5 + (double) (now->steps + 1) * DBL_EPSILON * fabs(time) / now->sample_period;
}

/* The last sample at or before a time, from the time itself: nothing is added up, so nothing drifts. */
static double last_sample(const struct BlockState *now, double time) {
    return floor(time / now->sample_period + fmin(slack(now, time), 0.01));
}

/* How far [s] a step may end past the stop time and still mean it: as much as in counting samples, or as far as two
   numbers may differ that masters take for equal (1e-9 of them, Python's math.isclose); never by half a sample. */
static double forgiven(const struct BlockState *now) {
    if (!isfinite(now->stop_time)) {
        return 0.0;
    }
    double rounding = fmin(slack(now, now->stop_time), 0.01) * now->sample_period + 1e-9 * fabs(now->stop_time);
    return fmin(rounding, 0.5 * now->sample_period);
}

bool block_exit_initialization(Block *block) {
    if (!block_allowed(block, EXIT_INITIALIZATION)) {
        return false;
    }
    struct BlockState *now = block->now;
    if (!within_limits(block)) {
        return false;
    }
    if (!block_evaluate_initial(block)) {
        return block_refuse(block, "%s: its initial state cannot be evaluated", MODEL_NAME);
    }
    double sample = last_sample(now, now->time);
    if (!(fabs(sample) < 0x1p53)) {
        return block_refuse(block, "%s: %g s is too far from zero to count samples", MODEL_NAME, now->time);
    }
    now->sample = (int64_t) sample;
    now->phase = STEPPING;
    forget_noise(block);
    tell(block, "%s: initialized at %.17g s, sample period %.17g s, seed %llu%s", MODEL_NAME, now->time,
         now->sample_period, (unsigned long long) now->seed, now->seed || !N_NOISE ? "" : ": the noise is that of the instance's name");
    return true;
}

static bool step_fits(Block *block, double time, double step) {
    const struct BlockState *now = block->now;
    if (!(step > 0.0) || !isfinite(time + step)) {
        return block_refuse(block, "%s: a step of %g s from %g s is not possible", MODEL_NAME, step, time);
    }
    if (!(fabs(time - now->time) < 0.5 * now->sample_period)) {
        return block_refuse(block, "%s: a step from %.17g s, but the last one ended at %.17g s", MODEL_NAME, time,
                            now->time);
    }
    if (time + step > now->stop_time + forgiven(now)) {
        return block_refuse(block, "%s: a step to %.17g s, but the stop time is %.17g s", MODEL_NAME, time + step, now->stop_time);
    }
    if (!(fabs(last_sample(now, time + step)) < 0x1p53)) {
        return block_refuse(block, "%s: %g s is too far from zero to count samples", MODEL_NAME, time + step);
    }
    double samples = last_sample(now, time + step) - (double) now->sample;
    uint64_t most = IN_BLOCKS ? now->rows : MODEL_MOST_SAMPLES;
    if (samples > (double) most) {
        return block_refuse(block, "%s: a step of %.17g s has %.0f samples, at most %llu are made", MODEL_NAME, step, samples,
                            (unsigned long long) most);
    }
    return true;
}

bool block_do_step(Block *block, double time, double step) {
    if (!block_allowed(block, DO_STEP) || !step_fits(block, time, step)) {
        return false;
    }
    struct BlockState *now = block->now;
    if (!make_samples(block, (int64_t) last_sample(now, time + step))) {
        return false;
    }
    now->time = time + step;
    now->steps++;
    return true;
}

double block_time(const Block *block) {
    return block->now->time;
}
