/* Generated from the block LowPass; do not edit. */
#ifndef MODEL_PREFIX
#define MODEL_PREFIX LowPass_
#endif
