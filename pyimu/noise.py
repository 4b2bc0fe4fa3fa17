"""Standard normals that are a function of (seed, channel, sample) only: the ones that ``fmu_src/noise.c`` draws.

The words are those of Philox4x64-10 (Salmon, Moraes, Dror, Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC11,
2011) with key (seed, channel): sample k takes word k of ``numpy.random.Philox(key=[seed, channel])``.  A word becomes a
normal through AS 241 (Wichura, "The percentage points of the normal distribution", Applied Statistics 37 (1988), 477-484,
routine PPND16).  Every operation is the one of the C, in its order, so the bits are the same.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numba import njit

_U = np.uint64
_MULTIPLIER_0, _MULTIPLIER_1 = _U(0xD2E7470EE14C6C93), _U(0xCA5A826395121157)
_WEYL_0, _WEYL_1 = _U(0x9E3779B97F4A7C15), _U(0xBB67AE8584CAA73B)
_LOW, _32, _11, _3, _1 = _U(0xFFFFFFFF), _U(32), _U(11), _U(3), _U(1)

# Coefficients of numerator and denominator, degree 0 first: the centre, the tails, the far tails.
_A = (3.3871328727963666080e0, 1.3314166789178437745e2, 1.9715909503065514427e3, 1.3731693765509461125e4,
      4.5921953931549871457e4, 6.7265770927008700853e4, 3.3430575583588128105e4, 2.5090809287301226727e3)
_B = (1.0, 4.2313330701600911252e1, 6.8718700749205790830e2, 5.3941960214247511077e3,
      2.1213794301586595867e4, 3.9307895800092710610e4, 2.8729085735721942674e4, 5.2264952788528545610e3)
_C = (1.42343711074968357734e0, 4.63033784615654529590e0, 5.76949722146069140550e0, 3.64784832476320460504e0,
      1.27045825245236838258e0, 2.41780725177450611770e-1, 2.27238449892691845833e-2, 7.74545014278341407640e-4)
_D = (1.0, 2.05319162663775882187e0, 1.67638483018380384940e0, 6.89767334985100004550e-1,
      1.48103976427480074590e-1, 1.51986665636164571966e-2, 5.47593808499534494600e-4, 1.05075007164441684324e-9)
_E = (6.65790464350110377720e0, 5.46378491116411436990e0, 1.78482653991729133580e0, 2.96560571828504891230e-1,
      2.65321895265761230930e-2, 1.24266094738807843860e-3, 2.71155556874348757815e-5, 2.01033439929228813265e-7)
_F = (1.0, 5.99832206555887937690e-1, 1.36929880922735805310e-1, 1.48753612908506148525e-2,
      7.86869131145613259100e-4, 1.84631831751005468180e-5, 1.42151175831644588870e-7, 2.04426310338993978564e-15)


def normals(seed: int, channels: Sequence[int], first_sample: int, n: int) -> np.ndarray:
    """Standard normals (n, len(channels)) of samples ``first_sample`` to ``first_sample + n - 1``.

    The first sample that an FMU started at time zero makes is number 1.  Raises ValueError for a seed or a channel outside
    0 to 2^64 - 1 and for a negative ``n``.
    """
    for what, value in [("seed", seed)] + [("channel", c) for c in channels]:
        if not 0 <= int(value) < 2**64:
            raise ValueError(f"{what} {value} is not in 0 to 2^64 - 1")
    if n < 0:
        raise ValueError(f"n = {n} is negative")
    out = np.empty((n, len(channels)))
    _fill(_U(int(seed)), np.array([int(c) for c in channels], dtype=np.uint64), _U(int(first_sample) % 2**64), out)
    return out


@njit(cache=True)
def _fill(seed, channels, first, out):
    """A block of four words at a time, in the order of the samples."""
    n = out.shape[0]
    for c in range(out.shape[1]):
        row = 0
        while row < n:
            sample = first + _U(row)
            words = _philox(seed, channels[c], (sample >> _U(2)) + _1)
            for i in range(sample & _3, 4):
                if row < n:
                    out[row, c] = _normal(words[i])
                    row += 1


@njit(cache=True)
def _philox(key_0, key_1, counter):
    """The four words of Philox4x64-10 for counter (counter, 0, 0, 0)."""
    x0, x1, x2, x3 = counter, _U(0), _U(0), _U(0)
    for _ in range(10):
        high_0, low_0 = _high_product(_MULTIPLIER_0, x0), _MULTIPLIER_0 * x0
        high_1, low_1 = _high_product(_MULTIPLIER_1, x2), _MULTIPLIER_1 * x2
        x0, x1, x2, x3 = high_1 ^ x1 ^ key_0, low_1, high_0 ^ x3 ^ key_1, low_0
        key_0 += _WEYL_0
        key_1 += _WEYL_1
    return x0, x1, x2, x3


@njit(cache=True)
def _high_product(a, b):
    """The upper 64 of the 128 bits of a product."""
    a0, a1, b0, b1 = a & _LOW, a >> _32, b & _LOW, b >> _32
    middle = a1 * b0 + ((a0 * b0) >> _32)
    carry = a0 * b1 + (middle & _LOW)
    return a1 * b1 + (middle >> _32) + (carry >> _32)


@njit(cache=True)
def _normal(word):
    """The normal of a word's top 53 bits, centred in their cell: q = p - 1/2 is exact, and so is the tail's probability."""
    q = (float(np.int64(word >> _11) - (1 << 52)) + 0.5) * 2.0**-53
    size = abs(q)
    if size <= 0.425:
        return q * _ratio(_A, _B, 0.180625 - q * q)
    r = math.sqrt(-math.log(0.5 - size))
    z = _ratio(_C, _D, r - 1.6) if r <= 5.0 else _ratio(_E, _F, r - 5.0)
    return -z if q < 0.0 else z


@njit(cache=True)
def _ratio(a, b, x):
    """Numerator over denominator, both by Horner's rule."""
    numerator, denominator = a[7], b[7]
    for i in range(6, -1, -1):
        numerator = numerator * x + a[i]
        denominator = denominator * x + b[i]
    return numerator / denominator
