/* States: kept, taken, written and read, damaged, missing and another's. */
#ifndef UNITS_STATES_H
#define UNITS_STATES_H

#include "units_values.h"

/* ---- states --------------------------------------------------------------------------------------------------------- */

static void keep_state(void) {
    size_t i = below(STATES);
    if (once_in(30)) {
        check("saving nowhere", save(now->unit, NULL), ERROR);
        return;
    }
    check("saving", save(now->unit, &states[i].state), OK);
    states[i].twin = now->twin;
}

static void take_state(void) {
    size_t i = below(STATES);
    int want = states[i].state ? OK : ERROR;
    check("restoring", restore(now->unit, states[i].state), want);
    if (want == OK) {
        now->twin = states[i].twin;
    }
}

static void drop_state(void) {
    check("freeing a state", release(now->unit, once_in(10) ? NULL : &states[below(STATES)].state), OK);
}

/* What begins otherwise than a state of this model does. */
static void strange_state(void) {
    uint64_t head[64];
    for (size_t i = 0; i < 64; i++) {
        head[i] = chance();
    }
    if (once_in(2) && states[0].state) {
        memcpy(head, states[0].state, sizeof *head); /* a state, but another model's */
    }
    State state = head;
    size_t size;
    switch (below(4)) {
        case 0: check("restoring another's state", restore(now->unit, state), ERROR); break;
        case 1: check("freeing another's state", release(now->unit, &state), ERROR); break;
        case 2: check("sizing another's state", size_of(now->unit, state, &size), ERROR); break;
        default: check("saving over another's state", save(now->unit, &state), ERROR);
    }
}

static void write_state(void) {
    size_t i = below(STATES), size = 0;
    bool missing = once_in(20), cramped = once_in(20);
    check("sizing", size_of(now->unit, states[i].state, missing ? NULL : &size), states[i].state && !missing ? OK : ERROR);
    if (!size) {
        return;
    }
    uint8_t *bytes = exactly(size, 1);
    int status = to_bytes(now->unit, states[i].state, once_in(20) ? (cramped = true, NULL) : bytes, size - cramped);
    check("serializing", status, cramped ? ERROR : OK);
    if (status != OK) {
        free(bytes);
        return;
    }
    free(states[i].bytes);
    states[i].bytes = bytes;
    states[i].size = size;
    written += (long long) size;
}

static void read_state(void) {
    size_t i = below(STATES), size = states[i].size;
    State state = NULL;
    if (!states[i].bytes || !states[i].state) {
        uint8_t noise[200];
        check("reading noise", from_bytes(now->unit, once_in(3) ? NULL : noise, below(sizeof noise), &state), ERROR);
        return;
    }
    uint8_t *bytes = memcpy(exactly(size + 1, 1), states[i].bytes, size);
    bool damaged = once_in(2);
    size_t given = size;
    if (damaged && once_in(2)) {
        bytes[below(size)] ^= (uint8_t) (1u << below(8));
    } else if (damaged) {
        given = once_in(2) ? below(size) : size + 1;
    }
    int status = from_bytes(now->unit, bytes, given, &state);
    check("deserializing", status, damaged ? ERROR : OK);
    if (status == OK) {
        check("freeing what was read", release(now->unit, &state), OK);
    }
    free(bytes);
}

#endif
