/* Starts one unit and makes steps with it; test_sources.py defines the names in capitals. */
#include <fmi3Functions.h>
#include <stdio.h>
static const fmi3ValueReference outputs[] = {OUTPUTS};
static fmi3Instance unit;
void BEGIN(void) {
    unit = fmi3InstantiateCoSimulation("unit", TOKEN, "", fmi3False, fmi3False, fmi3False, false,
                                       NULL, 0, NULL, NULL, NULL);
    fmi3EnterInitializationMode(unit, fmi3False, 0, 0, fmi3False, 0);
#ifdef SEED
    fmi3SetUInt64(unit, &(fmi3ValueReference) {SEED}, 1, &(fmi3UInt64) {3}, 1);
#endif
    fmi3ExitInitializationMode(unit);
}
void STEP(double time, double size) {
    static double values[N_VALUES];
    bool event, end, early;
    double last;
    fmi3DoStep(unit, time, size, fmi3True, &event, &end, &early, &last);
    fmi3GetFloat64(unit, outputs, sizeof outputs / sizeof *outputs, values, N_VALUES);
    for (int i = 0; i < N_VALUES; i++) printf("%s %a\n", NAME, values[i]);
}
