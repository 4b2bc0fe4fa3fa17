/* A sampled block behind any version of FMI: variables by reference, samples by absolute time, states by value.

   A block has two forms.  In the scalar form a variable is one number; a step makes any number of samples from inputs that
   are held, and outputs are the last sample's.  In the block form inputs and outputs have block_size rows, a sample each:
   sample i of a step takes row i of the inputs and gives row i of the outputs, and rows that a shorter step leaves over
   repeat the last sample.  There, variables may have columns, too.

   Nothing here knows a model (model_table.h does) or an FMI version (fmi2.c and fmi3.c do).  Every function returns
   whether it did what was asked; if not, it has logged why, and nothing has changed (unless the model itself fails
   within a step: then the samples before it are made). */
#ifndef BLOCK_H
#define BLOCK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "prefix.h"

PRIVATE_FROM_HERE

typedef enum { KIND_REAL, KIND_BOOLEAN, KIND_INTEGER, KIND_UNSIGNED } Kind;
typedef enum { ROLE_TIME, ROLE_INPUT, ROLE_TUNABLE, ROLE_FIXED, ROLE_SAMPLING, ROLE_OUTPUT, ROLE_STRUCTURAL } Role;

/* One variable; its value reference is its place in the table.  It has `count` columns among the inputs, parameters or
   outputs, from column `first` on; a matrix has its elements row by row.  Without bounds these are infinite. */
typedef struct {
    const char *name;
    Kind kind;
    Role role;
    size_t first;
    size_t count;
    double minimum, maximum;
} BlockVariable;

/* Where messages go: the environment's logger, called through the FMI version's own signature. */
typedef struct {
    void (*write)(void *owner, bool is_error, const char *category, const char *message);
    void *owner;
} BlockLog;

typedef struct Block Block;
typedef struct BlockState BlockState;

#define LOG_ERROR "logStatusError"
#define LOG_EVENTS "logEvents"

/* NULL where the token is not that of the model in this version of FMI (2 or 3) or memory is short.  Noise whose seed is 0 follows from the name, so that two
   instances of other names, which nobody gave seeds, have independent noise; an instance that is called as its model is has
   that of the key 0. */
Block *block_create(const char *name, int version, const char *token, BlockLog log, bool log_events);
void block_free(Block *block);

bool block_log_events(Block *block, bool on, size_t n, const char *const categories[]);
bool block_refuse(Block *block, const char *format, ...);
bool block_refuse_variable(Block *block, uint32_t reference, const char *reason);

/* Only in configuration, which only the block form has, block_size can be set. */
bool block_enter_configuration(Block *block);
bool block_exit_configuration(Block *block);

/* Without an end stop_time is INFINITY. */
bool block_set_times(Block *block, double start_time, double stop_time);
bool block_enter_initialization(Block *block);
bool block_exit_initialization(Block *block);
bool block_terminate(Block *block);
bool block_reset(Block *block);

/* Make every sample k with time < k * sample_period <= time + step; at most MODEL_MOST_SAMPLES of them, in the block form at most
   block_size, and none past the stop time. */
bool block_do_step(Block *block, double time, double step);
double block_time(const Block *block);

/* How many values a variable has, columns times rows; they are passed row by row.  Unsigned ones, which need all of their
   64 bits, have one. */
bool block_count(Block *block, uint32_t reference, size_t *count);
bool block_is_unsigned(uint32_t reference);
bool block_get_reals(Block *block, uint32_t reference, double values[]);
bool block_get_integers(Block *block, uint32_t reference, int32_t values[]); /* rounded; 0 for what is no number */
bool block_get_booleans(Block *block, uint32_t reference, bool values[]);
bool block_get_unsigned(Block *block, uint32_t reference, uint64_t *value);
bool block_set_reals(Block *block, uint32_t reference, const double values[]);
bool block_set_integers(Block *block, uint32_t reference, const int32_t values[]);
bool block_set_booleans(Block *block, uint32_t reference, const bool values[]);
bool block_set_unsigned(Block *block, uint32_t reference, uint64_t value);

/* A saved state is all that decides what follows: a copy in memory, or bytes that outlive the process.  Both begin with
   the model that they are of, and another's is refused. */
bool block_save(Block *block, void **state);
bool block_restore(Block *block, const void *state);
bool block_release(Block *block, void **state);
bool block_serialized_size(Block *block, const void *state, size_t *size);
bool block_serialize(Block *block, const void *state, uint8_t *bytes, size_t size);
bool block_deserialize(Block *block, const uint8_t *bytes, size_t size, void **state);

PRIVATE_TO_HERE

#endif
