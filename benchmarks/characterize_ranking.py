"""How often the right model of the noise is chosen, and how far the model is off at long times.

``python benchmarks/characterize_ranking.py [logs]`` simulates logs of each of some kinds of noise.
It prints how often each set of terms was taken, how often a Gauss-Markov term that is not there,
and the ratio of the fitted deviation to the true one at the longest cluster time that fits four
times into the log (median, and the 95 % quantile of its size either way): as it is, and for the
terms that are needed by their own law without a comparison of models ("before").
"""

import sys
import time
from collections import Counter

import numpy as np
from characterize_coverage import LEVEL, SAMPLES, H, simulated
from scipy.signal import lfilter

from pyimu.characterization.allan import octave_clusters, overlapping_deviation
from pyimu.characterization.allan.moments import TERMS, design
from pyimu.characterization.noise.candidates import choose
from pyimu.characterization.noise.fit import fit_noise

SEED = 528

KINDS = {
    "white": {"N": 1.0},
    "white and walk": {"N": 1.0, "K": 0.6},
    "white and flicker": {"N": 1.0, "B": 0.8},
    "white, flicker and walk": {"N": 1.0, "B": 0.6, "K": 0.25},
    "white and drift of 20 s": {"N": 1.0, "G": (0.8, 20.0)},
    "white, flicker and drift of 40 s": {"N": 1.0, "B": 0.6, "G": (1.2, 40.0)},
}
"""Coefficients in units of samples, s; a drift is Gauss-Markov noise of a standard deviation and a
correlation time, of 328 s."""


def main(logs: int = 100) -> None:
    started = time.perf_counter()
    for name, true in KINDS.items():
        rng = np.random.default_rng(SEED)
        made = [noise(rng, **true) for _ in range(logs)]
        found = [fit(x) for x in made]
        taken = Counter("".join(f.estimates) for f in found)
        print(flush=True)
        print(f"{name}: {', '.join(f'{t} {n}' for t, n in taken.most_common(5))}")
        if "G" not in true:
            false = sum("G" in f.estimates for f in found)
            print(f"  Gauss-Markov noise that is not there: {false} of {logs}")
        for label, ratios in (
            ("before", [before(x) / truth(true) for x in made]),
            ("now", [float(f.deviation(np.array([LONGEST]))[0]) / truth(true) for f in found]),
        ):
            size = np.abs(np.log(ratios))
            print(
                f"  {label:6} at {LONGEST:.0f} s: {np.median(ratios):.2f} times the truth, "
                f"{np.exp(np.quantile(size, 0.95)):.2f} either way in 95 %"
            )
    print(f"\n{time.perf_counter() - started:.0f} s")


CLUSTERS = octave_clusters(SAMPLES)
LONGEST = float(CLUSTERS[CLUSTERS <= SAMPLES // 4][-1] * H)


def fit(x: np.ndarray):
    return fit_noise(CLUSTERS, overlapping_deviation(x, CLUSTERS), [len(x)], H, LEVEL)


def before(x: np.ndarray) -> float:
    """Deviation at the longest cluster time of the terms that are needed by their own law."""
    measured = overlapping_deviation(x, CLUSTERS) ** 2
    problem = (found := choose(CLUSTERS, measured, [len(x)], ())).problem
    squares = problem.fit(problem.needed(found.terms))
    return float(np.sqrt(design(np.array([LONGEST / H])) @ squares)[0])


def truth(true: dict) -> float:
    """The true Allan deviation at the longest cluster time."""
    markov = (true["G"][1] / H,) if "G" in true else ()
    squares = [true.get(t, 0.0) ** 2 * H**p for t, p in zip(TERMS, (-2, -1, 0, 1, 2), strict=True)]
    squares += [true["G"][0] ** 2] if markov else []
    return float(np.sqrt(design(np.array([LONGEST / H]), markov) @ squares)[0])


def noise(rng: np.random.Generator, G: tuple[float, float] | None = None, **true: float):
    """A record (n,) with Gauss-Markov noise (standard deviation, correlation time in s)."""
    x = simulated(rng, **true)
    if G is None:
        return x
    a, draws = np.exp(-H / G[1]), rng.standard_normal(SAMPLES)
    draws[1:] *= np.sqrt(1 - a**2)
    return x + G[0] * lfilter([1.0], [1.0, -a], draws)


if __name__ == "__main__":
    main(*(int(a) for a in sys.argv[1:]))
