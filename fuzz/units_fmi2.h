/* The fuzzer's calls over FMI 2. */
#include <fmi2Functions.h>

#define TOKEN MODEL_TOKEN_FMI2
enum { FMI = 2 };

static void tell(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category,
                 fmi2String message, ...) {
    (void) environment, (void) name, (void) status, (void) category;
    va_list arguments;
    char text[1024];
    va_start(arguments, message);
    vsnprintf(text, sizeof text, message, arguments);
    va_end(arguments);
    heard(text);
}

static const fmi2CallbackFunctions callbacks = {tell, calloc, free, NULL, NULL};

static Unit make(const char *name, const char *token, bool log, Way way) {
    calls++;
    return fmi2Instantiate(name, way == WRONG_TYPE ? fmi2ModelExchange : fmi2CoSimulation, token, NULL,
                           way == NO_CALLBACKS ? NULL : &callbacks, fmi2False, log);
}

static void discard(Unit unit) {
    calls++;
    fmi2FreeInstance(unit);
}

static int set_times(Unit unit, double start, bool stops, double stop) {
    return counted(fmi2SetupExperiment(unit, fmi2False, 0.0, start, stops, stop));
}

static int enter(Unit unit, double start, bool stops, double stop) {
    (void) start, (void) stops, (void) stop;
    return counted(fmi2EnterInitializationMode(unit));
}

static int leave(Unit unit) { return counted(fmi2ExitInitializationMode(unit)); }
static int terminate(Unit unit) { return counted(fmi2Terminate(unit)); }
static int reset(Unit unit) { return counted(fmi2Reset(unit)); }
static int configure(Unit unit, bool begin) { return (void) unit, (void) begin, ERROR; }

static int make_step(Unit unit, double time, double size, bool without) {
    (void) without;
    return counted(fmi2DoStep(unit, time, size, fmi2True));
}

static int log_events(Unit unit, bool on, size_t n, const char *const categories[]) {
    return counted(fmi2SetDebugLogging(unit, on, n, categories));
}

static int get(Unit unit, int kind, const uint32_t *references, size_t n, Value *values, size_t n_values) {
    switch (kind) {
        case KIND_REAL: THROUGH(fmi2Real, real, fmi2GetReal(unit, references, n, array_));
        case KIND_BOOLEAN: THROUGH(fmi2Boolean, integer, fmi2GetBoolean(unit, references, n, array_));
        case KIND_INTEGER:
        case KIND_UNSIGNED: THROUGH(fmi2Integer, integer, fmi2GetInteger(unit, references, n, array_));
        default: return counted(fmi2GetString(unit, references, n, (fmi2String *) values));
    }
}

static int set(Unit unit, int kind, const uint32_t *references, size_t n, Value *values, size_t n_values) {
    switch (kind) {
        case KIND_REAL: THROUGH(fmi2Real, real, fmi2SetReal(unit, references, n, array_));
        case KIND_BOOLEAN: THROUGH(fmi2Boolean, integer, fmi2SetBoolean(unit, references, n, array_));
        case KIND_INTEGER:
        case KIND_UNSIGNED: THROUGH(fmi2Integer, integer, fmi2SetInteger(unit, references, n, array_));
        default: return counted(fmi2SetString(unit, references, n, (fmi2String *) values));
    }
}

static int save(Unit unit, State *state) { return counted(fmi2GetFMUstate(unit, state)); }
static int restore(Unit unit, State state) { return counted(fmi2SetFMUstate(unit, state)); }
static int release(Unit unit, State *state) { return counted(fmi2FreeFMUstate(unit, state)); }
static int size_of(Unit unit, State state, size_t *size) { return counted(fmi2SerializedFMUstateSize(unit, state, size)); }

static int to_bytes(Unit unit, State state, uint8_t *bytes, size_t size) {
    return counted(fmi2SerializeFMUstate(unit, state, (fmi2Byte *) bytes, size));
}

static int from_bytes(Unit unit, const uint8_t *bytes, size_t size, State *state) {
    return counted(fmi2DeSerializeFMUstate(unit, (const fmi2Byte *) bytes, size, state));
}

/* A call that a unit of this kind answers without doing anything; `want` is what it must say where the unit is one. */
static int other(Unit unit, uint64_t which, int *want) {
    double real = 0.0;
    int integer = 0;
    fmi2String text;
    fmi2Status status;
    const fmi2StatusKind about = (fmi2StatusKind) (which / 16 % 4);
    bool none = which / 64 % 4 == 0;
    *want = ERROR;
    switch (which % 16) {
        case 0: return counted(fmi2CancelStep(unit));
        case 1: return counted(fmi2SetRealInputDerivatives(unit, NULL, 0, NULL, NULL));
        case 2: return counted(fmi2GetRealOutputDerivatives(unit, NULL, 0, NULL, NULL));
        case 3: return counted(fmi2GetDirectionalDerivative(unit, NULL, 0, NULL, 0, NULL, NULL));
        case 4: return counted(fmi2EnterEventMode(unit));
        case 5: return counted(fmi2NewDiscreteStates(unit, NULL));
        case 6: return counted(fmi2EnterContinuousTimeMode(unit));
        case 7: return counted(fmi2CompletedIntegratorStep(unit, fmi2True, NULL, NULL));
        case 8: return counted(fmi2SetTime(unit, 1.0));
        case 9: return counted(fmi2SetContinuousStates(unit, NULL, 0));
        case 10: return counted(fmi2GetDerivatives(unit, NULL, 0));
        case 11:
            *want = none ? ERROR : about == fmi2LastSuccessfulTime ? OK : DISCARD;
            return counted(fmi2GetRealStatus(unit, about, none ? NULL : &real));
        case 12:
            *want = none ? ERROR : about == fmi2Terminated ? OK : DISCARD;
            return counted(fmi2GetBooleanStatus(unit, about, none ? NULL : &integer));
        case 13: *want = none ? ERROR : DISCARD; return counted(fmi2GetIntegerStatus(unit, about, none ? NULL : &integer));
        case 14: *want = none ? ERROR : DISCARD; return counted(fmi2GetStringStatus(unit, about, none ? NULL : &text));
        default: *want = none ? ERROR : DISCARD; return counted(fmi2GetStatus(unit, about, none ? NULL : &status));
    }
}
