/* FMI 2.0 co-simulation over a block: signatures and types, nothing else. */
#include "prefix.h"

/* The standard's header gives the model's prefix to its functions, too, where no library is to be made: there,
   FMI2_OVERRIDE_FUNCTION_PREFIX is defined. */
#ifndef FMI2_FUNCTION_PREFIX
#define FMI2_FUNCTION_PREFIX MODEL_PREFIX
#endif
#include <fmi2Functions.h>

#include <math.h>
#include <string.h>

#include "block.h"

typedef struct {
    Block *block;
    char *name;
    fmi2CallbackLogger logger;
    fmi2ComponentEnvironment environment;
} Component;

static Block *block_of(fmi2Component c) {
    return c ? ((Component *) c)->block : NULL;
}

static fmi2Status status(bool done) {
    return done ? fmi2OK : fmi2Error;
}

/* Whether a call has its instance, and for n variables a list of references and a list of values. */
static bool complete(fmi2Component c, const void *references, size_t n, const void *values) {
    return c && (n == 0 || (references && values) || block_refuse(block_of(c), "an argument is NULL"));
}

static void write_log(void *owner, bool is_error, const char *category, const char *message) {
    const Component *component = owner;
    component->logger(component->environment, component->name, is_error ? fmi2Error : fmi2OK, category, "%s", message);
}

const char *fmi2GetTypesPlatform(void) {
    return fmi2TypesPlatform;
}

const char *fmi2GetVersion(void) {
    return fmi2Version;
}

/* ---- life --------------------------------------------------------------------------------------------------------- */

static char *copy_of(const char *text) {
    char *copy = malloc(strlen(text) + 1);
    return copy ? strcpy(copy, text) : NULL;
}

fmi2Component fmi2Instantiate(fmi2String instanceName, fmi2Type fmuType, fmi2String fmuGUID, fmi2String fmuResourceLocation,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean loggingOn) {
    (void) fmuResourceLocation, (void) visible;
    Component *component = calloc(1, sizeof *component);
    if (!component || !functions || fmuType != fmi2CoSimulation) {
        free(component);
        return NULL;
    }
    component->name = copy_of(instanceName ? instanceName : "");
    component->logger = functions->logger;
    component->environment = functions->componentEnvironment;
    BlockLog log = {component->logger ? write_log : NULL, component};
    component->block = component->name ? block_create(component->name, 2, fmuGUID, log, loggingOn) : NULL;
    if (!component->block) {
        fmi2FreeInstance(component);
        return NULL;
    }
    return component;
}

void fmi2FreeInstance(fmi2Component c) {
    if (c) {
        block_free(block_of(c));
        free(((Component *) c)->name);
        free(c);
    }
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean loggingOn, size_t nCategories, const fmi2String categories[]) {
    return status(block_log_events(block_of(c), loggingOn, nCategories, categories));
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean toleranceDefined, fmi2Real tolerance, fmi2Real startTime,
                               fmi2Boolean stopTimeDefined, fmi2Real stopTime) {
    (void) toleranceDefined, (void) tolerance;
    return status(block_set_times(block_of(c), startTime, stopTimeDefined ? stopTime : INFINITY));
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
    return status(block_enter_initialization(block_of(c)));
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
    return status(block_exit_initialization(block_of(c)));
}

fmi2Status fmi2Terminate(fmi2Component c) {
    return status(block_terminate(block_of(c)));
}

fmi2Status fmi2Reset(fmi2Component c) {
    return status(block_reset(block_of(c)));
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real currentCommunicationPoint, fmi2Real communicationStepSize,
                      fmi2Boolean noSetFMUStatePriorToCurrentPoint) {
    (void) noSetFMUStatePriorToCurrentPoint;
    return status(block_do_step(block_of(c), currentCommunicationPoint, communicationStepSize));
}

/* ---- values ------------------------------------------------------------------------------------------------------- */

/* FMI 2 has no unsigned type, so that a seed is an Integer like others. */
static bool get_integer(Block *block, fmi2ValueReference reference, fmi2Integer *value) {
    if (!block_is_unsigned(reference)) {
        return block_get_integers(block, reference, value);
    }
    uint64_t seed = 0;
    bool done = block_get_unsigned(block, reference, &seed);
    *value = (fmi2Integer) seed;
    return done;
}

