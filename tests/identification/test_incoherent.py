"""Transforms of many signals, a few frames after another: against all of them at once."""

import tracemalloc

import numpy as np
import pytest
from scipy.fft import next_fast_len
from scipy.signal.windows import hann

from pyimu.identification.fit.columns import Linear
from pyimu.identification.fit.incoherent import TOGETHER, _frames, _inverse, _means

LENGTH, INTERVAL = 64, 0.01
BEYOND, SENSORS, KNOWN = 2, 3, 5


def signals(rows: int) -> list[np.ndarray]:
    rng = np.random.default_rng(5)
    return list(rng.standard_normal((KNOWN + 3 * BEYOND, rows)))


def test_means_are_those_over_all_frames_at_once():
    every = signals(5_000)
    starts = list(range(0, 5_000 - LENGTH, LENGTH // 2))
    assert len(starts) % TOGETHER
    found = _means(every, starts, LENGTH, INTERVAL, (BEYOND, SENSORS, KNOWN))
    pieces = np.array([[v[s : s + LENGTH] for v in every] for s in starts])
    window = hann(LENGTH, sym=False)
    window *= np.sqrt(2 * INTERVAL / np.sum(window**2))
    z = np.fft.rfft((pieces - pieces.mean(axis=-1, keepdims=True)) * window)
    beyond, known, whole, left = np.split(z, np.cumsum([BEYOND, KNOWN, BEYOND]), axis=1)

    def mean(a: np.ndarray, b: np.ndarray) -> np.ndarray:
        return np.einsum("nif,njf->fij", a.conj(), b) / len(starts)

    same = {"rtol": 1e-10, "atol": 1e-15}
    np.testing.assert_allclose(found.gram, mean(known, known), **same)
    np.testing.assert_allclose(found.by, mean(known, beyond), **same)
    np.testing.assert_allclose(found.power, np.mean(np.abs(beyond) ** 2, axis=0).T, **same)
    np.testing.assert_allclose(found.whole, np.mean(np.abs(whole) ** 2, axis=0).T, **same)
    np.testing.assert_allclose(found.left, left.transpose(2, 1, 0), **same)
    np.testing.assert_allclose(found.own, known[:, :SENSORS].transpose(2, 1, 0), **same)


def test_frames_have_no_large_prime_in_their_length():
    """Of 2 x 4093 rows a transform takes several times longer than of a few less."""
    count, rows = 30, 30 * 2 * 4093
    one = Linear(np.arange(rows), [(0, rows)], np.zeros((rows, 3)), {}, {})
    length, starts = _frames(one, np.zeros(rows, dtype=bool), count)
    assert 0.95 * 2 * 4093 < length <= 2 * 4093
    assert next_fast_len(length // 2) == length // 2
    assert np.unique(np.diff(starts)).tolist() == [length // 2]
    assert len(starts) >= 2 * count - 1


def test_transforms_of_all_signals_are_never_held_at_once():
    every = signals(60_000)
    starts = list(range(0, 60_000 - LENGTH, LENGTH // 2))
    tracemalloc.start()
    _means(every, starts, LENGTH, INTERVAL, (BEYOND, SENSORS, KNOWN))
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    # Of frames that overlap by half a transform is twice as large as its signal; five are kept.
    kept = 2 * (BEYOND + SENSORS) * every[0].nbytes
    assert peak < 1.5 * kept < 2 * len(every) * every[0].nbytes


@pytest.mark.parametrize("alike", [False, True])
def test_inverse_leaves_out_what_is_rounding(alike):
    rng = np.random.default_rng(6)
    z = rng.standard_normal((7, 4, 30)) + 1j * rng.standard_normal((7, 4, 30))
    z[:, 1] *= 1e6
    if alike:
        z[3, 2] = z[3, 0] + z[3, 1]
    matrices = z.conj() @ z.transpose(0, 2, 1)
    found = _inverse(matrices)
    size = np.sqrt(np.diagonal(matrices, axis1=1, axis2=2).real)
    scale = size[:, :, None] * size[:, None, :]
    expected = np.linalg.pinv(matrices / scale, rcond=1e-12, hermitian=True)
    np.testing.assert_allclose(found * scale, expected, rtol=1e-8, atol=1e-8)
