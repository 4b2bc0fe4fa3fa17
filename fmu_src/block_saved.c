/* Saved states: copies in memory, and bytes with a seal. */
#include "block_core.h"

#include <stdlib.h>
#include <string.h>

/* FNV-1a (Fowler, Noll, Vo). */
uint64_t block_digest(const void *data, size_t size) {
    const unsigned char *bytes = data;
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    for (size_t i = 0; i < size; i++) {
        hash = (hash ^ bytes[i]) * UINT64_C(0x100000001b3);
    }
    return hash;
}

uint64_t block_model(void) {
    return block_digest(MODEL_TOKEN_FMI3, strlen(MODEL_TOKEN_FMI3));
}

/* Whether this is a state of this model: its first two members are read, nothing else. */
static bool is_own(const void *state) {
    uint64_t head[2];
    memcpy(head, state, sizeof head);
    return head[0] == STATE_LAYOUT && head[1] == block_model();
}

static bool own(Block *block, const void *state) {
    if (!state) {
        return block_refuse(block, "%s: there is no state", MODEL_NAME);
    }
    return is_own(state) || block_refuse(block, "%s: the state is another model's", MODEL_NAME);
}

bool block_save(Block *block, void **state) {
    if (!block_allowed(block, SAVE)) {
        return false;
    }
    if (!state) {
        return block_refuse(block, "%s: there is no place for a state", MODEL_NAME);
    }
    if (*state && !own(block, *state)) {
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
    if (!block_allowed(block, RESTORE) || !own(block, state)) {
        return false;
    }
    size_t size = block_size_of(((const struct BlockState *) state)->rows);
    struct BlockState *copy = malloc(size);
    if (!copy) {
        return block_refuse(block, "%s: no memory for a state", MODEL_NAME);
    }
    block_take(block, memcpy(copy, state, size));
    return true;
}

bool block_release(Block *block, void **state) {
    if (!block) {
        return false;
    }
    if (!state || !*state) {
        return true;
    }
    if (!own(block, *state)) {
        return false;
    }
    free(*state);
    *state = NULL;
    return true;
}

/* A serialized state: the digest of what follows, and that. */
static size_t serialized_size(uint64_t rows) {
    return sizeof(uint64_t) + block_size_of(rows);
}

bool block_serialized_size(Block *block, const void *state, size_t *size) {
    if (!block_allowed(block, SAVE) || !own(block, state)) {
        return false;
    }
    if (!size) {
        return block_refuse(block, "%s: there is no place for a size", MODEL_NAME);
    }
    *size = serialized_size(((const struct BlockState *) state)->rows);
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
    uint64_t check = block_digest(state, needed - sizeof check);
    memcpy(bytes, &check, sizeof check);
    memcpy(bytes + sizeof check, state, needed - sizeof check);
    return true;
}

/* The rows of a serialized state; 0 where so many bytes are none. */
static uint64_t rows_in(const uint8_t *bytes, size_t size) {
    struct BlockState read;
    if (!bytes || size < serialized_size(0)) {
        return 0;
    }
    memcpy(&read, bytes + sizeof(uint64_t), sizeof read);
    bool possible = read.rows >= 1 && read.rows <= MAX_ROWS && read.phase < N_PHASES;
    return possible && size == serialized_size(read.rows) ? read.rows : 0;
}

bool block_deserialize(Block *block, const uint8_t *bytes, size_t size, void **state) {
    if (!block_allowed(block, RESTORE)) {
        return false;
    }
    if (!state) {
        return block_refuse(block, "%s: there is no place for a state", MODEL_NAME);
    }
    uint64_t rows = rows_in(bytes, size), check;
    if (rows == 0) {
        return block_refuse(block, "%s: these %zu bytes are no state", MODEL_NAME, size);
    }
    memcpy(&check, bytes, sizeof check);
    if (check != block_digest(bytes + sizeof check, size - sizeof check)) {
        return block_refuse(block, "%s: the bytes of the state are damaged", MODEL_NAME);
    }
    if (!own(block, bytes + sizeof check)) {
        return false;
    }
    void *read = malloc(size - sizeof check);
    if (!read) {
        return block_refuse(block, "%s: no memory for a state", MODEL_NAME);
    }
    *state = memcpy(read, bytes + sizeof check, size - sizeof check);
    return true;
}
