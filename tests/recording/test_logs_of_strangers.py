"""Layouts that people bring, in short pieces with numbers of our own: what had been read wrong in
silence, or refused without the word that helps.
"""

import numpy as np
import pytest
from turned_logs import agrees, by_its_map, rows, turned, written

from pyimu import inspect
from pyimu.recording.guess.numbers import warmth_unit
from pyimu.recording.naming.name import named


@pytest.fixture(scope="module")
def log():
    return turned()


def test_cm_a_second_squared_without_a_unit_is_asked_about(log, tmp_path):
    """It had been taken for mg: every force 2 % too small, and "gravity is 981" in a remark."""
    head = "t_ms,ax,ay,az,gx,gy,gz"
    path = written(tmp_path / "log.csv", [head, *rows(1000 * log[0], 100 * log[2], log[1])])
    found = inspect(path)
    assert found.recording.accel is None
    assert "choose the unit of accel in the map" in found.report()
    chosen = found.column_map
    for axis in "xyz":
        assert f'# "a{axis}" = "accel_{axis} [mg]"' in chosen
        line = f'"a{axis}" = "accel_{axis} [cm/s^2]"'
        chosen = chosen.replace("# " + line, line)
    (tmp_path / "chosen.toml").write_text(chosen)
    agrees(inspect(path, tmp_path / "chosen.toml").recording, log)


def test_gal_as_geophysicists_write_it(log, tmp_path):
    head = "t [s],ax [gal],ay [gal],az [gal],gx [rad/s],gy [rad/s],gz [rad/s]"
    lines = [head, *rows(log[0], 100 * log[2], log[1])]
    agrees(by_its_map(written(tmp_path / "log.csv", lines), tmp_path), log)


@pytest.mark.parametrize(
    "cell, unit",
    [
        ("temp [F]", "degF"),
        ("Temperature (°F)", "degF"),
        ("temp_f", "degF"),
        ("MagX [mGa]", "mGa"),
        ("Mag_X_nT", "nT"),
    ],
)
def test_units_of_headers(cell, unit):
    assert named(cell).unit == unit


@pytest.mark.parametrize("middle, unit", [(77.0, None), (25.0, "degC"), (58.0, "degC"), (298, "K")])
def test_a_temperature_that_may_be_in_fahrenheit_is_asked_about(middle, unit):
    """25 degC in a room are 77 degF, which had been taken for degC."""
    assert warmth_unit(middle + 0.1 * np.sin(np.arange(300.0))).unit == unit
