/* What the fuzzer knows of its units, its chance, and what a call must answer. */
#ifndef UNITS_TWIN_H
#define UNITS_TWIN_H

enum { UNITS = 3, STATES = 6 };

typedef enum { INSTANTIATED, CONFIGURATION, INITIALIZATION, STEPPING, TERMINATED } Phase;
static const char *const phase_names[] = {"instantiated", "configuration", "initialization", "stepping", "terminated"};

/* What is known of a unit.  `wild`: a sample period with which it need not count samples; `unsure`: parameters that may break
   the model's limits; `off_grid`: its time is that of no sample. */
typedef struct {
    Phase phase;
    double time, stop, period;
    uint64_t rows;
    bool wild, unsure, off_grid;
} Twin;

static struct {
    Unit unit;
    Twin twin;
} units[UNITS], *now;

static struct {
    State state;
    Twin twin;
    uint8_t *bytes;
    size_t size;
} states[STATES];

static long long replays, instances, written;
static uint64_t seed, counter;

/* ---- chance: splitmix64 (Steele, Lea, Flood 2014) ------------------------------------------------------------------- */

static uint64_t chance(void) {
    uint64_t z = counter += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

static uint64_t below(uint64_t n) { return chance() % n; }
static bool once_in(uint64_t n) { return below(n) == 0; }
static double between(double a, double b) { return a + (b - a) * (double) (chance() >> 11) * 0x1p-53; }

#define ONE_OF(array) ((array)[below(sizeof(array) / sizeof *(array))])

static double any_number(void) {
    static const double odd[] = {0.0, -0.0, 1.0, -1.0, 1e-310, 1e-300, 1e300, -1e300, INFINITY, -INFINITY, NAN, 1e16, 0x1p-1074};
    return once_in(4) ? ONE_OF(odd) : between(-10.0, 10.0);
}

/* ---- what a call must answer ---------------------------------------------------------------------------------------- */

static void check(const char *call, int status, int want) {
    if (want != ANY && status != want) {
        fprintf(stderr, "seed %llu, call %lld: %s while %s gave %d, not %d (time %.17g, stop %.17g, period %.17g, %llu rows)\n",
                (unsigned long long) seed, calls, call, phase_names[now->twin.phase], status, want, now->twin.time,
                now->twin.stop, now->twin.period, (unsigned long long) now->twin.rows);
        exit(1);
    }
}

static int if_in(unsigned phases) { return phases & 1u << now->twin.phase ? OK : ERROR; }

static const unsigned alive = 1u << INSTANTIATED | 1u << INITIALIZATION | 1u << STEPPING;

static Twin fresh(void) {
    return (Twin) {.stop = INFINITY, .period = MODEL_SAMPLE_PERIOD, .rows = START_ROWS};
}

#endif
