"""Standard normals as a function of (seed, channel, sample) only.

They are the ones that ``fmu_src/noise.c`` draws.

The words are those of Philox4x64-10 (Salmon, Moraes, Dror, Shaw, "Parallel random numbers: as easy
as 1, 2, 3", SC11, 2011) with key (seed, channel): sample k takes word k of
``numpy.random.Philox(key=[seed, channel])``. A word becomes a normal through a ziggurat
(Marsaglia, Tsang, "The ziggurat method for generating random variables", Journal of Statistical
Software 5(8), 2000) of 256 layers; what a refused word needs comes from counters (sample, attempt,
0, 0), which are no other sample's. Every operation is the one of the C, in its order, so the bits
are the same.

``python -m pyimu.block.normals`` prints the table of the C.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from decimal import Decimal, localcontext

import numpy as np
from llvmlite import ir
from numba import njit, types
from numba.extending import intrinsic

LAYERS = 256

_BASE = Decimal("3.65415288536100877164542972039")
"""Where the tail begins: the one abscissa for which the highest layer ends at the top of the bell.
"""

_ATTEMPTS = 64
_U = np.uint64
_MULTIPLIER_0, _MULTIPLIER_1 = _U(0xD2E7470EE14C6C93), _U(0xCA5A826395121157)
_WEYL_0, _WEYL_1 = _U(0x9E3779B97F4A7C15), _U(0xBB67AE8584CAA73B)
_LAYER, _12, _10, _3, _2, _1, _0 = _U(LAYERS - 1), _U(12), _U(10), _U(3), _U(2), _U(1), _U(0)


def normals(seed: int, channels: Sequence[int], first_sample: int, n: int) -> np.ndarray:
    """Standard normals (n, len(channels)) of samples ``first_sample`` to ``first_sample + n - 1``.

    The first sample that an FMU started at time zero makes is number 1. Raises ValueError for a
    seed or a channel outside 0 to 2^64 - 1 and for a negative ``n``.
    """
    for what, value in [("seed", seed)] + [("channel", c) for c in channels]:
        if not 0 <= int(value) < 2**64:
            raise ValueError(f"{what} {value} is not in 0 to 2^64 - 1")
    if n < 0:
        raise ValueError(f"n = {n} is negative")
    out = np.empty((n, len(channels)))
    _fill(
        _U(int(seed)),
        np.array([int(c) for c in channels], dtype=np.uint64),
        _U(int(first_sample) % 2**64),
        out,
    )
    return out


# The layers


def edges() -> np.ndarray:
    """The ziggurat's abscissas (257,) for f(x) = exp(-x^2 / 2), from the widest to zero.

    Each is the nearest double.

    Every layer has the area of the lowest, v = x_1 f(x_1) + int_x_1^inf f, so f(x_i+1) = f(x_i) + v
    / x_i, and the lowest counts as a rectangle of width x_0 = v / f(x_1) (Marsaglia and Tsang 2000,
    section 2).
    """
    with localcontext(prec=30):
        height = (-_BASE * _BASE / 2).exp()
        area = height * (_BASE + _mills_ratio(_BASE))
        x = [area / height, _BASE]
        while len(x) < LAYERS:
            height += area / x[-1]
            x.append((-2 * height.ln()).sqrt())
    return np.array([*x, 0], dtype=float)


def _mills_ratio(x: Decimal) -> Decimal:
    """int_x^inf f / f(x) = 1 / (x + 1 / (x + 2 / (x + 3 / ...))), by Laplace.

    The continued fraction is Abramowitz and Stegun 26.2.14.
    """
    denominator = x
    for k in range(200, 0, -1):
        denominator = x + k / denominator
    return 1 / denominator


def c_table() -> str:
    """The edges as ``fmu_src/noise.c`` holds them."""
    numbers = [x.hex() for x in edges().tolist()]
    return ",\n".join("    " + ", ".join(numbers[i : i + 4]) for i in range(0, len(numbers), 4))


_EDGE = edges()
"""Compiled in as a constant: passed as an argument, it made a draw take three times as long."""


# Words


@njit(cache=True)
def _fill(seed, channels, first, out):
    """Fill ``out`` four words at a time over all channels.

    So memory is written once and in its order.
    """
    n = len(out)
    for row in range(-np.int64(first & _3), n, 4):
        sample = first + _U(row)
        for c in range(len(channels)):
            words = _philox(seed, channels[c], (sample >> _2) + _1, _0)
            for i in range(4):
                if 0 <= row + i < n:
                    out[row + i, c] = _normal(seed, channels[c], sample + _U(i), words[i])


@njit(cache=True, forceinline=True)  # in line, several blocks are under way at once
def _philox(key_0, key_1, counter_0, counter_1):
    """The four words of Philox4x64-10 for counter (counter_0, counter_1, 0, 0)."""
    x0, x1, x2, x3 = counter_0, counter_1, _0, _0
    for _ in range(10):
        high_0, low_0 = _high_product(_MULTIPLIER_0, x0), _MULTIPLIER_0 * x0
        high_1, low_1 = _high_product(_MULTIPLIER_1, x2), _MULTIPLIER_1 * x2
        x0, x1, x2, x3 = high_1 ^ x1 ^ key_0, low_1, high_0 ^ x3 ^ key_1, low_0
        key_0 += _WEYL_0
        key_1 += _WEYL_1
    return x0, x1, x2, x3


@intrinsic
def _high_product(_, a, b):
    """The upper 64 of the 128 bits of a product.

    It is one instruction, which numba's own integers cannot ask for.
    """

    def generate(context, builder, signature, arguments):
        wide = ir.IntType(128)
        product = builder.mul(*(builder.zext(x, wide) for x in arguments))
        return builder.trunc(builder.lshr(product, wide(64)), ir.IntType(64))

    return types.uint64(types.uint64, types.uint64), generate


# The normal of a word


@njit(cache=True)
def _normal(seed, channel, sample, word):
    x = _abscissa(word)
    return x if _inside(x, word) else _beyond_the_edge(seed, channel, sample, word)


@njit(cache=True)
def _abscissa(word):
    """The top 54 bits, made odd, as a point in (-1, 1) times the width of the word's layer.

    The lowest 8 bits choose the layer.
    """
    return float(np.int64((word >> _10) | _1) - (1 << 53)) * 2.0**-53 * _EDGE[word & _LAYER]


@njit(cache=True)
def _inside(x, word):
    return abs(x) < _EDGE[(word & _LAYER) + _1]


@njit(cache=True)
def _beyond_the_edge(seed, channel, sample, word):
    """The normal of a word outside its layer's rectangle.

    Each attempt is refused with a chance below 0.07, so the bound is met with one below 1e-72; x is
    then as it is.
    """
    x = _abscissa(word)
    for attempt in range(1, _ATTEMPTS):
        fresh = _philox(seed, channel, sample, _U(attempt))
        if word & _LAYER == _0:  # once in the tail always in the tail, or it would be too thin
            size = _from_tail(fresh)
            if size > 0.0:
                return math.copysign(size, x)
            continue
        if _under_bell(x, word & _LAYER, fresh[0]):
            return x
        word = fresh[1]
        x = _abscissa(word)
        if _inside(x, word):
            return x
    return x


@njit(cache=True)
def _from_tail(words):
    """A normal from the tail, 0 where the words are refused.

    The method is that of Marsaglia, Technometrics 6, 1964 (Marsaglia and Tsang 2000).
    """
    beyond = -math.log(_uniform(words[0])) / _EDGE[1]
    return _EDGE[1] + beyond if -2.0 * math.log(_uniform(words[1])) > beyond * beyond else 0.0


@njit(cache=True)
def _under_bell(x, i, word):
    floor = _bell(_EDGE[i])
    return _uniform(word) * (_bell(_EDGE[i + _1]) - floor) < _bell(x) - floor


@njit(cache=True)
def _bell(x):
    return math.exp(-0.5 * x * x)


@njit(cache=True)
def _uniform(word):
    """The middle of one of 2^52 equal cells of (0, 1): exact, and never either end."""
    return (float(word >> _12) + 0.5) * 2.0**-52


if __name__ == "__main__":
    print(c_table())
