"""How often the 95 % intervals of the noise coefficients hold the truth.

``python benchmarks/characterize_coverage.py [logs]`` simulates a thousand logs for each of some
kinds of noise. It prints, for each kind and coefficient: how often it was needed, how often the
interval (or bound) held the truth, and the limits of the binomial law for a true 95 % at odds of a
thousand to one over the whole table. A coefficient that is not there is held by its bound; it is
false where it is said to be needed.
"""

import sys
import time

import numpy as np
from scipy.signal import fftconvolve
from scipy.stats import binom

from pyimu.characterization.allan import octave_clusters, overlapping_deviation
from pyimu.characterization.allan.moments import TERMS
from pyimu.characterization.noise.fit import fit_noise

SAMPLES, H, LEVEL, SEED = 2**15, 0.01, 0.95, 952

KINDS = {
    "white": {"N": 1.0},
    "white and walk": {"N": 1.0, "K": 0.6},
    "white and flicker": {"N": 1.0, "B": 0.8},
    "white, flicker and walk": {"N": 1.0, "B": 0.6, "K": 0.25},
    "rounded angle, white, walk": {"Q": 0.05, "N": 1.0, "K": 0.6},
}
"""Coefficients in units of samples, s; white noise and walk cross at 2.9 s, flicker shows from 1 s
on, of 328 s."""


def main(logs: int = 1000) -> None:
    started = time.perf_counter()
    counts = {name: tally(name, logs) for name in KINDS}
    alpha = 1e-3 / sum(len(TERMS) for _ in KINDS)
    low, high = binom.ppf(alpha / 2, logs, LEVEL) / logs, binom.isf(alpha / 2, logs, LEVEL) / logs
    print(
        f"{logs} logs of {SAMPLES} samples each; a true {100 * LEVEL:g} % lies from "
        f"{100 * low:.1f} to {100 * high:.1f} % here"
    )
    for name, rows in counts.items():
        print(f"\n{name}")
        for term, (needed, held, there) in rows.items():
            what = (
                f"held {100 * held / logs:5.1f} %"
                if there
                else f"bound held {100 * held / logs:5.1f} %"
            )
            print(
                f"  {term}: needed in {100 * needed / logs:5.1f} %, {what}"
                + ("" if there else "  (is not there)")
            )
    print(f"\n{time.perf_counter() - started:.0f} s")


def tally(name: str, logs: int, terms: str = TERMS) -> dict[str, tuple[int, int, bool]]:
    """What came of each coefficient: how often it was needed, how often held, and if it is there.

    The first two are numbers of logs.
    """
    rng, true = np.random.default_rng(SEED), KINDS[name]
    found = [fit(simulated(rng, **true)) for _ in range(logs)]
    return {
        t: (
            sum(f[t].needed for f in found),
            sum(f[t].holds(true.get(t, 0.0)) for f in found),
            t in true,
        )
        for t in terms
    }


def fit(x: np.ndarray):
    """The fit that ``pyimu characterize`` makes of a record without gap."""
    m = octave_clusters(len(x))
    return fit_noise(m, overlapping_deviation(x, m), [len(x)], H, LEVEL)


def simulated(
    rng: np.random.Generator,
    n: int = SAMPLES,
    Q: float = 0.0,
    N: float = 0.0,
    B: float = 0.0,
    K: float = 0.0,
) -> np.ndarray:
    """A record (n,) of a rounded angle, white noise, flicker and a random walk.

    Flicker is half an integration of white noise (Kasdin, Proc. IEEE 83 (1995), 802-827), with a
    past of four records.
    """
    x = N / np.sqrt(H) * rng.standard_normal(n)
    if K:
        x += K * np.sqrt(H) * np.cumsum(rng.standard_normal(n))
    if Q:
        x += Q / H * np.diff(rng.standard_normal(n + 1))
    if B:
        x += B * fftconvolve(rng.standard_normal(5 * n), half_integral(5 * n))[4 * n : 5 * n]
    return x


def half_integral(n: int) -> np.ndarray:
    """Impulse response (n,) of (1 - z^-1)^(-1/2)."""
    k = np.arange(1, n)
    return np.cumprod(np.append(1.0, (k - 0.5) / k))


if __name__ == "__main__":
    main(*(int(a) for a in sys.argv[1:]))
