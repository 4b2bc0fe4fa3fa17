/* The fuzzer's calls over FMI 3. */
#include <fmi3Functions.h>

#define TOKEN MODEL_TOKEN_FMI3
enum { FMI = 3 };

static void tell(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message) {
    (void) environment, (void) status, (void) category;
    heard(message);
}

static Unit make(const char *name, const char *token, bool log, Way way) {
    calls++;
    return fmi3InstantiateCoSimulation(name, token, NULL, false, log, way == WRONG_TYPE, false, NULL, 0, NULL,
                                       way == NO_CALLBACKS ? NULL : tell, NULL);
}

static void discard(Unit unit) {
    calls++;
    fmi3FreeInstance(unit);
}

static int set_times(Unit unit, double start, bool stops, double stop) {
    return (void) unit, (void) start, (void) stops, (void) stop, ERROR;
}

static int enter(Unit unit, double start, bool stops, double stop) {
    return counted(fmi3EnterInitializationMode(unit, false, 0.0, start, stops, stop));
}

static int leave(Unit unit) { return counted(fmi3ExitInitializationMode(unit)); }
static int terminate(Unit unit) { return counted(fmi3Terminate(unit)); }
static int reset(Unit unit) { return counted(fmi3Reset(unit)); }

static int configure(Unit unit, bool begin) {
    return counted(begin ? fmi3EnterConfigurationMode(unit) : fmi3ExitConfigurationMode(unit));
}

static int make_step(Unit unit, double time, double size, bool without) {
    bool event, end, early;
    double last;
    return counted(fmi3DoStep(unit, time, size, true, &event, &end, without ? NULL : &early, &last));
}

static int log_events(Unit unit, bool on, size_t n, const char *const categories[]) {
    return counted(fmi3SetDebugLogging(unit, on, n, categories));
}

static int get(Unit unit, int kind, const uint32_t *references, size_t n, Value *values, size_t n_values) {
    switch (kind) {
        case KIND_REAL: THROUGH(fmi3Float64, real, fmi3GetFloat64(unit, references, n, array_, n_values));
        case KIND_BOOLEAN: THROUGH(fmi3Boolean, integer, fmi3GetBoolean(unit, references, n, array_, n_values));
        case KIND_INTEGER: THROUGH(fmi3Int32, integer, fmi3GetInt32(unit, references, n, array_, n_values));
        case KIND_UNSIGNED: THROUGH(fmi3UInt64, whole, fmi3GetUInt64(unit, references, n, array_, n_values));
        default: THROUGH(fmi3UInt16, whole, fmi3GetUInt16(unit, references, n, array_, n_values));
    }
}

static int set(Unit unit, int kind, const uint32_t *references, size_t n, Value *values, size_t n_values) {
    switch (kind) {
        case KIND_REAL: THROUGH(fmi3Float64, real, fmi3SetFloat64(unit, references, n, array_, n_values));
        case KIND_BOOLEAN: THROUGH(fmi3Boolean, integer, fmi3SetBoolean(unit, references, n, array_, n_values));
        case KIND_INTEGER: THROUGH(fmi3Int32, integer, fmi3SetInt32(unit, references, n, array_, n_values));
        case KIND_UNSIGNED: THROUGH(fmi3UInt64, whole, fmi3SetUInt64(unit, references, n, array_, n_values));
        default: THROUGH(fmi3UInt16, whole, fmi3SetUInt16(unit, references, n, array_, n_values));
    }
}

static int save(Unit unit, State *state) { return counted(fmi3GetFMUState(unit, state)); }
static int restore(Unit unit, State state) { return counted(fmi3SetFMUState(unit, state)); }
static int release(Unit unit, State *state) { return counted(fmi3FreeFMUState(unit, state)); }
static int size_of(Unit unit, State state, size_t *size) { return counted(fmi3SerializedFMUStateSize(unit, state, size)); }

static int to_bytes(Unit unit, State state, uint8_t *bytes, size_t size) {
    return counted(fmi3SerializeFMUState(unit, state, bytes, size));
}

static int from_bytes(Unit unit, const uint8_t *bytes, size_t size, State *state) {
    return counted(fmi3DeserializeFMUState(unit, bytes, size, state));
}

/* A call that a unit of this kind answers without doing anything; `want` is what it must say where the unit is one. */
static int other(Unit unit, uint64_t which, int *want) {
    const uint32_t reference = (uint32_t) (which / 32 % 3);
    *want = ERROR;
    switch (which % 32) {
        case 0: return counted(fmi3EnterEventMode(unit));
        case 1: return counted(fmi3EnterStepMode(unit));
        case 2: return counted(fmi3GetNumberOfVariableDependencies(unit, reference, NULL));
        case 3: return counted(fmi3GetVariableDependencies(unit, reference, NULL, NULL, NULL, NULL, 0));
        case 4: return counted(fmi3GetDirectionalDerivative(unit, NULL, 0, NULL, 0, NULL, 0, NULL, 0));
        case 5: return counted(fmi3GetAdjointDerivative(unit, NULL, 0, NULL, 0, NULL, 0, NULL, 0));
        case 6: return counted(fmi3GetOutputDerivatives(unit, NULL, 0, NULL, NULL, 0));
        case 7: return counted(fmi3GetIntervalDecimal(unit, NULL, 0, NULL, NULL));
        case 8: return counted(fmi3GetShiftFraction(unit, NULL, 0, NULL, NULL));
        case 9: return counted(fmi3SetIntervalFraction(unit, NULL, 0, NULL, NULL));
        case 10: return counted(fmi3EvaluateDiscreteStates(unit));
        case 11: return counted(fmi3UpdateDiscreteStates(unit, NULL, NULL, NULL, NULL, NULL, NULL));
        case 12: return counted(fmi3EnterContinuousTimeMode(unit));
        case 13: return counted(fmi3CompletedIntegratorStep(unit, true, NULL, NULL));
        case 14: return counted(fmi3SetTime(unit, 1.0));
        case 15: return counted(fmi3GetContinuousStates(unit, NULL, 0));
        case 16: return counted(fmi3GetNumberOfContinuousStates(unit, NULL));
        case 17: return counted(fmi3ActivateModelPartition(unit, reference, 0.0));
        case 18: *want = OK; return counted(fmi3GetFloat32(unit, NULL, 0, NULL, 0));
        case 19: return counted(fmi3GetString(unit, &reference, 1, NULL, 1));
        case 20: return counted(fmi3SetBinary(unit, NULL, 1, NULL, NULL, 1));
        case 21: return counted(fmi3GetClock(unit, &reference, 1, NULL));
        case 22: *want = OK; return counted(fmi3SetClock(unit, NULL, 0, NULL));
        default: return counted(fmi3GetEventIndicators(unit, NULL, 0));
    }
}
