"""Time and memory of the overlapping Allan deviation, against allantools.

It is made of 14 million samples at 100 cluster sizes, by allantools' ``oadev`` on the same data.
``python benchmarks/allan_speed.py [samples]``; needs allantools, which the package itself does not.
"""

import resource
import subprocess
import sys
import time
from statistics import median

import numpy as np

from pyimu.characterization.allan import log_clusters, overlapping_deviation
from pyimu.characterization.allan.deviation import processors

SAMPLES = 14_000_000
RUNS = 5


def main(samples: int = SAMPLES) -> None:
    try:
        import allantools
    except ImportError:
        print("allantools, the peer, is not installed: pip install allantools")
        return
    # First: a child process starts from its parent's largest resident size.
    memory = peak_above_the_data(samples)
    rates, m = data(samples), log_clusters(samples)
    # Compiled (or read from the cache of compiled code) before the clock starts, as the peer's code
    # is.
    overlapping_deviation(rates[:1000], [1])
    ours, (got, *_) = timed(lambda: overlapping_deviation(rates, m), RUNS)
    peer, ((taus, theirs, _, _), *_) = timed(
        lambda: allantools.oadev(rates, rate=1.0, data_type="freq", taus=m.astype(float)), 1
    )
    worst = np.abs(got[np.searchsorted(m, np.rint(taus))] / theirs - 1).max()
    print(
        f"{samples} samples, {len(m)} cluster sizes, {processors()} processors: {ours:.3f} s "
        f"(median of {RUNS}), "
        f"allantools {peer:.2f} s: {peer / ours:.1f} times faster; largest relative difference "
        f"{worst:.1e}"
    )
    print(f"peak memory above the data: {memory:.2f} of the data ({rates.nbytes / 2**20:.0f} MiB)")


def data(samples: int) -> np.ndarray:
    """White noise and a random walk that cross at a thousand samples."""
    rng = np.random.default_rng(1)
    rates = rng.standard_normal(samples)
    walk = rng.standard_normal(samples)
    rates += 1e-3 * np.cumsum(walk, out=walk)
    return rates


def timed(work, runs: int) -> tuple[float, list]:
    seconds, results = [], []
    for _ in range(runs):
        start = time.perf_counter()
        results.append(work())
        seconds.append(time.perf_counter() - start)
    return median(seconds), results


def peak_above_the_data(samples: int) -> float:
    """Growth of a fresh process' largest resident size over the call, as a share of the data.

    All code has run before.
    """
    run = subprocess.run(
        [sys.executable, __file__, "--peak", str(samples)],
        check=True,
        capture_output=True,
        text=True,
    )
    return float(run.stdout)


def peak(samples: int) -> None:
    # Made in place, so that nothing larger than the data has been resident before.
    rates = np.random.default_rng(1).standard_normal(samples)
    overlapping_deviation(rates[:100_000], log_clusters(100_000))
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    overlapping_deviation(rates, log_clusters(samples))
    unit = 1 if sys.platform == "darwin" else 1024
    print((resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) * unit / rates.nbytes)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--peak"]:
        peak(int(sys.argv[2]))
    else:
        main(*(int(a) for a in sys.argv[1:]))
