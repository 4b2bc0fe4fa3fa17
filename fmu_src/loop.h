/* The loop of a compiled run over the rows of a log, behind a block's step in the same file.

   That file defines STEP, its function; NS, NU, NW and NY, the sizes of its state, input, normals and
   output; and SZ_ARG and SZ_RES, the numbers of its arguments and results. Where it defines CONSTANTS,
   that gives the NC numbers that STEP takes last, of the parameters and the sample period. */

#include <stdint.h>
#include "noise.h"

#ifdef _WIN32
#define EXPORT __declspec(dllexport)
#else
#define EXPORT __attribute__((visibility("default")))
#endif

enum { ROWS = 128 }; /* whose normals are drawn at a time, and stay in the processor's cache */

/* The state is in s before and after; the normals are w, or where that is NULL drawn, or where
   channels is NULL too, zero. Gives how many samples could be made. */
EXPORT int64_t run(int64_t n, double *s, const double *u, const double *p, const double *h,
                   double *y, const double *w, const uint64_t *channels, uint64_t seed,
                   int64_t first, casadi_int *iw, double *work) {
  const double *arg[SZ_ARG];
  double *res[SZ_RES], next[NS + 1], normals[ROWS * NW + 1], *now = s, *following = next;
  double once[NC + 1];
  int64_t k = 0;
#ifdef CONSTANTS
  arg[0] = p;
  arg[1] = h;
  res[0] = once;
  if (CONSTANTS(arg, res, iw, work, 0)) return 0;
#endif
  for (int64_t i = 0; i < ROWS * NW; ++i) normals[i] = 0.0;
  /* What a step leaves as it was, it need not copy from the one to the other. */
  for (int i = 0; i < NS; ++i) next[i] = s[i];
  for (; k < n; ++k) {
    if (NW && !w && channels && k % ROWS == 0) {
      noise_fill(normals, seed, channels, NW, first + k, n - k < ROWS ? n - k : ROWS);
    }
    arg[0] = now;
    arg[1] = u + k * NU;
    arg[2] = p;
    arg[3] = w ? w + k * NW : normals + k % ROWS * NW;
    arg[4] = h;
#ifdef CONSTANTS
    arg[5] = once;
#endif
    res[0] = following;
    res[1] = y + k * NY;
    if (STEP(arg, res, iw, work, 0)) break;
    double *made = following;
    following = now;
    now = made;
  }
  for (int i = 0; i < NS && now != s; ++i) s[i] = now[i];
  return k;
}
