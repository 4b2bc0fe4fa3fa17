/* What the fuzzer of the units needs of a version of FMI: one set of calls over both; see units_fmi2.h and units_fmi3.h. */
#ifndef UNITS_H
#define UNITS_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "model_table.h"

typedef void *Unit;
typedef void *State;

/* A value of any kind, and a kind that no unit has variables of. */
typedef union {
    double real;
    int32_t integer; /* a Boolean, too */
    uint64_t whole;
} Value;

enum { KIND_OTHER = KIND_UNSIGNED + 1 };

/* Numbers of the statuses, which both versions share. */
enum { OK = 0, DISCARD = 2, ERROR = 3, ANY = -1 };

/* How an instance is asked for. */
typedef enum { WELL, WRONG_TOKEN, NO_TOKEN, WRONG_TYPE, NO_CALLBACKS, N_WAYS } Way;

static long long calls, messages, refused;

/* A message must be text for a terminal. */
static void heard(const char *message) {
    messages++;
    for (const char *c = message; *c; c++) {
        if ((unsigned char) *c < ' ' || *c == 127) {
            fprintf(stderr, "a message has the character %d: %s\n", *c, message);
            exit(1);
        }
    }
}

static int counted(int status) {
    calls++;
    refused += status != OK;
    return status;
}

/* Arrays as long as they are said to be, so that the sanitizers see who goes past their ends. */
static void *exactly(size_t n, size_t size) {
    void *array = malloc(n * size);
    if (!array && n) {
        fputs("no memory\n", stderr);
        exit(1);
    }
    return array;
}

/* Calls get or set with an array of a type, to and from Values; NULL stays NULL. */
#define THROUGH(Type, member, call) \
    do { \
        Type *array_ = values ? exactly(n_values, sizeof(Type)) : NULL; \
        for (size_t i = 0; values && i < n_values; i++) array_[i] = (Type) values[i].member; \
        int status_ = counted(call); \
        for (size_t i = 0; values && i < n_values && status_ == OK; i++) values[i].member = array_[i]; \
        free(array_); \
        return status_; \
    } while (0)

#endif
