/* Generated from the block RoverDrive; do not edit. */
#ifndef MODEL_PREFIX
#define MODEL_PREFIX RoverDrive_
#endif
