/* Generated from the block {{ name }}; do not edit. */
#include "model.h"

/* The functions as casadi writes them are private to this file. */
#ifndef CASADI_SYMBOL_EXPORT
#define CASADI_SYMBOL_EXPORT static
#endif
#ifdef __GNUC__
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#endif

{{ functions | trim }}

/* What the core calls. */
int model_step(const double **arg, double **res, long long *iw, double *w) {
    return {{ step }}(arg, res, iw, w, 0);
}

int model_initial(const double **arg, double **res, long long *iw, double *w) {
    return {{ initial }}(arg, res, iw, w, 0);
}
{% if constants %}

int model_constants(const double **arg, double **res, long long *iw, double *w) {
    return {{ constants.name() }}(arg, res, iw, w, 0);
}
{% endif %}
{% if limits %}

int model_limits(const double **arg, double **res, long long *iw, double *w) {
    return {{ limits.broken.name() }}(arg, res, iw, w, 0);
}
{% endif %}
