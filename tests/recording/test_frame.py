"""A data frame is a recording: the same units, checks and findings as of a file."""

import numpy as np
import pandas as pd
import pytest

from pyimu import characterize
from pyimu.errors import UserError
from pyimu.identification.close import close
from pyimu.recording.log import read_recording, recording_of


def frame(n=50, **more) -> pd.DataFrame:
    rng = np.random.default_rng(0)
    columns = {"time [ms]": 10 * np.arange(n)}
    columns |= {f"gyro_{a} [deg/s]": rng.standard_normal(n) for a in "xyz"}
    return pd.DataFrame(columns | more, index=np.arange(n) + 7)


def test_a_frame_is_what_its_file_would_be(tmp_path):
    given = frame()
    given.loc[10, "gyro_y [deg/s]"] = np.nan
    given.to_csv(tmp_path / "log.csv", index=False)
    want, found = read_recording(tmp_path / "log.csv"), recording_of(given)
    np.testing.assert_array_equal(found.time, want.time)
    np.testing.assert_array_equal(found.gyro, want.gyro)
    assert found.findings == want.findings and [f.kind for f in found.findings] == ["missing_cells"]
    assert found.path is None and found.name == "frame"


def test_missing_values_of_any_kind_are_missing():
    given = frame()
    given["gyro_x [deg/s]"] = given["gyro_x [deg/s]"].astype("Float64")
    given.iloc[3, 1] = pd.NA
    found = recording_of(given)
    np.testing.assert_array_equal(np.flatnonzero(np.isnan(found.gyro[:, 0])), [3])


def test_a_recording_and_a_path_are_themselves(tmp_path):
    recording = recording_of(frame())
    assert recording_of(recording) is recording
    path = recording.write(tmp_path / "log.parquet")
    np.testing.assert_array_equal(recording_of(path).gyro, recording.gyro)


@pytest.mark.parametrize(
    ("given", "says"),
    [
        (frame().rename(columns={"gyro_x [deg/s]": "gyro_x"}), "frame: column gyro_x has no unit"),
        (frame(**{"accel_x [g]": "much"}), "frame: column accel_y is missing"),
        (frame(**{f"accel_{a} [g]": "much" for a in "xyz"}), "column accel_x [g] holds "),
        (frame().iloc[::-1], "frame: row 1 from 0: the time runs backwards"),
        (frame(2), "frame: a recording needs at least 3 rows of data, this one has 2"),
        (np.zeros((5, 3)), "a ndarray is no recording"),
        (None, "a NoneType is no recording"),
    ],
    ids=lambda v: v.partition(":")[0] if isinstance(v, str) else "",
)
def test_what_is_no_recording_is_refused_with_its_reason(given, says):
    with pytest.raises(UserError) as caught:
        recording_of(given)
    assert says in str(caught.value)


def test_characterize_and_close_take_a_frame():
    given = frame(2000)
    want = characterize(recording_of(given)).report()
    assert characterize(given).report() == want == characterize([given]).report()
    with pytest.raises(UserError, match="frame: too short"):
        close(frame(40))
