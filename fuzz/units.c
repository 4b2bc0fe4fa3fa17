/* A fuzzer of one unit: calls in random order, legal and not, with values that are good, bad and missing.

   It knows by itself, from the table of variables and from the standard, what each call must answer, and ends at the first
   other answer; what goes wrong in memory the sanitizers find.  usage: units SEED CALLS */
#include "units.h"

#if FUZZ_FMI == 2
#include <stdarg.h>
#include "units_fmi2.h"
#else
#include "units_fmi3.h"
#endif

#include <math.h>

#include "units_states.h"

/* ---- life ----------------------------------------------------------------------------------------------------------- */

static void instantiate(void) {
    static const char *const names[] = {MODEL_NAME, "left", "", "a name of other letters \xc3\xa9", NULL};
    Way way = once_in(4) ? (Way) below(N_WAYS) : WELL;
    const char *token = way == WRONG_TOKEN ? "{somebody-else}" : way == NO_TOKEN ? NULL : TOKEN;
    Unit unit = make(ONE_OF(names), token, once_in(2), way);
    bool good = way == WELL || (way == NO_CALLBACKS && FMI == 3);
    if (!!unit != good) {
        fprintf(stderr, "seed %llu: instantiating in the way %d gave %p\n", (unsigned long long) seed, way, unit);
        exit(1);
    }
    if (unit) {
        discard(now->unit);
        now->unit = unit;
        now->twin = fresh();
        instances++;
    }
}

/* Start and stop, which FMI 3 says as initialization begins, FMI 2 before it, or never. */
static void times_or_begin(bool begins) {
    static const double starts[] = {-5.0, 100.5, 1e6, 1e300, NAN, INFINITY};
    double start = once_in(4) ? ONE_OF(starts) : 0.0;
    double stop = once_in(8) ? any_number() : start + (double) below(once_in(2) ? 9 : 500) * now->twin.period;
    bool stops = once_in(3), told = FMI == 3 || !begins;
    int want = told && (!isfinite(start) || (stops && !(stop >= start))) ? ERROR : if_in(1u << INSTANTIATED);
    check("the times or entering initialization", (begins ? enter : set_times)(now->unit, start, stops, stop), want);
    if (want == OK && told) {
        now->twin.time = start;
        now->twin.stop = stops ? stop : INFINITY;
    }
    now->twin.phase = want == OK && begins ? INITIALIZATION : now->twin.phase;
}

static void times(void) {
    if (FMI == 2) {
        times_or_begin(false);
    }
}

static void begin(void) { times_or_begin(true); }

static void finish(void) {
    bool countable = fabs(now->twin.time / now->twin.period) < 1e15;
    int want = if_in(1u << INITIALIZATION);
    want = want == OK && (now->twin.wild || now->twin.unsure) ? ANY : want == OK && !countable ? ERROR : want;
    int status = leave(now->unit);
    check("leaving initialization", status, want);
    if (status == OK) {
        now->twin.phase = STEPPING;
        now->twin.unsure = false;
        double samples = now->twin.time / now->twin.period;
        now->twin.off_grid = fabs(samples - rint(samples)) > 1e-9;
    }
}

static void end(void) {
    int want = if_in(1u << STEPPING);
    check("terminating", terminate(now->unit), want);
    if (want == OK) {
        now->twin.phase = TERMINATED;
    }
}

static void start_over(void) {
    check("a reset", reset(now->unit), OK);
    now->twin = fresh();
}

static void configuration(void) {
    if (FMI == 2) {
        return;
    }
    bool enters = once_in(2);
    int want = IN_BLOCKS ? if_in(1u << (enters ? INSTANTIATED : CONFIGURATION)) : ERROR;
    check("configuration", configure(now->unit, enters), want);
    if (want == OK) {
        now->twin.phase = enters ? CONFIGURATION : INSTANTIATED;
    }
}

/* ---- steps ---------------------------------------------------------------------------------------------------------- */

