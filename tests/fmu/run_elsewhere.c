/* Runs an FMI 3 unit of scalars: LIBRARY TOKEN SEED_REFERENCE PERIOD ROWS NB NU NY REFERENCES...
   Reads the inputs (rows x (nb booleans and nu reals), all as doubles) from the file "in" and writes
   the real outputs to "out". A unit without noise has no seed: its reference is -1. */
#include <fmi3FunctionTypes.h>
#include <stdio.h>
#include <stdlib.h>
#ifdef _WIN32
#include <windows.h>
#define OPEN(path) LoadLibraryA(path)
#define FUNCTION(name) ((name##TYPE *) (void *) GetProcAddress(library, #name))
#else
#include <dlfcn.h>
#define OPEN(path) dlopen(path, RTLD_NOW)
#define FUNCTION(name) ((name##TYPE *) dlsym(library, #name))
#endif

int main(int count, char **word) {
    void *library = count > 8 ? (void *) OPEN(word[1]) : NULL;
    if (!library) return fprintf(stderr, "the library does not load\n"), 1;
    double period = strtod(word[4], NULL), last;
    int rows = atoi(word[5]), nb = atoi(word[6]), nu = atoi(word[7]), ny = atoi(word[8]);
    fmi3ValueReference seed = (fmi3ValueReference) atoi(word[3]), refs[96], *reals = refs + nb;
    for (int i = 0; i < nb + nu + ny; i++) refs[i] = (fmi3ValueReference) atoi(word[9 + i]);
    fmi3Instance unit = FUNCTION(fmi3InstantiateCoSimulation)(
        "unit", word[2], "", fmi3False, fmi3False, fmi3False, fmi3False, NULL, 0, NULL, NULL, NULL);
    if (!unit) return fprintf(stderr, "no instance\n"), 1;
    int bad = FUNCTION(fmi3EnterInitializationMode)(unit, fmi3False, 0, 0, fmi3False, 0);
    if (atoi(word[3]) >= 0) bad |= FUNCTION(fmi3SetUInt64)(unit, &seed, 1, &(fmi3UInt64) {11}, 1);
    bad |= FUNCTION(fmi3ExitInitializationMode)(unit);
    FILE *in = fopen("in", "rb"), *out = fopen("out", "wb");
    for (int k = 0; k < rows && !bad; k++) {
        double u[64], y[64];
        bool flags[64], event, end, early;
        bad |= fread(u, sizeof *u, (size_t) (nb + nu), in) != (size_t) (nb + nu);
        for (int i = 0; i < nb; i++) flags[i] = u[i] != 0;
        bad |= FUNCTION(fmi3SetBoolean)(unit, refs, (size_t) nb, flags, (size_t) nb);
        bad |= FUNCTION(fmi3SetFloat64)(unit, reals, (size_t) nu, u + nb, (size_t) nu);
        bad |= FUNCTION(fmi3DoStep)(unit, k * period, period, fmi3True, &event, &end, &early, &last);
        bad |= FUNCTION(fmi3GetFloat64)(unit, reals + nu, (size_t) ny, y, (size_t) ny);
        fwrite(y, sizeof *y, (size_t) ny, out);
    }
    fclose(out);
    FUNCTION(fmi3FreeInstance)(unit);
    return bad;
}
