/* Generated from the block StrapdownIns; do not edit. */
#ifndef MODEL_PREFIX
#define MODEL_PREFIX StrapdownIns_
#endif
