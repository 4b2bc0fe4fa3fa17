"""The one-sided density: Welch's estimate, its levels, and the law of its averages."""

import tracemalloc

import numpy as np
import pytest
from scipy.signal import welch
from scipy.stats import binom, chi2

from pyimu.characterization.spectrum.psd import (
    LONGEST,
    SpectrumAccumulator,
    accumulate,
    psd_one_sided,
    window_length,
)

FALSE_ALARM = 1e-3
"""Of each test here, with a right estimator."""

H = 0.01


def white(seed: int, n: int, columns: int = 1) -> np.ndarray:
    return np.random.default_rng(seed).standard_normal((n, columns))


def walk(seed: int, n: int) -> np.ndarray:
    return np.cumsum(white(seed, n), axis=0)


def same(a, b, rtol: float = 1e-12) -> None:
    np.testing.assert_allclose(a.frequency, b.frequency, rtol=1e-15)
    np.testing.assert_allclose(a.density, b.density, rtol=rtol)
    np.testing.assert_allclose(a.averages, b.averages, rtol=1e-15)


def test_the_highest_level_is_scipys_welch():
    """To rounding, from the second bin on.

    Through Hann's window a constant taken off a segment reaches none of these.
    """
    x = walk(1, 50_000) + 7.0
    level = accumulate(x, H).levels()[0]
    f, want = welch(x[:, 0], 1 / H, nperseg=level.length, detrend=False)
    np.testing.assert_allclose(np.arange(len(f)) * level.resolution, f, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(level.density[2:-1, 0], want[2:-1], rtol=1e-9)


def test_power_of_a_sine_is_half_its_square():
    """A^2 / 2 in the few bins of the line."""
    n, amplitude = 2**16, 3.0
    level = accumulate(amplitude * np.sin(2 * np.pi * 17.3 * H * np.arange(n)), H).levels()[0]
    assert level.density[2:].sum() * level.resolution == pytest.approx(amplitude**2 / 2, rel=1e-6)


def theory(kind: str, f: np.ndarray) -> np.ndarray:
    """One-sided: samples of unit variance, and their running sum."""
    return 2 * H / (1 if kind == "white" else 4 * np.sin(np.pi * f * H) ** 2)


@pytest.mark.parametrize("kind", ["white", "walk"])
def test_density_on_all_levels_is_that_of_theory(kind):
    """Each group is a chi-square of its averages.

    Above bin 16 Hann's window adds at most 1 / 16^2 to the density of a walk, a group's width 1 %.
    """
    n = 2**19
    got = psd_one_sided((white if kind == "white" else walk)(2, n), H)
    slowest = 1 / (window_length(n) * H * 4 ** (len(accumulate(np.zeros(n), H).levels()) - 1))
    use = got.frequency > 16 * slowest
    ratio = got.density[use, 0] / theory(kind, got.frequency[use])
    assert got.frequency[0] < 0.01 and got.frequency[-1] > 45
    freedom, side = 2 * got.averages[use], FALSE_ALARM / 2 / use.sum()
    bias = 0.0 if kind == "white" else 0.014
    assert np.all(ratio > chi2.ppf(side, freedom) / freedom)
    assert np.all(ratio < chi2.isf(side, freedom) / freedom * (1 + bias))


def test_intervals_of_the_density_cover():
    """95 % of them, at frequencies that are independent: one group in five, on every level."""
    held, trials = 0, 0
    for seed in range(120):
        got = psd_one_sided(white(100 + seed, 20_000), H)
        low, high = got.interval(0.95)
        inside = ((low <= 2 * H) & (high >= 2 * H))[::5, 0]
        held, trials = held + inside.sum(), trials + len(inside)
    assert (
        binom.ppf(FALSE_ALARM / 2, trials, 0.95) <= held <= binom.isf(FALSE_ALARM / 2, trials, 0.95)
    )


def test_a_line_near_nyquist_does_not_fold_into_the_levels_below():
    """The filter stops 120 dB: what remains of a line of power A^2 / 2 is at most 1e-12 of it."""
    n = 2**19
    quiet = white(3, n)
    loud = quiet + 1e4 * np.sin(2 * np.pi * 42.7 * H * np.arange(n))[:, None]
    below = psd_one_sided(quiet, H).frequency < 3.0
    a, b = (psd_one_sided(x, H).density[below, 0] for x in (quiet, loud))
    assert np.sum(below) > 20
    # Sums of the two transforms: at most 2 sqrt(noise x leak) beyond the leak, which a bin of the
    # lowest level holds all of.
    leak = 1e-12 * 0.5e8 * 2**14 * 16 * H
    assert np.all(np.abs(b - a) < leak + 2 * np.sqrt(leak * a))


@pytest.mark.parametrize("piece", [1, 999, 65_536])
def test_pieces_make_no_difference(piece):
    x = walk(4, 70_000 if piece > 1 else 5_000) * [[1.0, -2.0]]
    spectrum = SpectrumAccumulator(H, 256)
    for a in range(0, len(x), piece):
        spectrum.add(x[a : a + piece])
    whole = SpectrumAccumulator(H, 256)
    whole.add(x)
    same(spectrum.result(), whole.result(), rtol=1e-9)


def test_a_look_in_between_changes_nothing():
    x, looked, whole = white(5, 30_000), SpectrumAccumulator(H, 1024), SpectrumAccumulator(H, 1024)
    for part in np.split(x, 3):
        looked.add(part)
        looked.result()
    whole.add(x)
    same(looked.result(), whole.result())


def test_segments_are_never_bridged():
    """Two halves with a step of a thousand between them are as good as without it.

    A missing row is a gap.
    """
    x = white(6, 40_000, 2)
    step = np.where(np.arange(len(x)) < 20_000, 0.0, 1e3)[:, None]
    want = psd_one_sided(x, H, [(0, 20_000), (20_001, 40_000)])
    same(psd_one_sided(x + step, H, [(0, 20_000), (20_001, 40_000)]), want, rtol=1e-6)
    holed, spectrum = x + step, SpectrumAccumulator(H, window_length(20_000))
    holed[20_000, 1] = np.nan
    spectrum.add(holed)
    same(spectrum.result(), want, rtol=1e-6)
    assert psd_one_sided(x + step, H).density[0, 0] > 10 * want.density[0, 0], "the step would show"


def test_memory_does_not_grow_with_the_record():
    spectrum, peaks = SpectrumAccumulator(H, 4096), []
    piece = white(7, 100_000, 2)
    tracemalloc.start()
    for _ in range(2):
        for _ in range(8):
            spectrum.add(piece)
        peaks.append(tracemalloc.get_traced_memory()[1])
    tracemalloc.stop()
    # Another level or two at the most, of a quarter of the one before.
    assert peaks[1] < peaks[0] * 1.1


def test_too_short_records_have_no_density():
    got = psd_one_sided(np.zeros((100, 3)), H)
    assert (
        got.frequency.shape == (0,)
        and got.density.shape == (0, 3)
        and got.interval()[0].shape == (0, 3)
    )
    assert window_length(100) == 256 and window_length(10**8) == LONGEST


def test_what_is_asked_wrongly_is_refused():
    with pytest.raises(ValueError, match="power of two"):
        SpectrumAccumulator(H, 1000)
    spectrum = SpectrumAccumulator(H)
    spectrum.add(np.zeros((3, 2)))
    with pytest.raises(ValueError, match="3 columns after 2"):
        spectrum.add(np.zeros((3, 3)))
