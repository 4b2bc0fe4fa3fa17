"""The exact likelihood of a residual: white noise, a random walk, Gauss-Markov processes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numba import njit

from pyimu.identification.fit.whiten import LEAST_VARIANCE
from pyimu.identification.noise.laws import Form, Kind
from pyimu.identification.noise.rows import Rows

DIFFUSE = 1e8
"""Variance of the bias before the first sample, in variances of a sample."""


@njit(cache=True)
def filtered(r, steps, white, walk, variances, times, diffuse):
    """Log-likelihood (n,) of each residual given those before it.

    The first state is bias and walk together, the others are the processes, stationary at first.
    """
    n, m = len(r), len(variances) + 1
    mean, cov = np.zeros(m), np.zeros((m, m))
    cov[0, 0] = diffuse
    for a in range(1, m):
        cov[a, a] = variances[a - 1]
    kept, out, sums = np.ones(m), np.zeros(n), np.zeros(m)
    last = -1.0
    for k in range(n):
        if k > 0:
            if steps[k] != last:
                last = steps[k]
                for a in range(1, m):
                    kept[a] = np.exp(-last / times[a - 1])
            cov[0, 0] += walk * last
            for a in range(1, m):
                mean[a] *= kept[a]
            if m > 1:
                for a in range(m):
                    for b in range(m):
                        cov[a, b] *= kept[a] * kept[b]
                for a in range(1, m):
                    cov[a, a] += variances[a - 1] * (1.0 - kept[a] ** 2)
        f, seen = white[k], 0.0
        for a in range(m):
            total = 0.0
            for b in range(m):
                total += cov[a, b]
            sums[a] = total
            f += total
            seen += mean[a]
        v = r[k] - seen
        out[k] = -0.5 * (np.log(f) + v * v / f)
        for a in range(m):
            mean[a] += sums[a] / f * v
            for b in range(m):
                cov[a, b] -= sums[a] * sums[b] / f
    return out


@dataclass(frozen=True)
class AxisNoise:
    """The noise of one axis: by kind its size squared and its form."""

    sizes: Mapping[Kind, tuple[float, Form]]
    white: float = 0.0
    """Variance of a sample that is white beside that of the kinds."""

    def variance(self, rows: Rows) -> np.ndarray:
        """That of the white noise of each row (n,)."""
        out = np.full(len(rows.r), max(self.white, LEAST_VARIANCE))
        for kind, (square, form) in self.sizes.items():
            if kind.follows:
                out = out + square * kind.in_rows(rows)
            else:
                law, given = kind.effect.law, {kind.parameter: np.sqrt(square), **form}
                density = float(law.value("white", given, h=rows.h) or 0.0)
                # The differences of a rounded integral: white is as near as one number comes.
                out += density / rows.h
                out += 2 * (float(law.value("rounding", given) or 0.0) / rows.h) ** 2
        return out

    def likelihood(self, rows: Rows) -> np.ndarray:
        """Log-likelihood (n,) [nat, constant left out] of each row given those before it; zero for
        the first, which shows the bias.
        """
        walk, pairs = 0.0, []
        for kind, (square, form) in self.sizes.items():
            if kind.follows:
                continue
            law, given = kind.effect.law, {kind.parameter: np.sqrt(square), **form}
            walk += float(law.value("walk", given) or 0.0)
            pairs += [tuple(map(float, p)) for p in law.value("markov", given) or ()]
        pairs, white = [p for p in pairs if p[0] > 0.0], self.variance(rows)
        variances, times = np.array(pairs).reshape(-1, 2).T.copy()
        if rows.averaged:
            # The variance of a mean; from mean to mean the process is nearly what it was.
            z = rows.h / times
            variances = variances * 2.0 * (z + np.expm1(-z)) / z**2
        diffuse = DIFFUSE * (float(np.mean(white)) + float(variances.sum()))
        return _first_left_out(
            filtered(rows.r - rows.r[0], rows.steps, white, walk, variances, times, diffuse)
        )


def _first_left_out(values: np.ndarray) -> np.ndarray:
    values[:1] = 0.0
    return values
