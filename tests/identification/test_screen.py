"""Selection on normal equations made from plain random columns, so that every answer can be had by
least squares too.
"""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from loop_cases import inputs, noise, trial
from scipy.stats import betabinom, binom, chi2

from pyimu.identification.fit.fit import begin
from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.fit.maximum_likelihood import fit
from pyimu.identification.fit.normal import Normal
from pyimu.identification.search.candidates import Choice, Group
from pyimu.identification.search.projected import Projected, dispersion, scatter_of
from pyimu.identification.search.screen import (
    DRAWS,
    FALSE_ALARM,
    PENALTY,
    SHARE,
    Screened,
    Screening,
    _gains,
    _gate,
    _screened,
    fitted_dispersion,
    fitted_gain,
    screen,
)
from pyimu.identification.verdict.visibility import _of
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.sensor import Sensor
from pyimu.model.typical import magnitudes

ALARM = 1e-4
ROWS, BATCHES = 4000, 80
BASE, CANDIDATES = [0, 1, 2], [3, 4, 5, 6, 7, 8]


def design(seed: int = 1) -> np.ndarray:
    """Columns (n, 9) that are correlated with each other, of very different sizes."""
    rng = np.random.default_rng(seed)
    mixed = rng.standard_normal((ROWS, 9)) @ (np.eye(9) + 0.4 * rng.standard_normal((9, 9)))
    return mixed * 10.0 ** rng.uniform(-4, 3, 9)


