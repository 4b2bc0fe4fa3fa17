"""The coherence of a sensor with its reference, against scipy's, and what it takes of memory."""

import tracemalloc

import numpy as np
from scipy import signal

from pyimu.recording.reference.band import FRAMES, coherence

RATE = 100.0


def motion(rows: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    rng = np.random.default_rng(3)
    x = np.cumsum(rng.standard_normal((rows, 1)), axis=0)
    return np.arange(rows) / RATE, x + rng.standard_normal((rows, 1)), x


def test_bendat_7_coherence_of_one_input_is_scipys():
    time, y, x = motion(40_000)
    length = round(FRAMES[0] * RATE)
    frequency, share = coherence(time, y, x)
    known = {"nperseg": length, "noverlap": length - length // 2, "detrend": "constant"}
    at, expected = signal.coherence(x[:, 0], y[:, 0], fs=RATE, window=np.hanning(length), **known)
    np.testing.assert_allclose(frequency, at)
    np.testing.assert_allclose(share[1:], expected[1:], rtol=1e-9)


def test_frames_with_a_missing_sample_are_left_out():
    time, y, x = motion(8_000)
    before = coherence(time[:4_000], y[:4_000], x[:4_000])[1]
    y[4_000::50] = np.nan
    np.testing.assert_allclose(coherence(time, y, x)[1], before, rtol=1e-12)


def test_all_frames_are_never_held_at_once():
    time, y, x = motion(200_000)
    tracemalloc.start()
    coherence(time, y, x)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    # Frames overlap by half, and their transforms are as large as they: four times the samples.
    assert peak < 4 * (y.nbytes + x.nbytes)
