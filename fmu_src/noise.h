/* Standard normals that are a function of (seed, channel, sample) and of nothing else.

   The words are those of Philox4x64-10 (Salmon, Moraes, Dror, Shaw, "Parallel random numbers: as easy as 1, 2, 3",
   SC11, 2011) with key (seed, channel): word `sample` of the stream that numpy.random.Philox(key=[seed, channel])
   gives.  A run may therefore start anywhere, step by any size and be repeated from any saved state. */
#ifndef NOISE_H
#define NOISE_H

#include <stdint.h>

/* The four words that cover samples 4 * block to 4 * block + 3 of one channel: derived data, never saved. */
typedef struct {
    uint64_t block;
    uint64_t words[4];
} NoiseCache;

/* Philox4x64-10: ten rounds over the counter. */
void philox4x64(const uint64_t key[2], const uint64_t counter[4], uint64_t words[4]);

/* The standard normal of a random word: its top 53 bits, centred, through the inverse normal distribution. */
double noise_normal(uint64_t word);

/* Empty the cache; needed whenever the seed may have changed. */
void noise_forget(NoiseCache *cache);

/* The normal of one sample of one channel. */
double noise_at(NoiseCache *cache, uint64_t seed, uint64_t channel, int64_t sample);

#endif
