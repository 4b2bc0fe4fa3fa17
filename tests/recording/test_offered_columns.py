"""What a header with units says nothing of is offered in the map, with a # before each line."""

from __future__ import annotations

import numpy as np
import pytest

from pyimu.inspection.run import inspect
from pyimu.recording.log import open_log

N, RATE = 600, 100.0
HEADS = {
    "own": [
        "time [s]",
        *(f"gyro_{a} [rad/s]" for a in "xyz"),
        *(f"accel_{a} [m/s^2]" for a in "xyz"),
    ],
    "stated": [
        "time(s)",
        *(f"gyro_{a}(rad/s)" for a in "xyz"),
        *(f"accel_{a}(m/s^2)" for a in "xyz"),
    ],
}
YAW = 0.5 * np.sin(0.5 * np.arange(N) / RATE)
ZERO = np.zeros(N)
MORE = {
    "qw,qx,qy,qz": ([np.cos(YAW / 2), ZERO, ZERO, np.sin(YAW / 2)], "ref_q", "ref_q_w [1]"),
    "roll,pitch,yaw": ([ZERO, ZERO, np.degrees(YAW)], "ref_q", "ref_yaw [deg]"),
    "lat,lon": ([52 + 1e-5 * YAW, 13 + ZERO], "ref_north", "ref_latitude [deg]"),
    "gt_qw,gt_qx,gt_qy,gt_qz": (
        [np.cos(YAW / 2), ZERO, ZERO, np.sin(YAW / 2)],
        "ref_q",
        "ref_q_z [1]",
    ),
}


def written(folder, head, more):
    draw = np.random.default_rng(2)
    gyro = 2e-3 * draw.normal(size=(N, 3))
    accel = 0.02 * draw.normal(size=(N, 3)) + [0.0, 0.0, 9.81]
    table = np.column_stack([np.arange(N) / RATE, gyro, accel, *MORE[more][0]])
    path = folder / "log.csv"
    header = ",".join([*HEADS[head], more])
    np.savetxt(path, table, fmt="%.9g", delimiter=",", header=header, comments="")
    return path


@pytest.mark.parametrize("head", HEADS)
@pytest.mark.parametrize("more", MORE)
def test_lines_that_are_uncommented_read_the_columns(more, head, tmp_path):
    path = written(tmp_path, head, more)
    found = inspect(path)
    _, group, line = MORE[more]
    assert found.recording is not None and group not in found.recording.groups
    assert f"{more.replace(',', ', ')} are left out" in found.report()
    assert f'= "{line}"' in found.column_map
    wanted = [cell for cell in more.split(",")]
    lines = [
        text.removeprefix("# ")
        if any(text.startswith(f'# "{c}" = "ref_') for c in wanted)
        else text
        for text in found.column_map.splitlines()
    ]
    (tmp_path / "map.toml").write_text("\n".join(lines))
    assert group in open_log(path, tmp_path / "map.toml").read().groups
    # As it was written the map reads what the header says.
    found.write_map(tmp_path / "as_written.toml")
    assert group not in open_log(path, tmp_path / "as_written.toml").read().groups


def test_nothing_is_offered_where_nothing_is_left(tmp_path):
    path = written(tmp_path, "own", "qw,qx,qy,qz")
    rows = [line.split(",")[:7] for line in path.read_text().splitlines()]
    path.write_text("\n".join(",".join(row) for row in rows))
    found = inspect(path)
    assert "left out" not in found.report() and "left out" not in found.column_map
