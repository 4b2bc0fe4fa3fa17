"""The examples of ``characterize``: the paper's tables, and a band that holds whole curves."""

import numpy as np
import pytest
from places import program
from scipy.stats import binom

from pyimu.model.part_file import part

ALPHA = 1e-3 / 2


@pytest.fixture(scope="module")
def thermal():
    return program("examples/imt30_thermal.py")


def test_the_tables_of_the_paper_are_those_of_the_part(thermal):
    gyro = part("imt30").gyro
    for name, effect in (
        ("kT", "thermal_bias"),
        ("N", "angle_random_walk"),
        ("K", "rate_random_walk"),
    ):
        values, unit, si, _ = thermal.PAPER[name]
        np.testing.assert_allclose(
            thermal.units.convert(values, unit, si), gyro.values[effect][name], rtol=1e-12
        )


def test_hidalgo_table_1_in_a_short_look(thermal, capsys):
    """One test of six minutes gives thermal drift and white noise of every axis.

    They are within five standard errors, and the tables are printed.
    """
    found = thermal.characterise(0.1, 1)
    for axis, drift, white in zip(
        "xyz", thermal.PAPER["kT"][0], thermal.PAPER["N"][0], strict=True
    ):
        got, N = thermal.drift(found, axis), found.coefficients[f"gyro_{axis}", "N"].mean
        assert abs(got.value - thermal.units.convert(drift, "deg/s/K", "rad/s/K")) <= 5 * got.std
        assert (
            abs(N.value - thermal.units.convert(white, "deg/sqrt(h)", "rad/sqrt(s)")) <= 5 * N.std
        )
    for name in thermal.PAPER:
        thermal.Console(width=120).print(thermal.table(found, name))
    printed = capsys.readouterr().out
    assert all(
        text in printed
        for text in ("Table 1", "Table 2", "Table 4", "0.056", "0.23858", "64.2", "deg/s/K")
    )


def test_the_simulated_band_holds_whole_curves():
    """It holds as many further rows as it says, within the binomial law.

    The band's own scatter, which is that of as many rows, is allowed for.
    """
    adis, rng = program("examples/adis16405_static.py"), np.random.default_rng(1)

    def curves(rows):
        return np.exp(np.cumsum(rng.standard_normal((rows, 8)), axis=1))

    low, high = adis.band(curves(4000), 0.95)
    further = curves(4000)
    held = np.count_nonzero(np.all((low <= further) & (further <= high), axis=1))
    half = (binom.isf(ALPHA / 2, 4000, 0.95) - 3800) * np.sqrt(2)
    # A rank is a step of at most 2 x 8 rows in so many.
    assert abs(held - 3800) <= half + 16
