/* The values of variables: by reference, whole, row by row. */
#include "block_core.h"

#include <math.h>
#include <string.h>

/* In which phases a variable of each role can be set. */
static const unsigned settable[] = {
    [ROLE_TIME] = 0,
    [ROLE_INPUT] = ALIVE,
    [ROLE_TUNABLE] = ALIVE,
    [ROLE_FIXED] = BEFORE_STEPPING,
    [ROLE_SAMPLING] = BEFORE_STEPPING,
    [ROLE_OUTPUT] = 0,
    [ROLE_STRUCTURAL] = IN(CONFIGURATION),
};

static bool known(Block *block, uint32_t reference) {
    if (block && reference >= N_VARIABLES) {
        block_refuse_variable(block, reference, "is unknown");
    }
    return block && reference < N_VARIABLES;
}

static bool has_kind(Block *block, uint32_t reference, Kind kind) {
    if (!known(block, reference)) {
        return false;
    }
    return variables[reference].kind == kind || block_refuse_variable(block, reference, "is of another type");
}

static bool may_set(Block *block, uint32_t reference, Kind kind) {
    if (!has_kind(block, reference, kind)) {
        return false;
    }
    unsigned phases = settable[variables[reference].role];
    if (phases & IN(block->now->phase)) {
        return true;
    }
    return block_refuse(block, "%s: variable %s cannot be set%s%s", MODEL_NAME, variables[reference].name,
                        phases ? " while " : "", phases ? block_phase_name(block) : "");
}

/* Before the first sample the outputs follow from inputs and parameters, so they are computed when somebody looks. */
static bool may_get(Block *block, uint32_t reference, Kind kind) {
    if (!block_allowed(block, GET) || !has_kind(block, reference, kind)) {
        return false;
    }
    if (block->outputs_stale && variables[reference].role == ROLE_OUTPUT && !block_evaluate_initial(block)) {
        return block_refuse_variable(block, reference, "cannot be evaluated");
    }
    return true;
}

/* Where the values of a variable lie: some columns of a table. */
typedef struct {
    double *first;
    size_t rows, columns, stride;
} View;

static View view(const Block *block, uint32_t reference) {
    struct BlockState *now = block->now;
    const BlockVariable *v = &variables[reference];
    switch (v->role) {
        case ROLE_INPUT: return (View) {block_inputs(now, 0) + v->first, now->rows, v->count, N_INPUTS};
        case ROLE_OUTPUT: return (View) {block_outputs(now, 0) + v->first, now->rows, v->count, N_OUTPUTS};
        case ROLE_TUNABLE:
        case ROLE_FIXED: return (View) {now->parameters + v->first, 1, v->count, 0};
        case ROLE_SAMPLING: return (View) {&now->sample_period, 1, 1, 0};
        default: return (View) {&now->time, 1, 1, 0};
    }
}

static uint64_t *unsigned_of(Block *block, uint32_t reference) {
    return reference == SEED ? &block->now->seed : &block->now->rows;
}

bool block_is_unsigned(uint32_t reference) {
    return reference < N_VARIABLES && variables[reference].kind == KIND_UNSIGNED;
}

bool block_count(Block *block, uint32_t reference, size_t *count) {
    if (!known(block, reference)) {
        return false;
    }
    if (block_is_unsigned(reference)) {
        *count = 1;
        return true;
    }
    View v = view(block, reference);
    *count = v.rows * v.columns;
    return true;
}

/* Row by row, which is FMI's order of an array. */
#define EACH_VALUE(v, value) \
    for (size_t row_ = 0; row_ < (v).rows; row_++) \
        for (double *value = (v).first + row_ * (v).stride, *end_ = value + (v).columns; value < end_; value++)

static int32_t rounded(double value) {
    return isnan(value) ? 0 : (int32_t) rint(fmin(fmax(value, INT32_MIN), INT32_MAX));
}

bool block_get_reals(Block *block, uint32_t reference, double values[]) {
    if (!may_get(block, reference, KIND_REAL)) {
        return false;
    }
    View v = view(block, reference);
    EACH_VALUE(v, value) { *values++ = *value; }
    return true;
}

