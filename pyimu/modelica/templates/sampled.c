/* {{ head }} */
#ifndef {{ prefix | upper }}_C
#define {{ prefix | upper }}_C

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "ModelicaUtilities.h"

/* A product and a sum are rounded one after the other, as in the co-simulation unit. */
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(__GNUC__)
#pragma GCC push_options
#pragma GCC optimize("fp-contract=off")
#elif defined(_MSC_VER)
#pragma fp_contract(off)
#endif
#if defined(_MSC_VER) || defined(__cplusplus)
#define restrict
#endif

{{ functions }}

/* What is remembered from sample to sample. */
typedef struct {
    double before[{{ states }}], after[{{ states }}]; /* the states from which the last sample was made, and that it left */
    double period, parameters[{{ parameters }}];
    double sample; /* the number of the last sample; 0 at the start, less before */
    const double *arg[{{ work.arg }}];
    double *res[{{ work.res }}];
    long long iw[{{ work.iw }}];
    double w[{{ work.w }}];
} {{ prefix }}_memory;

void *{{ prefix }}_create(double period, const double *parameters, size_t n) {
    {{ prefix }}_memory *memory;
    if (!(period > 0.0)) {
        ModelicaFormatError("{{ name }}: samplePeriod is %g s and must be a positive number of seconds", period);
    }
    if (n != {{ parameters }}) {
        ModelicaFormatError("{{ name }}: %lu parameters were given, {{ parameters }} are needed", (unsigned long) n);
    }
    memory = ({{ prefix }}_memory *) calloc(1, sizeof *memory);
    if (!memory) {
        ModelicaError("{{ name }}: no memory");
    }
    memory->period = period;
    memory->sample = -1.0;
    memcpy(memory->parameters, parameters, sizeof memory->parameters);
    return memory;
}

void {{ prefix }}_free(void *memory) {
    free(memory);
}

/* Sample `number` from the inputs u to the outputs y.  0 is the start; any other follows the one before, or is that one
   made once more, as a tool may want an event's values several times. */
void {{ prefix }}_sample(void *object, double number, const double *u, size_t nu, double *y, size_t ny) {
    {{ prefix }}_memory *m = ({{ prefix }}_memory *) object;
    int failed;
    if (nu != {{ inputs }} || ny != {{ outputs }}) {
        ModelicaFormatError("{{ name }}: {{ inputs }} inputs give {{ outputs }} outputs, not %lu %lu", (unsigned long) nu,
                            (unsigned long) ny);
    }
    if (number == 0.0) {
        m->arg[0] = u;
        m->arg[1] = m->parameters;
        m->res[0] = m->after;
        m->res[1] = y;
        failed = {{ prefix }}_{{ initial }}(m->arg, m->res, m->iw, m->w, 0);
    } else {
        if (number == m->sample + 1.0 && m->sample >= 0.0) {
            memcpy(m->before, m->after, sizeof m->before);
        } else if (number != m->sample) {
            ModelicaFormatError("{{ name }}: sample %g was asked for after sample %g", number, m->sample);
        }
        m->arg[0] = m->before;
        m->arg[1] = u;
        m->arg[2] = m->parameters;
        m->arg[3] = NULL;
        m->arg[4] = &m->period;
        m->res[0] = m->after;
        m->res[1] = y;
        failed = {{ prefix }}_{{ step }}(m->arg, m->res, m->iw, m->w, 0);
    }
    m->sample = number;
    if (failed) {
        ModelicaFormatError("{{ name }}: sample %g cannot be evaluated", number);
    }
}

{% for macro in macros %}
#undef {{ macro }}
{% endfor %}
#if defined(_MSC_VER) || defined(__cplusplus)
#undef restrict
#endif
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC pop_options
#endif

#endif
