/* FMI 3.0 co-simulation over a block: signatures and types, nothing else. */
#include "prefix.h"

/* The standard's header gives the model's prefix to its functions, too, where no library is to be made: there,
   FMI3_OVERRIDE_FUNCTION_PREFIX is defined. */
#ifndef FMI3_FUNCTION_PREFIX
#define FMI3_FUNCTION_PREFIX MODEL_PREFIX
#endif
#include <fmi3Functions.h>

#include <math.h>
#include <stdlib.h>

#include "block.h"

typedef struct {
    Block *block;
    fmi3LogMessageCallback log;
    fmi3InstanceEnvironment environment;
} Instance;

static Block *block_of(fmi3Instance instance) {
    return instance ? ((Instance *) instance)->block : NULL;
}

static fmi3Status status(bool done) {
    return done ? fmi3OK : fmi3Error;
}

/* Whether a call has its instance, and for n variables a list of references and a list of values. */
static bool complete(fmi3Instance instance, const void *references, size_t n, const void *values) {
    return instance && (n == 0 || (references && values) || block_refuse(block_of(instance), "an argument is NULL"));
}

static void write_log(void *owner, bool is_error, const char *category, const char *message) {
    const Instance *instance = owner;
    instance->log(instance->environment, is_error ? fmi3Error : fmi3OK, category, message);
}

const char *fmi3GetVersion(void) {
    return fmi3Version;
}

/* ---- life --------------------------------------------------------------------------------------------------------- */

fmi3Instance fmi3InstantiateCoSimulation(fmi3String instanceName, fmi3String instantiationToken, fmi3String resourcePath,
                                         fmi3Boolean visible, fmi3Boolean loggingOn, fmi3Boolean eventModeUsed,
                                         fmi3Boolean earlyReturnAllowed, const fmi3ValueReference requiredIntermediateVariables[],
                                         size_t nRequiredIntermediateVariables, fmi3InstanceEnvironment instanceEnvironment,
                                         fmi3LogMessageCallback logMessage, fmi3IntermediateUpdateCallback intermediateUpdate) {
    (void) resourcePath, (void) visible, (void) earlyReturnAllowed;
    (void) requiredIntermediateVariables, (void) nRequiredIntermediateVariables, (void) intermediateUpdate;
    Instance *instance = calloc(1, sizeof *instance);
    if (!instance) {
        return NULL;
    }
    instance->log = logMessage;
    instance->environment = instanceEnvironment;
    BlockLog log = {logMessage ? write_log : NULL, instance};
    instance->block = block_create(instanceName, 3, instantiationToken, log, loggingOn);
    if (!instance->block || (eventModeUsed && !block_refuse(instance->block, "Event Mode is not offered"))) {
        fmi3FreeInstance(instance);
        return NULL;
    }
    return instance;
}

void fmi3FreeInstance(fmi3Instance instance) {
    block_free(block_of(instance));
    free(instance);
}

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean loggingOn, size_t nCategories, const fmi3String categories[]) {
    return status(block_log_events(block_of(instance), loggingOn, nCategories, categories));
}

fmi3Status fmi3EnterConfigurationMode(fmi3Instance instance) {
    return status(block_enter_configuration(block_of(instance)));
}

fmi3Status fmi3ExitConfigurationMode(fmi3Instance instance) {
    return status(block_exit_configuration(block_of(instance)));
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean toleranceDefined, fmi3Float64 tolerance,
                                       fmi3Float64 startTime, fmi3Boolean stopTimeDefined, fmi3Float64 stopTime) {
    (void) toleranceDefined, (void) tolerance;
    return status(block_set_times(block_of(instance), startTime, stopTimeDefined ? stopTime : INFINITY)
                  && block_enter_initialization(block_of(instance)));
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
    return status(block_exit_initialization(block_of(instance)));
}

fmi3Status fmi3Terminate(fmi3Instance instance) {
    return status(block_terminate(block_of(instance)));
}

fmi3Status fmi3Reset(fmi3Instance instance) {
    return status(block_reset(block_of(instance)));
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 currentCommunicationPoint, fmi3Float64 communicationStepSize,
                      fmi3Boolean noSetFMUStatePriorToCurrentPoint, fmi3Boolean *eventHandlingNeeded,
                      fmi3Boolean *terminateSimulation, fmi3Boolean *earlyReturn, fmi3Float64 *lastSuccessfulTime) {
    (void) noSetFMUStatePriorToCurrentPoint;
    if (!complete(instance, eventHandlingNeeded, 1, terminateSimulation) || !complete(instance, earlyReturn, 1, lastSuccessfulTime)) {
        return fmi3Error;
    }
    bool done = block_do_step(block_of(instance), currentCommunicationPoint, communicationStepSize);
    *eventHandlingNeeded = fmi3False;
    *terminateSimulation = fmi3False;
    *earlyReturn = fmi3False;
    *lastSuccessfulTime = block_time(block_of(instance));
    return status(done);
}

/* ---- values: those of an array row by row, those of several variables one after the other --------------------------- */

