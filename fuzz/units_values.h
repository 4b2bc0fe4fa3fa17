/* Getting and setting values: good ones, bad ones, too few and none. */
#ifndef UNITS_VALUES_H
#define UNITS_VALUES_H

#include "units_twin.h"

/* ---- values --------------------------------------------------------------------------------------------------------- */

static size_t count_of(uint32_t reference) {
    const BlockVariable *v = &variables[reference];
    bool in_rows = v->role == ROLE_INPUT || v->role == ROLE_OUTPUT;
    return v->kind == KIND_UNSIGNED ? 1 : v->count * (in_rows ? now->twin.rows : 1);
}

/* FMI 2 calls an unsigned number an Integer, too. */
static bool has_kind(uint32_t reference, int kind) {
    Kind own = variables[reference].kind;
    return (int) own == kind || (FMI == 2 && own == KIND_UNSIGNED && kind == KIND_INTEGER)
           || (FMI == 2 && own == KIND_INTEGER && kind == KIND_UNSIGNED);
}

/* References of variables of a kind, as a rule: gives what a call that reads them must answer. */
static int choose(int kind, uint32_t references[], size_t n, size_t *n_values) {
    int want = OK;
    *n_values = 0;
    for (size_t i = 0; i < n; i++) {
        references[i] = (uint32_t) below(N_VARIABLES);
        for (int tries = 0; tries < 40 && !has_kind(references[i], kind) && !once_in(30); tries++) {
            references[i] = (uint32_t) below(N_VARIABLES);
        }
        if (once_in(40)) {
            references[i] = once_in(2) ? N_VARIABLES + (uint32_t) below(5) : UINT32_MAX;
        }
        bool known = references[i] < N_VARIABLES;
        *n_values += known && FMI == 3 ? count_of(references[i]) : 1;
        want = known && has_kind(references[i], kind) ? want : ERROR;
    }
    return want;
}

static unsigned settable(const BlockVariable *v) {
    switch (v->role) {
        case ROLE_INPUT:
        case ROLE_TUNABLE: return alive;
        case ROLE_FIXED:
        case ROLE_SAMPLING: return 1u << INSTANTIATED | 1u << INITIALIZATION;
        case ROLE_STRUCTURAL: return 1u << CONFIGURATION;
        default: return 0;
    }
}

static bool acceptable(const BlockVariable *v, Value value) {
    if (v->kind == KIND_UNSIGNED && v->role == ROLE_STRUCTURAL) {
        return value.whole >= 1 && value.whole <= MAX_ROWS;
    }
    if (v->kind == KIND_UNSIGNED) {
        return FMI == 3 || value.integer >= 0;
    }
    if (v->kind == KIND_BOOLEAN || v->role == ROLE_INPUT) {
        return true;
    }
    double x = v->kind == KIND_REAL ? value.real : value.integer;
    return isfinite(x) && (v->role == ROLE_SAMPLING ? x > 0.0 : x >= v->minimum && x <= v->maximum);
}

/* A value for a variable, as a rule one that it takes. */
static Value value_for(const BlockVariable *v) {
    static const double periods[] = {1.0 / 976, 1e-3, 0.01, 0.1, 1.0, 3.0};
    static const uint64_t rows[] = {1, 2, 3, 8, 64, 500, 0, MAX_ROWS + UINT64_C(1), UINT64_MAX};
    switch (v->kind) {
        case KIND_UNSIGNED: return (Value) {.whole = v->role == ROLE_STRUCTURAL ? ONE_OF(rows) : chance()};
        case KIND_BOOLEAN: return (Value) {.integer = (int32_t) below(2)};
        case KIND_INTEGER: return (Value) {.integer = (int32_t) (once_in(3) ? chance() : below(5))};
        default: break;
    }
    if (v->role == ROLE_SAMPLING && !once_in(6)) {
        return (Value) {.real = ONE_OF(periods)};
    }
    double low = fmax(v->minimum, -10.0), high = fmin(v->maximum, 10.0);
    return (Value) {.real = once_in(10) || low > high ? any_number() : between(low, high)};
}

/* What a value changes that the fuzzer must know of. */
static void note(const BlockVariable *v, Value value) {
    Twin *t = &now->twin;
    if (v->role == ROLE_STRUCTURAL) {
        t->rows = value.whole;
    } else if (v->role == ROLE_SAMPLING && v->kind == KIND_REAL) {
        t->period = value.real;
        t->wild = t->wild || value.real < 1e-6 || value.real > 1e3;
    }
#ifdef MODEL_LIMITS
    t->unsure = t->unsure || v->role == ROLE_FIXED || v->role == ROLE_TUNABLE || (v->role == ROLE_SAMPLING && v->kind == KIND_REAL);
#endif
}

static void write_values(void) {
    enum { MOST = 4 };
    uint32_t references[MOST];
    int kind = (int) below(KIND_OTHER + 1);
    size_t n = below(MOST + 1), n_values, at = 0;
    n = IN_BLOCKS && n > 1 ? 1 : n; /* as the numbers of values may change from one to the next */
    int want = choose(kind, references, n, &n_values);
    Value *values = calloc(n_values + 1, sizeof *values);
    bool missing = n > 0 && once_in(25), short_of = FMI == 3 && kind != KIND_OTHER && once_in(25);
    Twin before = now->twin;
    for (size_t i = 0; i < n && want == OK; i++) {
        const BlockVariable *v = &variables[references[i]];
        want = if_in(settable(v));
        size_t count = FMI == 3 ? count_of(references[i]) : 1;
        for (size_t k = 0; k < count; k++) {
            values[at] = value_for(v);
            want = want == OK && acceptable(v, values[at]) ? OK : ERROR;
            at++;
        }
        if (want == OK && !missing && !short_of) {
            note(v, values[at - 1]);
        }
    }
#ifdef MODEL_LIMITS
    now->twin.unsure = now->twin.unsure || n > 1; /* what comes before a value that is refused is set */
#endif
    want = missing || short_of ? ERROR : n == 0 ? OK : kind == KIND_OTHER ? ERROR : want;
    bool which = once_in(2);
    Twin after = now->twin;
    now->twin = before;
    int status = set(now->unit, kind, missing && which ? NULL : references, n, missing && !which ? NULL : values, n_values + short_of);
    check("setting values", status, want);
    now->twin = after;
    free(values);
}

static void read_values(void) {
    enum { MOST = 6 };
    uint32_t references[MOST];
    int kind = (int) below(KIND_OTHER + 1);
    size_t n = below(MOST + 1), n_values;
    int want = choose(kind, references, n, &n_values);
    bool missing = n > 0 && once_in(25), short_of = FMI == 3 && kind != KIND_OTHER && once_in(25) && n_values > 0, which = once_in(2);
    Value *values = calloc(n_values + 1, sizeof *values);
    want = missing || short_of ? ERROR : n == 0 ? OK : kind == KIND_OTHER ? ERROR : want;
    int status = get(now->unit, kind, missing && which ? NULL : references, n, missing && !which ? NULL : values, n_values - short_of);
    check("getting values", status, want);
    free(values);
}

#endif
