/* The model's functions, as the core calls them; step.c has them. */
#ifndef MODEL_H
#define MODEL_H

#include "prefix.h"

PRIVATE_FROM_HERE

/* State, input, parameters, normals, sample period and constants to the next state and the output. */
int model_step(const double **arg, double **res, long long *iw, double *w);

/* Parameters and sample period to the constants; only where model_table.h defines MODEL_CONSTANTS. */
int model_constants(const double **arg, double **res, long long *iw, double *w);

/* Parameters to the state before the first sample and the outputs shown before it. */
int model_initial(const double **arg, double **res, long long *iw, double *w);

/* Parameters and sample period to which of the limits they break; only where model_table.h defines MODEL_LIMITS. */
int model_limits(const double **arg, double **res, long long *iw, double *w);

PRIVATE_TO_HERE

#endif