def normal_of(columns: np.ndarray, y: np.ndarray) -> Normal:
    """Normal equations of white rows, in batches of equal length."""
    x, r = columns.reshape(BATCHES, -1, columns.shape[1]), y.reshape(BATCHES, -1)
    keys = [Coefficient("g_sensitivity", "G", (i // 3, i % 3)) for i in range(columns.shape[1])]
    return Normal(
        keys,
        np.einsum("bni,bnj->bij", x, x),
        np.einsum("bni,bn->bi", x, r),
        float(y @ y),
        len(y),
        0.0,
    )


def sum_of_squares(columns: np.ndarray, y: np.ndarray) -> float:
    """What least squares leaves, the columns scaled so that it is well posed."""
    scaled = columns / np.linalg.norm(columns, axis=0)
    return float(np.sum((y - scaled @ np.linalg.lstsq(scaled, y, rcond=None)[0]) ** 2))


def choices() -> list[Group]:
    """An effect of two groups, one scanned for with two values, and one with all its coefficients
    together.
    """
    keys = [
        [Coefficient(name, parameter, (i,)) for i in range(3)]
        for name, parameter in (
            ("scale_factor", "s"),
            ("saturation", "limit"),
            ("thermal_bias", "kT"),
        )
    ]
    return [
        Group("scale_factor", (keys[0][0],), (Choice((0,)),)),
        Group("scale_factor", (keys[0][1],), (Choice((1,)),)),
        Group("saturation", (keys[1][0],), (Choice((2,), 0.5), Choice((3,), 0.8))),
        Group("thermal_bias", tuple(keys[2][:2]), (Choice((4, 5)),)),
    ]


def gain_of_best(projected: Projected, groups: list[Group]) -> float:
    names = {g.effect for g in groups}
    return max(_screened(n, [g for g in groups if g.effect == n], projected).gain for n in names)


def test_noise_passes_the_gate_as_often_as_it_says():
    rng, columns, tries = np.random.default_rng(2), design(), 2000
    projected = Projected.of(normal_of(columns, np.zeros(ROWS)), BASE, CANDIDATES)
    gate = _gate(projected, choices(), np.random.default_rng(3))
    scores = np.linalg.cholesky(projected.gram) @ rng.standard_normal((len(CANDIDATES), tries))
    passed = sum(gain_of_best(with_score(projected, s), choices()) > gate for s in scores.T)
    # The gate is itself an order statistic of DRAWS draws, so that what lies above it is
    # beta-distributed.
    chance = SHARE * FALSE_ALARM
    spread = betabinom(tries, chance * (DRAWS + 1), (1 - chance) * (DRAWS + 1))
    assert spread.ppf(ALARM / 2) <= passed <= spread.ppf(1 - ALARM / 2)


def with_score(projected: Projected, score: np.ndarray) -> Projected:
    return replace(projected, score=score)


@pytest.mark.parametrize("columns", [(0,), (3,), (1, 4), (0, 1, 2, 3, 4, 5)])
def test_gain_is_half_the_drop_of_the_sum_of_squares(columns):
    x, rng = design(), np.random.default_rng(4)
    y = rng.standard_normal(ROWS) + 0.1 * x[:, 4] / np.linalg.norm(x[:, 4]) * np.sqrt(ROWS)
    projected = Projected.of(normal_of(x, y), BASE, CANDIDATES)
    found = _gains(projected.score[None], Choice(columns), projected.gram)[0]
    drop = sum_of_squares(x[:, BASE], y) - sum_of_squares(
        x[:, BASE + [CANDIDATES[c] for c in columns]], y
    )
    assert found == pytest.approx(0.5 * drop - PENALTY * len(columns), rel=1e-8, abs=1e-8)


def test_scanned_value_with_a_negative_amplitude_gains_nothing():
    projected = Projected.of(normal_of(design(), np.zeros(ROWS)), BASE, CANDIDATES)
    score = np.zeros((2, 6))
    score[:, 2] = np.array([9.0, -9.0]) * np.sqrt(projected.gram[2, 2])
    assert _gains(score, Choice((2,), 0.5), projected.gram) == pytest.approx(
        [81 / 2 - PENALTY, -PENALTY]
    )
    assert _gains(score, Choice((2,)), projected.gram) == pytest.approx([81 / 2 - PENALTY] * 2)


def test_fitted_gain_is_the_drop_when_the_coefficients_are_put_back_to_zero():
    x, rng = design(), np.random.default_rng(5)
    estimate = rng.standard_normal(9) / np.linalg.norm(x, axis=0) * 20.0
    # What least squares has left: all columns are fitted, ``estimate`` is what they were found to
    # be.
    y = rng.standard_normal(ROWS)
    y -= (x / np.linalg.norm(x, axis=0)) @ np.linalg.lstsq(
        x / np.linalg.norm(x, axis=0), y, rcond=None
    )[0]
    sensor = Sensor("gyro", {"g_sensitivity": {"G": estimate.reshape(3, 3)}})
    normal = normal_of(x, y)
    keys = [normal.keys[c] for c in (3, 4)]
    found = fitted_gain(normal, sensor, keys)
    others = [c for c in range(9) if c not in (3, 4)]
    drop = sum_of_squares(x[:, others], y + x[:, [3, 4]] @ estimate[[3, 4]]) - sum_of_squares(x, y)
    assert found == pytest.approx(
        0.5 * drop / fitted_dispersion(normal, keys) - 2 * PENALTY, rel=1e-8
    )


@pytest.mark.parametrize("ratio", [1.0, 4.0])
def test_dispersion_is_the_ratio_of_true_to_modelled_variance(ratio):
    """Batch scores about their mean: a chi-square of one degree less a batch for each column, over
    what is expected of all.
    """
    x, columns = design(), (0, 2, 3)
    band = chi2.ppf([ALARM / 20, 1 - ALARM / 20], (BATCHES - 1) * len(columns)) / (
        BATCHES * len(columns)
    )
    found = []
    for seed in range(10):
        y = np.sqrt(ratio) * np.random.default_rng(seed).standard_normal(ROWS)
        found.append(dispersion(Projected.of(normal_of(x, y), BASE, CANDIDATES), columns))
    # Batches of 50 rows differ in what they show; 10 % covers what that does to the number of
    # degrees of freedom.
    assert max(1.0, 0.9 * ratio * band[0]) <= min(found) and max(found) <= max(
        1.0, 1.1 * ratio * band[1]
    )
    assert (ratio == 1.0) == (min(found) == 1.0)


def test_dispersion_sees_batches_whose_scores_hang_together():
    """A residual that is constant in each batch, of unit variance, makes scores of a constant
    column scatter 50 times as much.
    """
    rng, length = np.random.default_rng(6), ROWS // BATCHES
    y = np.repeat(rng.standard_normal(BATCHES), length)
    x = np.column_stack([rng.standard_normal(ROWS), 1.0 + 0.01 * rng.standard_normal(ROWS)])
    found = dispersion(Projected.of(normal_of(x, y), [0], [1]), (0,))
    low, high = length * chi2.ppf([ALARM / 2, 1 - ALARM / 2], BATCHES - 1) / BATCHES
    assert 0.98 * low < found < 1.02 * high


def test_a_few_batches_do_not_decide_how_scores_scatter():
    """A column that four batches alone show, in white noise: the scatter that they show is
    chi-square on three degrees of freedom, above 2 in one draw of nine; weighed against that of the
    other columns it is not.
    """
    x, alone, weighed = design(), [], []
    x[4 * ROWS // BATCHES :, CANDIDATES[0]] = 0.0
    for seed in range(200):
        y = np.random.default_rng(seed).standard_normal(ROWS)
        projected = Projected.of(normal_of(x, y), [], CANDIDATES)
        alone.append(dispersion(projected, (0,)))
        weighed.append(dispersion(projected, (0,), scatter_of(projected)))
    chance = binom(200, chi2.sf(6.0, 3))
    assert chance.ppf(ALARM) <= sum(v > 2.0 for v in alone) <= chance.isf(ALARM)
    assert sum(v > 2.0 for v in weighed) <= 3 and np.mean(weighed) < 1.1


def test_scatter_that_a_candidate_alone_has_is_its_own():
    """All batches of one column hang together; that the others' do not is no reason to doubt it."""
    rng, x = np.random.default_rng(6), design()
    x[:, CANDIDATES[0]] = 1.0 + 0.01 * rng.standard_normal(ROWS)
    y = np.repeat(rng.standard_normal(BATCHES), ROWS // BATCHES)
    projected = Projected.of(normal_of(x, y), [], [CANDIDATES[0], 4, 5])
    alone = dispersion(projected, (0,))
    assert dispersion(projected, (0,), scatter_of(projected)) > 0.8 * alone > 20.0


def test_projection_leaves_the_residual_of_least_squares():
    x, y = design(), np.random.default_rng(7).standard_normal(ROWS)
    projected = Projected.of(normal_of(x, y), BASE, CANDIDATES)
    base = x[:, BASE] / np.linalg.norm(x[:, BASE], axis=0)
    left = x[:, CANDIDATES] - base @ np.linalg.lstsq(base, x[:, CANDIDATES], rcond=None)[0]
    size = np.linalg.norm(left, axis=0)
    np.testing.assert_allclose(
        projected.gram / np.outer(size, size), (left / size).T @ (left / size), atol=1e-9
    )
    np.testing.assert_allclose(projected.score / size, left.T @ y / size, atol=1e-8)
    np.testing.assert_allclose(
        projected.batch_score.sum(axis=0) / size, projected.score / size, atol=1e-8
    )
    by_batch = projected.batch_gram(range(len(CANDIDATES)))
    np.testing.assert_allclose(
        (by_batch.sum(axis=0) - projected.gram) / np.outer(size, size), 0.0, atol=1e-9
    )
    few, powers = projected.batch_gram([3, 1]), np.einsum("bii->bi", by_batch)
    np.testing.assert_allclose(few, by_batch[:, [3, 1]][:, :, [3, 1]], rtol=1e-9)
    np.testing.assert_allclose(projected.batch_power, powers, rtol=1e-9)


def test_projection_leaves_nothing_of_what_the_base_explains():
    x = design()
    scale = np.linalg.norm(x, axis=0)
    x[:, 5] = (x[:, :3] / scale[:3]) @ [1.0, -2.0, 0.5] * scale[5]
    projected = Projected.of(
        normal_of(x, np.random.default_rng(8).standard_normal(ROWS)), BASE, CANDIDATES
    )
    assert not projected.gram[2].any() and not projected.gram[:, 2].any()
    assert (
        projected.score[2] == 0.0
        and not projected.batch_score[:, 2].any()
        and not projected.batch_gram(range(3))[:, 2].any()
        and not projected.batch_power[:, 2].any()
    )
    assert _gains(projected.score[None], Choice((2,)), projected.gram)[0] == 0.0
    assert np.all(np.delete(np.diag(projected.gram), 2) > 0)


@pytest.fixture(scope="module")
def screening() -> Screening:
    """A minute of a gyro with g-sensitivity about x, screened with nothing but its noise in the
    model.
    """
    time = 0.04 * np.arange(1500)
    rng = np.random.default_rng(9)
    u = inputs(rng, time)
    y = u[:, :3] + 1e-3 * u[:, 3:4] * [1.0, 0.0, 0.0] + noise(rng, time, 1e-5, 1e-8)
    return screen(fit(begin(Sensor("gyro", {"scale_factor": {}}), (), [trial(time, y, u)])), ())


def test_screening_puts_the_effect_that_is_there_first(screening):
    best = screening.above()[0]
    assert best.effect == "g_sensitivity"
    assert [k.index for g in best.groups for k in g.keys] == [(0, 0)]


def test_smallest_visible_coefficient_is_six_standard_errors(screening):
    """Of g-sensitivity: white noise of 1e-5 and 1500 rows of the liveliest force, freed of its
    mean, of RMS 2.
    """
    seen = next(c for c in screening.candidates if c.effect == "g_sensitivity")
    assert seen.smallest_visible == pytest.approx(6 * np.sqrt(1e-5 / 1500) / 2.0, rel=0.25)


def test_delay_and_lag_are_told_to_be_inseparable(screening):
    by_name = {c.effect: c.inseparable_from for c in screening.candidates}
    assert "lag" in by_name["time_delay"] and "time_delay" in by_name["lag"]


def test_what_rounding_excites_is_not_called_visible():
    """A slope of a temperature that stands still, by differences of equal numbers, has some 1e-15
    of the power of one that moves; a coefficient of 1e13 deg/s/(K/min) is no answer.
    """
    sensor = Sensor("gyro", {})
    size = magnitudes("temperature_rate", "gyro")["consumer"].si
    for factor, shown in ((1e4, True), (1e13, False)):
        seen = Screened("temperature_rate", 0.0, (), {}, factor * size)
        told = SimpleNamespace(
            before=SimpleNamespace(sensor=sensor), first=SimpleNamespace(candidates=[seen])
        )
        found = _of(CATALOGUE["temperature_rate"], "gyro", told)
        assert (found.smallest_visible is not None) == shown
        assert found.reason == ("" if shown else "no motion excites it")
