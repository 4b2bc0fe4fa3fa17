"""Numbers and times as spreadsheets show them: thousands that stand apart, minutes without their
hours, serial dates.
"""

import numpy as np
import pytest
from rolling import rolls

from pyimu import inspect, read_recording
from pyimu.errors import UserError

N = 1500
TIME = 10.0 * np.arange(N)
"""ms."""

HEAD = "Time (ms),Gyro X (dps),Gyro Y (dps),Gyro Z (dps),Acc X (mg),Acc Y (mg),Acc Z (mg)"


@pytest.fixture(scope="module")
def values():
    """Rates deg/s and forces mg (n, 6) of a body that rolls, in hundredths."""
    rng = np.random.default_rng(41)
    rate, up = rolls(TIME / 1000)
    return (np.hstack([np.degrees(rate), 1000 * up]) + rng.normal(0, 3, (N, 6))).round(2)


def shown(value, mark, decimal):
    return f"{value:,.2f}".replace(",", "T").replace(".", decimal).replace("T", mark)


@pytest.mark.parametrize(
    "mark, decimal, separator, quote",
    [
        (",", ".", ",", '"'),
        (",", ".", "\t", ""),
        (" ", ",", ";", ""),
        ("\u00a0", ",", "\t", ""),
        ("\u202f", ",", ";", ""),
        (".", ",", ";", ""),
        ("'", ".", ";", ""),
        ("’", ".", ",", '"'),
    ],
)
def test_thousands_that_stand_apart(mark, decimal, separator, quote, values, tmp_path):
    rows = [HEAD.replace(",", separator)]
    for row in np.column_stack([TIME, values]).tolist():
        cells = [shown(v, mark, decimal) for v in row]
        rows.append(separator.join(f"{quote}{c}{quote}" if mark in c else c for c in cells))
    (tmp_path / "log.csv").write_text("\n".join(rows) + "\n")
    found = read_recording(tmp_path / "log.csv")
    np.testing.assert_allclose(found.time - found.time[0], TIME / 1000, atol=1e-9)
    np.testing.assert_allclose(found.accel, values[:, 3:] * 9.80665e-3, rtol=1e-12)
    assert any("thousands that stand apart" in str(f.detail) for f in found.findings)


@pytest.mark.parametrize("cell", ['"1,234"', '"1,234,567"', '"12,345.6,7"'])
def test_what_may_be_a_decimal_comma_or_several_numbers_is_no_thousand(cell, tmp_path):
    rows = [HEAD, *(f"{10 * k},0.5,0.5,0.5,0.5,0.5,{cell}" for k in range(200))]
    (tmp_path / "log.csv").write_text("\n".join(rows) + "\n")
    with pytest.raises(UserError, match=r"row 2, column Acc Z \(mg\): .* is not a number$"):
        read_recording(tmp_path / "log.csv")


def test_thousands_that_come_late_are_told_of(tmp_path):
    rows = [HEAD, *(f"{10 * k},0.5,0.5,0.5,0.5,0.5,999.5" for k in range(200))]
    rows.append('2000,0.5,0.5,0.5,0.5,0.5,"1,000.5"')
    rows += rows[-30:-1]
    (tmp_path / "log.csv").write_text("\n".join(rows) + "\n")
    with pytest.raises(UserError, match="'1,000.5' is not a number; thousands stand apart from"):
        read_recording(tmp_path / "log.csv")


def test_minutes_without_their_hours_go_over_the_hour(values, tmp_path):
    """Excel's mm:ss.0; its tenths of a second are shared by ten rows each."""
    tenths = np.arange(N) // 10 + 36000 * 5 - 700
    stamps = [f"{t // 600 % 60:02d}:{t // 10 % 60:02d}.{t % 10}" for t in tenths.tolist()]
    rows = [",".join([s, *map(str, row)]) for s, row in zip(stamps, values.tolist(), strict=True)]
    (tmp_path / "log.csv").write_text("\n".join([HEAD.replace("Time (ms)", "Time"), *rows]))
    found = read_recording(tmp_path / "log.csv")
    assert found.sample_rate == pytest.approx(100, rel=1e-3)
    assert np.ptp(found.time) == pytest.approx(TIME[-1] / 1000, abs=0.1)


def test_serial_dates_count_days(values, tmp_path):
    """45292 is 2024-01-01; of ten digits behind the point the tenth is 9 us."""
    stamps = [f"{45292.5 + t / 86.4e6:.10f}" for t in TIME.tolist()]
    rows = [",".join([s, *map(str, row)]) for s, row in zip(stamps, values.tolist(), strict=True)]
    (tmp_path / "log.csv").write_text("\n".join([HEAD.replace("Time (ms)", "Date"), *rows]))
    found = inspect(tmp_path / "log.csv")
    (why,) = (g for p in found.proposals for g in p.guesses if g.group == "time")
    assert (why.unit, why.why) == ("day", "a date of 2024, at 100 Hz")
    np.testing.assert_allclose(found.recording.time, TIME / 1000, atol=2e-5)
