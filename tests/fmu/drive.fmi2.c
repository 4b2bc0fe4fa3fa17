/* Starts one unit and makes steps with it; test_sources.py defines the names in capitals. */
#include <fmi2Functions.h>
#include <stdio.h>
#include <stdlib.h>
static const fmi2ValueReference outputs[] = {OUTPUTS};
static fmi2Component unit;
static void tell(fmi2ComponentEnvironment e, fmi2String n, fmi2Status s, fmi2String c,
                 fmi2String message, ...) { puts(message); }
static const fmi2CallbackFunctions callbacks = {tell, calloc, free, NULL, NULL};
void BEGIN(void) {
    unit = fmi2Instantiate("unit", fmi2CoSimulation, TOKEN, "", &callbacks, fmi2False, fmi2False);
    fmi2SetupExperiment(unit, fmi2False, 0, 0, fmi2False, 0);
    fmi2EnterInitializationMode(unit);
#ifdef SEED
    fmi2SetInteger(unit, &(fmi2ValueReference) {SEED}, 1, &(fmi2Integer) {3});
#endif
    fmi2ExitInitializationMode(unit);
}
void STEP(double time, double size) {
    double values[N_VALUES];
    fmi2DoStep(unit, time, size, fmi2True);
    fmi2GetReal(unit, outputs, sizeof outputs / sizeof *outputs, values);
    for (int i = 0; i < N_VALUES; i++) printf("%s %a\n", NAME, values[i]);
}
