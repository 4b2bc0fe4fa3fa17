"""Traps of what people and their programs do to a log before it is compared."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from generators import rotation

from trap_logs.log import Columns, Log, Scene, beside, new_scene


def quaternion_signs(rng) -> Log:
    """Each quaternion has the sign that it got by chance."""
    scene = new_scene(rng)
    q = scene.attitude() * rng.choice([-1.0, 1.0], (len(scene.time), 1))
    return scene.log(scene.sensed() | {"ref_q": q})


def attitude_of_three_decimals(rng) -> Log:
    """A quaternion as a table shows it."""
    scene = new_scene(rng)
    return scene.log(scene.sensed() | {"ref_q": np.round(scene.attitude(), 3)})


def rate_of_one_decimal(rng) -> Log:
    """The rate of a better unit in deg/s, as a table shows it."""
    scene = new_scene(rng)
    rate = np.radians(np.round(np.degrees(scene.motion.rate(scene.time)), 1))
    return scene.log(scene.sensed() | {"ref_rate": rate})


def frames_repeated(rng) -> Log:
    """Cameras lose one frame in fifty, and show the one before for 1 to 4 frames instead."""
    scene = new_scene(rng)
    row = np.arange(len(scene.time))
    for first in np.flatnonzero(rng.random(len(row)) < 0.02):
        row[first : first + int(rng.integers(1, 5))] = row[max(first - 1, 0)]
    return scene.log(scene.sensed() | {"ref_q": scene.attitude()[row]})


def occlusions_held(rng) -> Log:
    """As cameras lose the body for 0.3 to 2 s, some eight times, and show where it was last."""
    scene = new_scene(rng)
    row = np.arange(len(scene.time))
    for first in rng.integers(200, len(row) - 400, 8):
        row[first : first + int(rng.uniform(0.3, 2) / scene.h)] = row[first - 1]
    return scene.log(scene.sensed() | {"ref_q": scene.attitude()[row]})


def markers_swapped(rng) -> Log:
    """Three times cameras take markers for each other for 0.2 to 1.5 s: the body seems turned by 10
    to 180 deg.
    """
    scene = new_scene(rng)
    q = scene.attitude()
    for start in rng.uniform(5, scene.time[-1] - 5, 3):
        axis = rng.standard_normal(3)
        swap = rotation.from_vector(rng.uniform(0.2, np.pi) * axis / np.linalg.norm(axis))
        inside = (scene.time >= start) & (scene.time < start + rng.uniform(0.2, 1.5))
        q = np.where(inside[:, None], rotation.product(q, swap), q)
    return scene.log(scene.sensed() | {"ref_q": q}, "jumps", figures={"count": 3})


def angles_across_the_wrap(rng) -> Log:
    """Roll, pitch and yaw of 40 Hz, brought to the log's rows between two of them, as numbers: one
    row at each wrap shows an angle between +180 and -180 deg.
    """
    scene = new_scene(rng)
    node = np.arange(0, scene.time[-1] * 40 + 2) / 40
    around = rotation.from_angles(np.array([[0.0, 0.0, np.pi - _middle(scene)]]))
    angles = _angles(rotation.product(around, scene.attitude_at(node)))
    between = np.column_stack([np.interp(scene.time, node, v) for v in angles.T])
    q = rotation.from_angles(between)
    return scene.log(scene.sensed() | {"ref_q": q}, "sample_rate", figures={"rate": 40.0})


def _middle(scene: Scene) -> float:
    return float(np.median(scene.motion.angles(scene.time)[:, 2]))


def _angles(q: np.ndarray) -> np.ndarray:
    """Roll, pitch and yaw (n, 3) of quaternions, of which none goes beyond half a turn."""
    w, x, y, z = q.T
    return np.column_stack(
        [
            np.arctan2(2 * (w * x + y * z), 1 - 2 * (x**2 + y**2)),
            np.arcsin(np.clip(2 * (w * y - z * x), -1, 1)),
            np.arctan2(2 * (w * z + x * y), 1 - 2 * (y**2 + z**2)),
        ]
    )


def _pieces(rng, scene: Scene) -> list[slice]:
    """Three pieces of a log, some seconds between them left out."""
    at = np.sort(rng.uniform(0.25, 0.75, 2)) * scene.time[-1]
    at[1] = max(at[1], at[0] + 10)
    lost = rng.uniform(2, 6, 2)
    edges = [0, *np.ravel(np.column_stack([at, at + lost])), scene.time[-1]]
    rows = [round(t / scene.h) for t in edges]
    return [slice(a, b) for a, b in zip(rows[::2], rows[1::2])]


def _heading_anew(rng, q: np.ndarray) -> np.ndarray:
    """Attitudes that count their heading from where they began."""
    return rotation.product(rotation.from_vector(np.array([0.0, 0.0, rng.uniform(-3, 3)])), q)


def _in_pieces(rng, run_on: bool) -> Log:
    scene = new_scene(rng)
    columns = scene.sensed() | {"ref_q": scene.attitude()}
    pieces = [{k: v[rows] for k, v in columns.items()} for rows in _pieces(rng, scene)]
    for piece in pieces:
        piece["ref_q"] = _heading_anew(rng, piece["ref_q"])
    joined: Columns = {k: np.concatenate([p[k] for p in pieces]) for k in columns}
    if run_on:
        joined["time"] = scene.time[: len(joined["time"])]
    return scene.log(joined, "jumps" if run_on else "gaps")


def pieces_with_gaps(rng) -> Log:
    """Three logs in one file, each with a heading of its own."""
    return _in_pieces(rng, run_on=False)


def pieces_run_on(rng) -> Log:
    """As ``pieces_with_gaps``, the rows counted through."""
    return _in_pieces(rng, run_on=True)


def reference_shorter(rng) -> Log:
    """The cameras are switched on after the logger, and off before it."""
    scene = new_scene(rng)
    made = beside(scene, scene.sensed(), "nothing")
    (seen,) = made.references
    first, last = scene.time[-1] * rng.uniform(0.05, 0.2), scene.time[-1] * rng.uniform(0.8, 0.95)
    inside = (seen["time"] > first) & (seen["time"] < last)
    return replace(made, references=({k: v[inside] for k, v in seen.items()},))


def sensor_resampled(rng) -> Log:
    """Samples of 110 to 140 Hz, brought to rows of 100 Hz along straight lines."""
    scene = new_scene(rng)
    hz = float(rng.uniform(110, 140))
    own = replace(scene, hz=hz, time=np.arange(round(scene.time[-1] * hz) + 2) / hz)
    sensed = own.sensed()
    rows: Columns = {"time": scene.time, "ref_q": scene.attitude()}
    for name in ("gyro", "accel"):
        lines = [np.interp(scene.time, sensed["time"], v) for v in sensed[name].T]
        rows[name] = np.column_stack(lines)
    return scene.log(rows)


def sensor_rows_repeated(rng) -> Log:
    """Each sample stands in two rows of a log of 200 Hz."""
    scene = new_scene(rng)
    hz = 2 * scene.hz
    time = np.arange(2 * len(scene.time)) / hz
    sensed = {k: np.repeat(v, 2, axis=0) for k, v in scene.sensed().items()}
    sensed |= {"time": time, "ref_q": scene.attitude_at(time)}
    return scene.log(sensed, late=True)


TRAPS = (
    quaternion_signs,
    attitude_of_three_decimals,
    rate_of_one_decimal,
    frames_repeated,
    occlusions_held,
    markers_swapped,
    angles_across_the_wrap,
    pieces_with_gaps,
    pieces_run_on,
    reference_shorter,
    sensor_resampled,
    sensor_rows_repeated,
)
