/* Standard normals that are a function of (seed, channel, sample) and of nothing else.

   The words are those of Philox4x64-10 (Salmon, Moraes, Dror, Shaw, "Parallel random numbers: as easy as 1, 2, 3",
   SC11, 2011) with key (seed, channel): word `sample` of the stream that numpy.random.Philox(key=[seed, channel])
   gives.  A run may therefore start anywhere, step by any size and be repeated from any saved state.  A word becomes a
   normal through a ziggurat (Marsaglia, Tsang, "The ziggurat method for generating random variables", Journal of
   Statistical Software 5(8), 2000) of 256 layers. */
#ifndef NOISE_H
#define NOISE_H

#include <stddef.h>
#include <stdint.h>

#include "prefix.h"

/* The four words that cover samples 4 * block to 4 * block + 3 of one channel: derived data, never saved. */
typedef struct {
    uint64_t block;
    uint64_t words[4];
} NoiseCache;

/* Philox4x64-10: ten rounds over the counter. */
void philox4x64(const uint64_t key[2], const uint64_t counter[4], uint64_t words[4]);

/* The normal of the sample whose word is `word`.  One word in 67 does not suffice; what else is needed comes from
   counters (sample, attempt, 0, 0), attempt from 1, which are no other sample's.  Beyond 3.65 the last bit is that of
   the C library's logarithm; elsewhere the library decides comparisons only. */
double noise_normal(uint64_t seed, uint64_t channel, int64_t sample, uint64_t word);

/* Empty the cache; needed whenever the seed may have changed. */
void noise_forget(NoiseCache *cache);

/* The normal of one sample of one channel. */
double noise_at(NoiseCache *cache, uint64_t seed, uint64_t channel, int64_t sample);

/* The normals of samples first to first + n - 1 of several channels: out[k * n_channels + c] is that of sample
   first + k of channels[c]. */
void noise_fill(double *out, uint64_t seed, const uint64_t *channels, size_t n_channels, int64_t first, size_t n);

#endif