static void bad_step(void) {
    const Twin *t = &now->twin;
    const double most = IN_BLOCKS ? (double) t->rows : MODEL_MOST_SAMPLES;
    const double sizes[] = {0.0, -1.0, NAN, INFINITY, 1e300, (most * 1.001 + 2.0) * t->period};
    if (once_in(3)) {
        check("a step from elsewhen", make_step(now->unit, once_in(2) ? NAN : t->time + 10.0 * t->period, t->period, false),
              t->wild && t->time + 10.0 * t->period == t->time ? ANY : ERROR);
    } else if (!t->wild) {
        check("an impossible step", make_step(now->unit, t->time, ONE_OF(sizes), false), ERROR);
    }
}

static int step_answer(double size, double samples) {
    const Twin *t = &now->twin;
    if (t->phase != STEPPING) {
        return ERROR;
    }
    if (t->wild) {
        return ANY;
    }
    double past = t->time + size - t->stop;
    bool tight = IN_BLOCKS && (t->off_grid ? samples + 1.0 > (double) t->rows : samples > (double) t->rows);
    bool over = IN_BLOCKS && samples > (double) t->rows + 1.0;
    return past > 0.5 * t->period || over ? ERROR : past > 0.0 || tight || t->unsure ? ANY : OK;
}

static void step(void) {
    Twin *t = &now->twin;
    double samples = once_in(5) ? between(0.01, 3.0) : (double) (1 + below(once_in(30) ? 200 : 6));
    double size = samples * t->period;
    bool without = FMI == 3 && once_in(20);
    int want = without ? ERROR : step_answer(size, samples);
    if (t->wild && !(isfinite(t->time + size) && fabs(size / t->period - samples) < 1.0)) {
        return;
    }
    int status = make_step(now->unit, t->time, size, without);
    check("a step", status, want);
    if (status == OK) {
        t->time += size;
        t->off_grid = t->off_grid || samples != rint(samples);
        t->unsure = t->unsure && samples < 1.0; /* a step without a sample asks no limit */
    }
}

/* ---- laws ----------------------------------------------------------------------------------------------------------- */

/* All real outputs, which a unit must show in every phase. */
static size_t look(Value *values) {
    size_t n = 0;
    for (uint32_t i = 0; i < N_VARIABLES; i++) {
        if (variables[i].role == ROLE_OUTPUT && variables[i].kind == KIND_REAL) {
            size_t count = FMI == 3 ? count_of(i) : 1;
            check("getting an output", get(now->unit, KIND_REAL, &i, 1, values + n, count), OK);
            n += count;
        }
    }
    return n;
}

/* A restored state replays: the same steps from it give the same bits. */
static void replay(void) {
    Twin *t = &now->twin;
    if (t->phase != STEPPING || t->wild || t->unsure || t->off_grid || t->time + 4.0 * t->period > t->stop || fabs(t->time / t->period) > 1e9) {
        return;
    }
    State state = NULL;
    size_t room = N_OUTPUTS * t->rows + 1, n = 0;
    Value *once = calloc(room, sizeof *once), *again = calloc(room, sizeof *again);
    check("saving", save(now->unit, &state), OK);
    for (int run = 0; run < 2; run++) {
        for (int k = 0; k < 3; k++) {
            check("a step", make_step(now->unit, t->time + k * t->period, t->period, false), OK);
        }
        n = look(run ? again : once);
        check("restoring", restore(now->unit, state), OK);
    }
    if (memcmp(once, again, n * sizeof *once) != 0) {
        fprintf(stderr, "seed %llu, call %lld: a restored state does not replay\n", (unsigned long long) seed, calls);
        exit(1);
    }
    check("freeing a state", release(now->unit, &state), OK);
    free(once);
    free(again);
    replays++;
}

/* ---- what else there is --------------------------------------------------------------------------------------------- */

