/* Generated from the block {{ name }}; do not edit. */
#ifndef MODEL_TABLE_H
#define MODEL_TABLE_H

#include <math.h>

#include "block.h"

#define MODEL_NAME "{{ name }}"
{% for version, token in tokens.items() %}
#define MODEL_TOKEN_FMI{{ version }} "{{ token }}"
{% endfor %}
{% if constants %}
#define MODEL_CONSTANTS
{% endif %}
{% if limits %}
#define MODEL_LIMITS
{% endif %}
#define MODEL_SEED UINT64_C({{ seed }})
#define MODEL_SAMPLE_PERIOD {{ sample_period | c_number }}

enum {
    N_INPUTS = {{ sizes.inputs }},
    N_PARAMETERS = {{ sizes.parameters }},
    N_OUTPUTS = {{ sizes.outputs }},
    N_STATES = {{ sizes.states }},
    N_CONSTANTS = {{ sizes.constants }},
    N_NOISE = {{ sizes.noise }},
    N_VARIABLES = {{ variables | length }}
};

/* Room that the generated functions need. */
enum { WORK_ARG = {{ work.arg }}, WORK_RES = {{ work.res }}, WORK_IW = {{ work.iw }}, WORK_W = {{ work.w }} };

/* Rows of inputs and outputs. */
enum { IN_BLOCKS = {{ 1 if block_size else 0 }}, START_ROWS = {{ block_size or 1 }}, MAX_ROWS = {{ most_samples if block_size else 1 }} };

/* In a step: what a sample takes says how many, as nothing breaks a step off. */
enum { MODEL_MOST_SAMPLES = {{ most_samples }} };

static const BlockVariable variables[] = {
{% for v in variables %}
    {{ "{" }}{{ v.name | c_string }}, KIND_{{ v.kind | upper }}, ROLE_{{ v.role | upper }}, {{ v.first }}, {{ v.count }}, {{ v.minimum | c_number }}, {{ v.maximum | c_number }}},
{% endfor %}
};

/* Value references that mean something to every block. */
enum {
{% for v in variables if v.role == "sampling" %}
    {{ v.name | upper }} = {{ v.reference }},
{% endfor %}
{% if not noise %}
    SEED = N_VARIABLES, /* none: there is no noise */
{% endif %}
};

{% for what, starts in (("input", input_starts), ("parameter", parameter_starts)) %}
static const double {{ what }}_starts[] = {{ "{" }}{{ starts | map("c_number") | join(", ") or "0" }}};
{% endfor %}

{% if limits %}
/* What the parameters must keep together, and with the sample period. */
enum { N_LIMITS = {{ limits.texts | length }} };

static const char *const limit_texts[] = {
{% for text in limits.texts %}
    {{ text | c_string }},
{% endfor %}
};

{% endif %}
/* The noise stream of each channel{{ "" if noise else "; there is none" }}. */
static const uint64_t noise_channels[] = {
{% for channel in noise %}
    UINT64_C({{ channel.number }}), /* {{ channel.name | replace("*/", "* /") }} */
{% else %}
    0
{% endfor %}
};

#endif
