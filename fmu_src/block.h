/* A sampled block behind any version of FMI: variables by reference, samples by absolute time, states by value.

   Nothing here knows a model (model_table.h does) or an FMI version (fmi2.c and fmi3.c do).  Every function returns
   whether it did what was asked; if not, it has logged why, and nothing has changed (unless the model itself fails
   within a step: then the samples before it are made). */
#ifndef BLOCK_H
#define BLOCK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum { KIND_REAL, KIND_BOOLEAN, KIND_INTEGER, KIND_SEED } Kind;
typedef enum { ROLE_TIME, ROLE_INPUT, ROLE_TUNABLE, ROLE_FIXED, ROLE_OUTPUT } Role;

/* One variable; its value reference is its place in the table. */
typedef struct {
    const char *name;
    Kind kind;
    Role role;
    double start;
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

/* NULL where the token is another model's or memory is short. */
Block *block_create(const char *token, BlockLog log, bool log_events);
void block_free(Block *block);

bool block_log_events(Block *block, bool on, size_t n, const char *const categories[]);
bool block_refuse(Block *block, const char *format, ...);
bool block_refuse_variable(Block *block, uint32_t reference, const char *reason);

bool block_set_start_time(Block *block, double start_time);
bool block_enter_initialization(Block *block);
bool block_exit_initialization(Block *block);
bool block_terminate(Block *block);
bool block_reset(Block *block);

/* Make every sample k with time < k * sample_period <= time + step; inputs are held, outputs are the last sample's. */
bool block_do_step(Block *block, double time, double step);
double block_time(const Block *block);

/* Values are doubles inside; booleans are 0 or 1.  The seed needs all of its 64 bits and goes its own way. */
int32_t block_integer(double value); /* rounded, at most 32 bits; 0 for what is no number */
bool block_is_seed(uint32_t reference);
bool block_get(Block *block, uint32_t reference, Kind kind, double *value);
bool block_set(Block *block, uint32_t reference, Kind kind, double value);
bool block_get_seed(Block *block, uint32_t reference, uint64_t *seed);
bool block_set_seed(Block *block, uint32_t reference, uint64_t seed);

/* A saved state is all that decides what follows: a copy in memory, or bytes that outlive the process. */
bool block_save(Block *block, void **state);
bool block_restore(Block *block, const void *state);
void block_release(void **state);
size_t block_serialized_size(void);
bool block_serialize(Block *block, const void *state, uint8_t *bytes, size_t size);
bool block_deserialize(Block *block, const uint8_t *bytes, size_t size, void **state);

#endif