static void talk(void) {
    const char *const known[] = {LOG_EVENTS, LOG_ERROR}, *const unknown[] = {LOG_EVENTS, "logWeather"}, *const lost[] = {LOG_ERROR, NULL};
    bool on = once_in(2);
    switch (below(5)) {
        case 0: check("logging", log_events(now->unit, on, 0, NULL), OK); break;
        case 1: check("logging", log_events(now->unit, on, 1 + below(2), known), OK); break;
        case 2: check("logging what is not known", log_events(now->unit, on, 2, unknown), ERROR); break;
        case 3: check("logging nothing", log_events(now->unit, on, 2, NULL), ERROR); break;
        default: check("logging half", log_events(now->unit, on, 2, lost), ERROR);
    }
}

static void refuse(void) {
    int want;
    int status = other(now->unit, chance(), &want);
    check("a call that does nothing", status, want);
}

/* Every call without an instance. */
static void nobody(void) {
    State state = states[0].state;
    Value value = {.whole = 0};
    size_t size = 0;
    uint8_t bytes[8] = {0};
    int want;
    switch (below(12)) {
        case 0: check("nobody's step", make_step(NULL, 0.0, 1.0, false), ERROR); break;
        case 1: check("nobody's initialization", enter(NULL, 0.0, false, 0.0), ERROR); break;
        case 2: check("nobody's start", leave(NULL), ERROR); break;
        case 3: check("nobody's end", terminate(NULL), ERROR); break;
        case 4: check("nobody's reset", reset(NULL), ERROR); break;
        case 5: check("nobody's values", get(NULL, (int) below(KIND_OTHER + 1), &(uint32_t) {0}, below(2), &value, 1), ERROR); break;
        case 6: check("nobody's values", set(NULL, (int) below(KIND_OTHER + 1), &(uint32_t) {0}, below(2), &value, 1), ERROR); break;
        case 7: check("nobody's state", save(NULL, &state), ERROR); break;
        case 8: check("nobody's state", restore(NULL, state), ERROR); break;
        case 9: check("nobody's bytes", size_of(NULL, state, &size), ERROR); break;
        case 10: check("nobody's bytes", from_bytes(NULL, bytes, sizeof bytes, &state), ERROR); break;
        default: check("nobody's call", other(NULL, chance(), &want), ERROR);
    }
    check("nobody's state", release(NULL, &state), ERROR);
}

static void (*const acts[])(void) = {
    begin, finish, step, write_values, read_values, replay, keep_state, take_state, times, configuration, instantiate,
    end, start_over, bad_step, drop_state, strange_state, write_state, read_state, talk, refuse, nobody,
};

/* What leads on from a phase; without it most calls would be refused and few steps made. */
static void lead_on(void) {
    switch (now->twin.phase) {
        case INSTANTIATED:
            (once_in(3) ? write_values : IN_BLOCKS && once_in(4) ? configuration : FMI == 2 && once_in(2) ? times : begin)();
            break;
        case CONFIGURATION: (once_in(2) ? write_values : configuration)(); break;
        case INITIALIZATION: (once_in(2) ? write_values : finish)(); break;
        case STEPPING: (once_in(8) ? replay : once_in(3) ? read_values : once_in(2) ? write_values : step)(); break;
        default: start_over();
    }
}

int main(int n_arguments, char **arguments) {
    if (n_arguments != 3) {
        fputs("usage: units SEED CALLS\n", stderr);
        return 2;
    }
    counter = seed = strtoull(arguments[1], NULL, 10);
    const long long wanted = strtoll(arguments[2], NULL, 10);
    for (now = units; now < units + UNITS;) {
        instantiate();
        now += now->unit != NULL;
    }
    while (calls < wanted) {
        now = &units[below(UNITS)];
        (once_in(3) ? ONE_OF(acts) : lead_on)();
    }
    printf("%lld calls, %lld refused, %lld messages, %lld instances, %lld replays, %lld bytes of states\n", calls, refused,
           messages, instances, replays, written);
    now = units;
    for (size_t i = 0; i < STATES; i++) {
        check("freeing a state", release(now->unit, &states[i].state), OK);
        free(states[i].bytes);
    }
    for (size_t i = 0; i < UNITS; i++) {
        discard(units[i].unit);
    }
    return 0;
}
