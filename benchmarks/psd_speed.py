"""Time and memory of the one-sided density of 14 million samples, against ``scipy.signal.welch``.

``python benchmarks/psd_speed.py [samples]``. Data and windows are the same. Ours takes the record
in pieces, and gives the densities of its slower levels besides scipy's; scipy's is timed as it is
called by default, and without subtracting a mean from each window, which is faster.
"""

import resource
import subprocess
import sys
import time
from statistics import median

import numpy as np
from scipy.signal import welch

from pyimu.characterization.spectrum.lines import find_lines
from pyimu.characterization.spectrum.psd import SpectrumAccumulator

SAMPLES = 14_000_000
H = 1 / 976
LENGTHS = (1024, 16384)
PIECE = 1_000_000
RUNS = 5


def main(samples: int = SAMPLES) -> None:
    # First: a child process starts from its parent's largest resident size.
    print(
        "peak memory beside a piece of a million samples: "
        + ", ".join(
            f"{n / 1e6:g} million samples {peak(n):.1f} MiB" for n in (samples // 4, samples)
        )
    )
    x = np.random.default_rng(1).standard_normal(samples)
    ours(x[:1_000_000], LENGTHS[0])
    for length in LENGTHS:
        compare(x, length)
    spectrum = ours(x, LENGTHS[-1])
    print(
        f"search for lines: {timed(lambda: find_lines(spectrum)):.2f} s, "
        f"{len(find_lines(spectrum))} found in white noise"
    )


def compare(x: np.ndarray, length: int) -> None:
    # By turns, so that whatever else the machine does falls on all alike.
    seconds = np.array(
        [
            [
                timed(lambda: ours(x, length)),
                timed(lambda: welch(x, 1 / H, nperseg=length, detrend=False)),
                timed(lambda: welch(x, 1 / H, nperseg=length)),
            ]
            for _ in range(RUNS)
        ]
    )
    own, bare, default = (median(column) for column in seconds.T)
    got = ours(x, length).levels()[0].density[2:-1, 0]
    want = welch(x, 1 / H, nperseg=length, detrend=False)[1][2:-1]
    print(
        f"{len(x)} samples, windows of {length}: {own:.3f} s (median of {RUNS}), scipy {bare:.3f} "
        f"s without detrending ({bare / own:.2f} times "
        f"ours), {default:.3f} s by default ({default / own:.2f}); largest relative difference "
        f"{np.abs(got / want - 1).max():.1e}"
    )


def ours(x: np.ndarray, length: int) -> SpectrumAccumulator:
    spectrum = SpectrumAccumulator(H, length)
    for a in range(0, len(x), PIECE):
        spectrum.add(x[a : a + PIECE])
    spectrum.result()
    return spectrum


def timed(work) -> float:
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def peak(samples: int) -> float:
    """MiB by which a fresh process' largest resident size grows while it takes that many samples.

    It takes them a piece at a time.
    """
    run = subprocess.run(
        [sys.executable, __file__, "--peak", str(samples)],
        check=True,
        capture_output=True,
        text=True,
    )
    return float(run.stdout)


def print_peak(samples: int) -> None:
    piece = np.random.default_rng(1).standard_normal(PIECE)
    # What is compiled and imported on the way.
    ours(piece[:1000], 256)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    spectrum = SpectrumAccumulator(H, LENGTHS[-1])
    for _ in range(samples // PIECE):
        spectrum.add(piece)
    spectrum.result()
    print((resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--peak"]:
        print_peak(int(sys.argv[2]))
    else:
        main(*map(int, sys.argv[1:]))