static bool set_integer(Block *block, fmi2ValueReference reference, fmi2Integer value) {
    if (!block_is_unsigned(reference)) {
        return block_set_integers(block, reference, &value);
    }
    if (value < 0) {
        return block_refuse_variable(block, reference, "must not be negative");
    }
    return block_set_unsigned(block, reference, (uint64_t) value);
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Real value[]) {
    bool done = complete(c, vr, nvr, value);
    for (size_t i = 0; i < nvr && done; i++) {
        done = block_get_reals(block_of(c), vr[i], &value[i]);
    }
    return status(done);
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Integer value[]) {
    bool done = complete(c, vr, nvr, value);
    for (size_t i = 0; i < nvr && done; i++) {
        done = get_integer(block_of(c), vr[i], &value[i]);
    }
    return status(done);
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Boolean value[]) {
    bool done = complete(c, vr, nvr, value);
    for (size_t i = 0; i < nvr && done; i++) {
        bool answer = false;
        done = block_get_booleans(block_of(c), vr[i], &answer);
        value[i] = answer ? fmi2True : fmi2False;
    }
    return status(done);
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Real value[]) {
    bool done = complete(c, vr, nvr, value);
    for (size_t i = 0; i < nvr && done; i++) {
        done = block_set_reals(block_of(c), vr[i], &value[i]);
    }
    return status(done);
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Integer value[]) {
    bool done = complete(c, vr, nvr, value);
    for (size_t i = 0; i < nvr && done; i++) {
        done = set_integer(block_of(c), vr[i], value[i]);
    }
    return status(done);
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Boolean value[]) {
    bool done = complete(c, vr, nvr, value);
    for (size_t i = 0; i < nvr && done; i++) {
        done = block_set_booleans(block_of(c), vr[i], &(bool) {value[i] != fmi2False});
    }
    return status(done);
}

/* No block has texts. */
static fmi2Status refuse_texts(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const void *value) {
    return status(complete(c, vr, nvr, value) && (nvr == 0 || block_refuse_variable(block_of(c), vr[0], "is no String")));
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2String value[]) {
    return refuse_texts(c, vr, nvr, value);
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2String value[]) {
    return refuse_texts(c, vr, nvr, value);
}

/* ---- states ------------------------------------------------------------------------------------------------------- */

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *FMUstate) {
    return status(block_save(block_of(c), FMUstate));
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate FMUstate) {
    return status(block_restore(block_of(c), FMUstate));
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *FMUstate) {
    return status(block_release(block_of(c), FMUstate));
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate FMUstate, size_t *size) {
    return status(block_serialized_size(block_of(c), FMUstate, size));
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate FMUstate, fmi2Byte serializedState[], size_t size) {
    return status(block_serialize(block_of(c), FMUstate, (uint8_t *) serializedState, size));
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte serializedState[], size_t size, fmi2FMUstate *FMUstate) {
    return status(block_deserialize(block_of(c), (const uint8_t *) serializedState, size, FMUstate));
}

/* ---- what can be asked about a step: it is always done when fmi2DoStep returns ------------------------------------- */

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind s, fmi2Real *value) {
    if (!complete(c, value, 1, value)) {
        return fmi2Error;
    }
    if (s != fmi2LastSuccessfulTime) {
        return fmi2Discard;
    }
    *value = block_time(block_of(c));
    return fmi2OK;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind s, fmi2Boolean *value) {
    if (!complete(c, value, 1, value)) {
        return fmi2Error;
    }
    if (s != fmi2Terminated) {
        return fmi2Discard;
    }
    *value = fmi2False; /* a block never ends a simulation by itself */
    return fmi2OK;
}

/* ---- what a block does not offer; its model description says so ----------------------------------------------------- */

#ifdef __GNUC__
#pragma GCC diagnostic ignored "-Wunused-parameter"
#endif

static fmi2Status refuse(fmi2Component c, const char *function) {
    return status(block_refuse(block_of(c), "%s is not offered", function));
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind s, fmi2Status *value) {
    return complete(c, value, 1, value) ? fmi2Discard : fmi2Error;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind s, fmi2Integer *value) {
    return complete(c, value, 1, value) ? fmi2Discard : fmi2Error;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind s, fmi2String *value) {
    return complete(c, value, 1, value) ? fmi2Discard : fmi2Error;
}

fmi2Status fmi2CancelStep(fmi2Component c) {
    return refuse(c, __func__);
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Integer order[],
                                       const fmi2Real value[]) {
    return refuse(c, __func__);
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Integer order[],
                                        fmi2Real value[]) {
    return refuse(c, __func__);
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference vUnknown_ref[], size_t nUnknown,
                                        const fmi2ValueReference vKnown_ref[], size_t nKnown, const fmi2Real dvKnown[],
                                        fmi2Real dvUnknown[]) {
    return refuse(c, __func__);
}

fmi2Status fmi2EnterEventMode(fmi2Component c) {
    return refuse(c, __func__);
}

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *fmi2eventInfo) {
    return refuse(c, __func__);
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c) {
    return refuse(c, __func__);
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean noSetFMUStatePriorToCurrentPoint, fmi2Boolean *enterEventMode,
                                       fmi2Boolean *terminateSimulation) {
    return refuse(c, __func__);
}

fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time) {
    return refuse(c, __func__);
}

fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t nx) {
    return refuse(c, __func__);
}

fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real derivatives[], size_t nx) {
    return refuse(c, __func__);
}

fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real eventIndicators[], size_t ni) {
    return refuse(c, __func__);
}

fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t nx) {
    return refuse(c, __func__);
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real x_nominal[], size_t nx) {
    return refuse(c, __func__);
}
