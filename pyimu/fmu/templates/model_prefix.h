/* Generated from the block {{ name }}; do not edit. */
#ifndef MODEL_PREFIX
#define MODEL_PREFIX {{ name }}_
#endif