/* Whether there is room for as many values as the variables have. */
static bool counts_agree(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                         const void *values, size_t nValues) {
    if (!complete(instance, valueReferences, nValueReferences, values)) {
        return false;
    }
    size_t all = 0;
    for (size_t i = 0; i < nValueReferences; i++) {
        size_t count = 0;
        if (!block_count(block_of(instance), valueReferences[i], &count)) {
            return false;
        }
        all += count;
    }
    return all == nValues || block_refuse(block_of(instance), "the variables have %zu values, not %zu", all, nValues);
}

static size_t count_of(fmi3Instance instance, fmi3ValueReference valueReference) {
    size_t count = 0;
    block_count(block_of(instance), valueReference, &count);
    return count;
}

#define TYPE_OF_VARIABLES(Type, get, set) \
    fmi3Status fmi3Get##Type(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences, \
                             fmi3##Type values[], size_t nValues) { \
        bool done = counts_agree(instance, valueReferences, nValueReferences, values, nValues); \
        for (size_t i = 0; i < nValueReferences && done; i++) { \
            done = get(block_of(instance), valueReferences[i], values); \
            values += count_of(instance, valueReferences[i]); \
        } \
        return status(done); \
    } \
    fmi3Status fmi3Set##Type(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences, \
                             const fmi3##Type values[], size_t nValues) { \
        bool done = counts_agree(instance, valueReferences, nValueReferences, values, nValues); \
        for (size_t i = 0; i < nValueReferences && done; i++) { \
            done = set(block_of(instance), valueReferences[i], values); \
            values += count_of(instance, valueReferences[i]); \
        } \
        return status(done); \
    }

static bool set_unsigned(Block *block, fmi3ValueReference valueReference, const fmi3UInt64 *value) {
    return block_set_unsigned(block, valueReference, *value);
}

TYPE_OF_VARIABLES(Float64, block_get_reals, block_set_reals)
TYPE_OF_VARIABLES(Int32, block_get_integers, block_set_integers)
TYPE_OF_VARIABLES(Boolean, block_get_booleans, block_set_booleans)
TYPE_OF_VARIABLES(UInt64, block_get_unsigned, set_unsigned)

/* ---- states ------------------------------------------------------------------------------------------------------- */

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *FMUState) {
    return status(block_save(block_of(instance), FMUState));
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState FMUState) {
    return status(block_restore(block_of(instance), FMUState));
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *FMUState) {
    return status(block_release(block_of(instance), FMUState));
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState FMUState, size_t *size) {
    return status(block_serialized_size(block_of(instance), FMUState, size));
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState FMUState, fmi3Byte serializedState[], size_t size) {
    return status(block_serialize(block_of(instance), FMUState, serializedState, size));
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte serializedState[], size_t size, fmi3FMUState *FMUState) {
    return status(block_deserialize(block_of(instance), serializedState, size, FMUState));
}

/* ---- what a block does not offer; its model description says so ----------------------------------------------------- */

#ifdef __GNUC__
#pragma GCC diagnostic ignored "-Wunused-parameter"
#endif

static fmi3Status refuse(fmi3Instance instance, const char *function) {
    return status(block_refuse(block_of(instance), "%s is not offered", function));
}

/* A type that no variable has: asking for none of them is fine. */
static fmi3Status no_such_variables(fmi3Instance instance, const fmi3ValueReference references[], size_t n, const void *values) {
    return status(complete(instance, references, n, values)
                  && (n == 0 || block_refuse_variable(block_of(instance), references[0], "is of another type")));
}

#define TYPE_WITHOUT_VARIABLES(Type) \
    fmi3Status fmi3Get##Type(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences, \
                             fmi3##Type values[], size_t nValues) { \
        return no_such_variables(instance, valueReferences, nValueReferences, values); \
    } \
    fmi3Status fmi3Set##Type(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences, \
                             const fmi3##Type values[], size_t nValues) { \
        return no_such_variables(instance, valueReferences, nValueReferences, values); \
    }

TYPE_WITHOUT_VARIABLES(Float32)
TYPE_WITHOUT_VARIABLES(Int8)
TYPE_WITHOUT_VARIABLES(UInt8)
TYPE_WITHOUT_VARIABLES(Int16)
TYPE_WITHOUT_VARIABLES(UInt16)
TYPE_WITHOUT_VARIABLES(UInt32)
TYPE_WITHOUT_VARIABLES(Int64)
TYPE_WITHOUT_VARIABLES(String)

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                         size_t valueSizes[], fmi3Binary values[], size_t nValues) {
    return no_such_variables(instance, valueReferences, nValueReferences, values);
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                         const size_t valueSizes[], const fmi3Binary values[], size_t nValues) {
    return no_such_variables(instance, valueReferences, nValueReferences, values);
}

fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                        fmi3Clock values[]) {
    return no_such_variables(instance, valueReferences, nValueReferences, values);
}

fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                        const fmi3Clock values[]) {
    return no_such_variables(instance, valueReferences, nValueReferences, values);
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String instanceName, fmi3String instantiationToken, fmi3String resourcePath,
                                          fmi3Boolean visible, fmi3Boolean loggingOn, fmi3InstanceEnvironment instanceEnvironment,
                                          fmi3LogMessageCallback logMessage) {
    return NULL;
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String instanceName, fmi3String instantiationToken, fmi3String resourcePath,
                                               fmi3Boolean visible, fmi3Boolean loggingOn,
                                               fmi3InstanceEnvironment instanceEnvironment, fmi3LogMessageCallback logMessage,
                                               fmi3ClockUpdateCallback clockUpdate, fmi3LockPreemptionCallback lockPreemption,
                                               fmi3UnlockPreemptionCallback unlockPreemption) {
    return NULL;
}

fmi3Status fmi3EnterEventMode(fmi3Instance instance) {
    return refuse(instance, __func__);
}

fmi3Status fmi3EnterStepMode(fmi3Instance instance) {
    return refuse(instance, __func__);
}

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance, fmi3ValueReference valueReference, size_t *nDependencies) {
    return refuse(instance, __func__);
}

fmi3Status fmi3GetVariableDependencies(fmi3Instance instance, fmi3ValueReference dependent, size_t elementIndicesOfDependent[],
                                       fmi3ValueReference independents[], size_t elementIndicesOfIndependents[],
                                       fmi3DependencyKind dependencyKinds[], size_t nDependencies) {
    return refuse(instance, __func__);
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[], size_t nUnknowns,
                                        const fmi3ValueReference knowns[], size_t nKnowns, const fmi3Float64 seed[], size_t nSeed,
                                        fmi3Float64 sensitivity[], size_t nSensitivity) {
    return refuse(instance, __func__);
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[], size_t nUnknowns,
                                    const fmi3ValueReference knowns[], size_t nKnowns, const fmi3Float64 seed[], size_t nSeed,
                                    fmi3Float64 sensitivity[], size_t nSensitivity) {
    return refuse(instance, __func__);
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                                    const fmi3Int32 orders[], fmi3Float64 values[], size_t nValues) {
    return refuse(instance, __func__);
}

fmi3Status fmi3GetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                                  fmi3Float64 intervals[], fmi3IntervalQualifier qualifiers[]) {
    return refuse(instance, __func__);
}

fmi3Status fmi3GetIntervalFraction(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                                   fmi3UInt64 counters[], fmi3UInt64 resolutions[], fmi3IntervalQualifier qualifiers[]) {
    return refuse(instance, __func__);
}

fmi3Status fmi3GetShiftDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                               fmi3Float64 shifts[]) {
    return refuse(instance, __func__);
}

fmi3Status fmi3GetShiftFraction(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                                fmi3UInt64 counters[], fmi3UInt64 resolutions[]) {
    return refuse(instance, __func__);
}

fmi3Status fmi3SetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                                  const fmi3Float64 intervals[]) {
    return refuse(instance, __func__);
}

fmi3Status fmi3SetIntervalFraction(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                                   const fmi3UInt64 counters[], const fmi3UInt64 resolutions[]) {
    return refuse(instance, __func__);
}

fmi3Status fmi3SetShiftDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                               const fmi3Float64 shifts[]) {
    return refuse(instance, __func__);
}

fmi3Status fmi3SetShiftFraction(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                                const fmi3UInt64 counters[], const fmi3UInt64 resolutions[]) {
    return refuse(instance, __func__);
}

fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance instance) {
    return refuse(instance, __func__);
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *discreteStatesNeedUpdate,
                                    fmi3Boolean *terminateSimulation, fmi3Boolean *nominalsOfContinuousStatesChanged,
                                    fmi3Boolean *valuesOfContinuousStatesChanged, fmi3Boolean *nextEventTimeDefined,
                                    fmi3Float64 *nextEventTime) {
    return refuse(instance, __func__);
}

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance instance) {
    return refuse(instance, __func__);
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance, fmi3Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi3Boolean *enterEventMode, fmi3Boolean *terminateSimulation) {
    return refuse(instance, __func__);
}

fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 time) {
    return refuse(instance, __func__);
}

fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 continuousStates[], size_t nContinuousStates) {
    return refuse(instance, __func__);
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance instance, fmi3Float64 derivatives[], size_t nContinuousStates) {
    return refuse(instance, __func__);
}

fmi3Status fmi3GetEventIndicators(fmi3Instance instance, fmi3Float64 eventIndicators[], size_t nEventIndicators) {
    return refuse(instance, __func__);
}

fmi3Status fmi3GetContinuousStates(fmi3Instance instance, fmi3Float64 continuousStates[], size_t nContinuousStates) {
    return refuse(instance, __func__);
}

fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance instance, fmi3Float64 nominals[], size_t nContinuousStates) {
    return refuse(instance, __func__);
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance instance, size_t *nEventIndicators) {
    return refuse(instance, __func__);
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance instance, size_t *nContinuousStates) {
    return refuse(instance, __func__);
}

fmi3Status fmi3ActivateModelPartition(fmi3Instance instance, fmi3ValueReference clockReference, fmi3Float64 activationTime) {
    return refuse(instance, __func__);
}
