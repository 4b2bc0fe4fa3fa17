/* Generated from the block HeadingEstimator; do not edit. */
#ifndef MODEL_PREFIX
#define MODEL_PREFIX HeadingEstimator_
#endif
