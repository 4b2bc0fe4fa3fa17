/* Generated from the block ImuSensor; do not edit. */
#ifndef MODEL_PREFIX
#define MODEL_PREFIX ImuSensor_
#endif
