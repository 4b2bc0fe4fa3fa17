"""An accelerometer that stops at its range while motors shake it."""

import numpy as np

import pyimu

RATE, LIMIT, NOISE = 100.0, 12.0, 0.01
PART = f"""name = "shaken"
sample_rate = {{value = {RATE}, unit = "Hz"}}
[accel.angle_random_walk]
N = {{value = [1e-3, 1e-3, 1e-3], unit = "m/s/sqrt(s)"}}
[accel.saturation]
limit = {{value = [{LIMIT}, {LIMIT}, {LIMIT}], unit = "m/s^2"}}
"""


def test_rows_between_shakes_are_left_of_a_log_whose_shakes_are_clipped(tmp_path):
    """Level but for 1 m/s^2, under shakes of up to 8 m/s^2 that come and go, and which the
    reference does not have: by their size over the whole log every row might be clipped, and none
    would be left to examine.
    """
    rng, time = np.random.default_rng(1), np.arange(60 * RATE) / RATE
    waves = np.sin(2 * np.pi * np.array([0.31, 0.47, 0.23]) * time[:, None])
    force = waves + [0.0, 0.0, 9.8]
    size = 8.0 * np.maximum(np.sin(2 * np.pi * time / 15.0), 0.0) ** 2
    shake = (size * np.sin(2 * np.pi * 31.0 * time))[:, None] * [0.3, 0.3, 1.0]
    accel = np.clip(force + shake + NOISE * rng.standard_normal(force.shape), -LIMIT, LIMIT)
    path = tmp_path / "shaken.toml"
    path.write_text(PART)
    log = pyimu.Recording.from_arrays(
        "log", time=time, gyro=np.zeros_like(force), accel=accel, ref_force=force
    )
    found = pyimu.close(log, part=path)
    assert "accel" not in found.not_examined
    assert not [a.effect for a in found.added if a.sensor == "accel"], found.report()
