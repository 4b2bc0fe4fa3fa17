/* Saved states: copies in memory, and bytes with a seal. */
#include "block_core.h"

#include <stdlib.h>
#include <string.h>

typedef struct {
    char magic[8];
    uint64_t model;
    uint64_t check;
} Seal;

/* FNV-1a (Fowler, Noll, Vo). */
uint64_t block_digest(const void *data, size_t size) {
    const unsigned char *bytes = data;
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    for (size_t i = 0; i < size; i++) {
        hash = (hash ^ bytes[i]) * UINT64_C(0x100000001b3);
    }
    return hash;
}

static Seal seal_of(const struct BlockState *state) {
    Seal seal = {{'b', 'l', 'o', 'c', 'k', ' ', '3', 0}, block_digest(MODEL_TOKEN, strlen(MODEL_TOKEN)), block_digest(state, block_size_of(state->rows))};
    return seal;
}

bool block_save(Block *block, void **state) {
    if (!block_allowed(block, SAVE) || !state) {
        return false;
    }
    size_t size = block_size_of(block->now->rows);
    void *copy = realloc(*state, size); /* an earlier state may have had other rows */
    if (!copy) {
        return block_refuse(block, "%s: no memory for a state", MODEL_NAME);
    }
    *state = memcpy(copy, block->now, size);
    return true;
}

bool block_restore(Block *block, const void *state) {
    if (!block_allowed(block, RESTORE)) {
        return false;
    }
    if (!state) {
        return block_refuse(block, "%s: there is no state to restore", MODEL_NAME);
    }
    size_t size = block_size_of(((const struct BlockState *) state)->rows);
    struct BlockState *copy = malloc(size);
    if (!copy) {
        return block_refuse(block, "%s: no memory for a state", MODEL_NAME);
    }
    block_take(block, memcpy(copy, state, size));
    return true;
}

void block_release(void **state) {
    if (state) {
        free(*state);
        *state = NULL;
    }
}

bool block_serialized_size(Block *block, const void *state, size_t *size) {
    if (!block_allowed(block, SAVE)) {
        return false;
    }
    if (!state) {
        return block_refuse(block, "%s: there is no state to serialize", MODEL_NAME);
    }
    *size = sizeof(Seal) + block_size_of(((const struct BlockState *) state)->rows);
    return true;
}

bool block_serialize(Block *block, const void *state, uint8_t *bytes, size_t size) {
    size_t needed = 0;
    if (!block_serialized_size(block, state, &needed)) {
        return false;
    }
    if (!bytes || size < needed) {
        return block_refuse(block, "%s: a serialized state needs %zu bytes", MODEL_NAME, needed);
    }
    Seal seal = seal_of(state);
    memcpy(bytes, &seal, sizeof seal);
    memcpy(bytes + sizeof seal, state, needed - sizeof seal);
    return true;
}

/* The rows of a serialized state; 0 where so many bytes are none. */
static uint64_t rows_in(const uint8_t *bytes, size_t size) {
    struct BlockState read;
    if (!bytes || size < sizeof(Seal) + sizeof read) {
        return 0;
    }
    memcpy(&read, bytes + sizeof(Seal), sizeof read);
    bool possible = read.rows >= 1 && read.rows <= MAX_ROWS && read.phase < N_PHASES;
    return possible && size == sizeof(Seal) + block_size_of(read.rows) ? read.rows : 0;
}

bool block_deserialize(Block *block, const uint8_t *bytes, size_t size, void **state) {
    if (!block_allowed(block, RESTORE) || !state) {
        return false;
    }
    uint64_t rows = rows_in(bytes, size);
    if (rows == 0) {
        return block_refuse(block, "%s: these %zu bytes are no state", MODEL_NAME, size);
    }
    struct BlockState *read = malloc(block_size_of(rows));
    if (!read) {
        return block_refuse(block, "%s: no memory for a state", MODEL_NAME);
    }
    memcpy(read, bytes + sizeof(Seal), block_size_of(rows));
    Seal seal = seal_of(read);
    if (memcmp(bytes, &seal, sizeof seal) != 0) {
        free(read);
        return block_refuse(block, "%s: the bytes are another model's state, or damaged", MODEL_NAME);
    }
    *state = read;
    return true;
}
