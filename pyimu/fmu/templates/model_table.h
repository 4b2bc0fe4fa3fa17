/* Generated from the block {{ name }}; do not edit. */
#ifndef MODEL_TABLE_H
#define MODEL_TABLE_H

#include <math.h>

#include "block.h"

#define MODEL_NAME "{{ name }}"
#define MODEL_TOKEN "{{ token }}"
#define MODEL_STEP {{ step }}
#define MODEL_INITIAL {{ initial }}
#define MODEL_SEED UINT64_C({{ seed }})

enum {
    N_INPUTS = {{ sizes.inputs }},
    N_PARAMETERS = {{ sizes.parameters }},
    N_OUTPUTS = {{ sizes.outputs }},
    N_STATES = {{ sizes.states }},
    N_NOISE = {{ sizes.noise }},
    N_VARIABLES = {{ variables | length }}
};

/* Room that the generated functions need. */
enum { WORK_ARG = {{ work.arg }}, WORK_RES = {{ work.res }}, WORK_IW = {{ work.iw }}, WORK_W = {{ work.w }} };

/* Places in the table of variables, which are value references. */
enum {
    TIME = 0,
    FIRST_INPUT = TIME + 1,
    FIRST_PARAMETER = FIRST_INPUT + N_INPUTS,
    FIRST_OUTPUT = FIRST_PARAMETER + N_PARAMETERS,
    SAMPLE_PERIOD = FIRST_OUTPUT + N_OUTPUTS,
    SEED = SAMPLE_PERIOD + 1
};

static const BlockVariable variables[] = {
{% for v in variables %}
    {{ "{" }}{{ v.name | c_string }}, KIND_{{ v.kind | upper }}, ROLE_{{ v.role | upper }}, {{ v.start | c_number }}},
{% endfor %}
};

/* The noise stream of each channel{{ "" if noise else "; there is none" }}. */
static const uint64_t noise_channels[] = {
{% for channel in noise %}
    UINT64_C({{ channel.number }}), /* {{ channel.name }} */
{% else %}
    0
{% endfor %}
};

#endif
