"""A body that is turned and shaken, and what is read of tables with its numbers."""

import numpy as np
from rolling import rolls
from scipy.spatial.transform import Rotation

from pyimu import inspect, read_recording
from pyimu.units import STANDARD_GRAVITY

N, H = 2000, 0.01
G = STANDARD_GRAVITY


def turned():
    """Times s, gyro rad/s and accelerometer m/s^2 (n, 3) of a body that is turned and shaken."""
    rng = np.random.default_rng(11)
    time = H * np.arange(N)
    gyro, up = rolls(time)
    noise = rng.standard_normal((2, N, 3))
    shaken = np.outer(0.3 * np.sin(7 * time), [1, 0, 0])
    return time, gyro + 1e-3 * noise[0], G * up + shaken + 0.02 * noise[1]


def tumbled():
    """The same of a body that rolls, pitches and yaws, so that no axis of the gyro stands still."""
    rng = np.random.default_rng(12)
    time = H * np.arange(N)
    step = H / 16
    fine = step * np.arange(16 * N)
    phase = 2 * np.pi * np.outer(fine, [0.31, 0.23, 0.17]) + [0, 1, 2]
    rate = np.sin(phase) * [1.6, 1.1, 0.9]
    attitude, up = Rotation.identity(), np.empty((N, 3))
    for k, turns in enumerate(Rotation.from_rotvec(rate * step).as_matrix().reshape(N, 16, 3, 3)):
        up[k] = attitude.inv().apply([0.0, 0.0, 1.0])
        attitude = attitude * Rotation.from_matrix(np.linalg.multi_dot(list(turns)))
    noise = rng.standard_normal((2, N, 3))
    return time, rate[::16] + 1e-3 * noise[0], G * up + 0.02 * noise[1]


def rows(*columns, by=",", form="{:.9g}"):
    """A line for each sample; texts stay as they are."""
    each = [c for column in columns for c in (np.atleast_2d(np.asarray(column).T))]
    said = [[v if isinstance(v, str) else form.format(v) for v in column] for column in each]
    return [by.join(cells) for cells in zip(*said, strict=True)]


def written(path, lines, code="utf-8"):
    path.write_bytes("\n".join([*lines, ""]).encode(code))
    return path


def by_its_map(path, tmp_path, rate=None):
    """The log by the map that inspect writes, with the rate of one without times."""
    found = inspect(path)
    text = found.column_map
    if rate is not None:
        text = text.replace("# sample_rate = {value = 100", f"sample_rate = {{value = {rate}")
    (tmp_path / "map.toml").write_text(text)
    return read_recording(path, tmp_path / "map.toml")


def agrees(found, log, gyro=1e-6, accel=1e-5):
    """To the rounding of the numbers in the file."""
    np.testing.assert_allclose(np.diff(found.time), np.diff(log[0]), rtol=0, atol=1e-6)
    np.testing.assert_allclose(found.gyro, log[1], rtol=0, atol=gyro)
    np.testing.assert_allclose(found.accel, log[2], rtol=0, atol=accel)