bool block_get_integers(Block *block, uint32_t reference, int32_t values[]) {
    if (!may_get(block, reference, KIND_INTEGER)) {
        return false;
    }
    View v = view(block, reference);
    EACH_VALUE(v, value) { *values++ = rounded(*value); }
    return true;
}

bool block_get_booleans(Block *block, uint32_t reference, bool values[]) {
    if (!may_get(block, reference, KIND_BOOLEAN)) {
        return false;
    }
    View v = view(block, reference);
    EACH_VALUE(v, value) { *values++ = *value != 0.0; }
    return true;
}

bool block_get_unsigned(Block *block, uint32_t reference, uint64_t *value) {
    if (!may_get(block, reference, KIND_UNSIGNED)) {
        return false;
    }
    *value = *unsigned_of(block, reference);
    return true;
}

/* A parameter is a finite number within its bounds.  Inputs are the model's affair, sample by sample. */
static bool is_bounded(const BlockVariable *v) {
    return v->role == ROLE_TUNABLE || v->role == ROLE_FIXED;
}

static bool in_bounds(Block *block, const BlockVariable *v, double value) {
    if (!isfinite(value)) {
        return block_refuse(block, "%s: variable %s must be finite, not %g", MODEL_NAME, v->name, value);
    }
    return (value >= v->minimum && value <= v->maximum)
           || block_refuse(block, "%s: variable %s must lie in %g to %g, not %g", MODEL_NAME, v->name, v->minimum, v->maximum, value);
}

/* A variable has another value now. */
static void note_change(Block *block, uint32_t reference) {
    block->constants_stale |= variables[reference].role != ROLE_INPUT;
    block->outputs_stale = block->now->phase < STEPPING;
}

bool block_set_reals(Block *block, uint32_t reference, const double values[]) {
    if (!may_set(block, reference, KIND_REAL)) {
        return false;
    }
    if (reference == SAMPLE_PERIOD && !(*values > 0.0 && isfinite(*values))) {
        return block_refuse_variable(block, reference, "must be positive and finite");
    }
    View v = view(block, reference);
    const BlockVariable *variable = &variables[reference];
    for (size_t i = 0; is_bounded(variable) && i < v.rows * v.columns; i++) {
        if (!in_bounds(block, variable, values[i])) {
            return false;
        }
    }
    EACH_VALUE(v, value) { *value = *values++; }
    note_change(block, reference);
    return true;
}

bool block_set_integers(Block *block, uint32_t reference, const int32_t values[]) {
    if (!may_set(block, reference, KIND_INTEGER)) {
        return false;
    }
    View v = view(block, reference);
    const BlockVariable *variable = &variables[reference];
    for (size_t i = 0; is_bounded(variable) && i < v.rows * v.columns; i++) {
        if (!in_bounds(block, variable, values[i])) {
            return false;
        }
    }
    EACH_VALUE(v, value) { *value = *values++; }
    note_change(block, reference);
    return true;
}

bool block_set_booleans(Block *block, uint32_t reference, const bool values[]) {
    if (!may_set(block, reference, KIND_BOOLEAN)) {
        return false;
    }
    View v = view(block, reference);
    EACH_VALUE(v, value) { *value = *values++; }
    note_change(block, reference);
    return true;
}

/* Other rows; the inputs are at their start values then, and all else is as it was. */
static bool resize(Block *block, uint32_t reference, uint64_t rows) {
    if (rows < 1 || rows > MAX_ROWS) {
        return block_refuse(block, "%s: variable %s must lie in 1 to %d", MODEL_NAME, variables[reference].name, MAX_ROWS);
    }
    struct BlockState *state = block_new_rows(rows);
    if (!state) {
        return block_refuse(block, "%s: no memory for %llu rows", MODEL_NAME, (unsigned long long) rows);
    }
    memcpy(state, block->now, sizeof *state);
    state->rows = rows;
    block_take(block, state);
    return true;
}

bool block_set_unsigned(Block *block, uint32_t reference, uint64_t value) {
    if (!may_set(block, reference, KIND_UNSIGNED)) {
        return false;
    }
    if (reference != SEED) {
        return resize(block, reference, value);
    }
    block->now->seed = value;
    return true;
}
