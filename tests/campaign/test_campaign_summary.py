"""What a campaign's runs say together: intervals that cover, indices that are right."""

import numpy as np
import pyarrow as pa
import pytest
from scipy.stats import binom, chi2

from pyimu.rover.campaign.report.words import lines
from pyimu.rover.campaign.score import ANGLES, FREEDOM
from pyimu.rover.campaign.sensitivity import LEVEL, chance, indices
from pyimu.rover.campaign.summary import CLAIM, Share, Summary, explained, quantile

pytest.importorskip("SALib", reason="the indices are SALib's")


def table(runs=400, **more):
    """A campaign's table with errors of one degree, one parameter that makes them, and no fault."""
    rng = np.random.default_rng(1)
    cause = rng.normal(size=runs)
    columns = {"run": np.arange(runs), "fault": ["none"] * runs, "status": np.zeros(runs, int)}
    columns |= {"steps": np.full(runs, 10), "terrain": rng.integers(0, 3, runs)}
    columns["gyro_error.scale_factor.s[3] [1]"] = cause
    for name in ANGLES:
        for kind in ("max", "rms", "end"):
            columns[f"{name}_error_{kind} [rad]"] = np.deg2rad(1 + 0.1 * cause)
    for name, freedom in FREEDOM.items():
        for kind in ("end", "mean"):
            columns[f"nees_{name}_{kind} [1]"] = rng.chisquare(freedom, runs)
    return pa.table(columns | more)


@pytest.mark.parametrize("p", [0.5, 0.95])
def test_the_interval_of_a_quantile_covers_it(p):
    """Of 2,000 samples as many as ``LEVEL`` says or more, as an interval between samples does."""
    rng, n, covered = np.random.default_rng(3), 200, 0
    for _ in range(2000):
        q = quantile(np.sort(rng.exponential(size=n)), p)
        covered += q.low <= -np.log(1 - p) <= q.high or not np.isfinite(q.high)
    assert covered > binom.ppf(1e-4, 2000, LEVEL)


def test_a_quantile_beyond_the_runs_has_no_upper_end():
    assert np.isnan(quantile(np.arange(50.0), 0.99).high)


def test_clopper_and_pearson_1934_interval():
    """Its ends are those at which so few, or so many, have a probability of 2.5 %."""
    low, high = Share(7, 40).interval
    assert binom.sf(6, 40, low) == pytest.approx(0.025, rel=1e-9)
    assert binom.cdf(7, 40, high) == pytest.approx(0.025, rel=1e-9)


def test_first_order_indices_of_a_known_function():
    """y = 3 a + b^2 + noise, of normals: variances 9, 2 and 1, all together 12.

    The scatter of an index of n runs is about 2/sqrt(n) of it, and ``chance`` of one that is zero.
    """
    rng, n = np.random.default_rng(5), 4000
    a, b, c, noise = rng.normal(size=(4, n))
    found = {i.factor: i for i in indices({"a": a, "b": b, "c": c}, 3 * a + b**2 + noise)}
    assert list(found) == ["a", "b", "c"]
    for name, want in (("a", 9 / 12), ("b", 2 / 12), ("c", 0.0)):
        # Ten harmonics see 97 % of the square, and all of the rest.
        assert found[name].value == pytest.approx(want, abs=2 / np.sqrt(n))
    assert found["c"].value < chance(n, 3) < found["b"].low


def test_what_chance_makes_of_a_parameter_without_effect():
    """The largest of five indices exceeds ``chance`` in a share of 1 - ``LEVEL``, not in more."""
    rng, n, beyond = np.random.default_rng(7), 300, 0
    from SALib.analyze import rbd_fast

    for _ in range(300):
        x, y = rng.normal(size=(n, 5)), rng.normal(size=n)
        values = [
            rbd_fast.unskew_S1(
                rbd_fast.compute_first_order(rbd_fast.permute_outputs(x[:, i], y), 10), 10, n
            )
            for i in range(5)
        ]
        beyond += max(values) > chance(n, 5)
    assert beyond < binom.isf(1e-4, 300, 1 - LEVEL)


def test_many_parameters_without_effect_explain_nothing():
    """An index of n runs is off by 2 sqrt(10)/n, the sum of 40 of them by sqrt(40) times that.

    Those above zero alone would add up to 40/sqrt(2 pi) of that, a quarter of the variance.
    """
    rng, n = np.random.default_rng(9), 400
    found = indices({f"x{i}": rng.normal(size=n) for i in range(40)}, rng.normal(size=n))
    assert explained(found) < 4 * np.sqrt(40) * 2 * np.sqrt(10) / n < 0.42
    assert sum(max(0.0, i.value) for i in found) > explained(found)


def test_the_cause_of_an_error_is_named():
    s = Summary(table())
    said = next(line for line in lines(s) if "drives the largest heading" in line)
    assert "gyro_error.scale_factor.s[3]" in said and "terrain" not in said


def test_the_mean_of_an_honest_filter_is_within_its_bounds():
    honesty = Summary(table()).honesty("bias")
    assert honesty.bounds[0] < honesty.mean < honesty.bounds[1]
    # A sum of 400 chi-squares of 3 degrees of freedom is one of 1200.
    assert honesty.bounds[0] == pytest.approx(chi2.ppf(0.025, 1200) / 400)


def test_runs_with_a_fault_are_kept_apart():
    names = ["none", "stuck"] * 200
    error = np.where(np.array(names) == "none", 0.01, 1.0)
    s = Summary(table(fault=names, **{"heading_error_max [rad]": error, "status": [0, 4] * 200}))
    assert s.quantiles("heading_error_max [rad]")[-1].value == 0.01
    assert s.quantiles("heading_error_max [rad]", "stuck")[0].value == 1.0
    assert s.within("max") == Share(200, 200)
    assert s.flags("stuck")["stuck"].value == 1.0 and not s.flags("none")


def test_a_claim_holds_where_all_three_angles_do():
    error = np.zeros(400)
    error[:13] = 1.01 * CLAIM
    s = Summary(
        table(
            **{f"{name}_error_end [rad]": np.zeros(400) for name in ANGLES}
            | {"pitch_error_end [rad]": -error}
        )
    )
    assert s.within("end").count == 387
