/* Generated from the block AttitudeUkf; do not edit. */
#ifndef MODEL_PREFIX
#define MODEL_PREFIX AttitudeUkf_
#endif
