"""The files that the commands of README and docs name: short ones, under their names there."""

import gzip
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
from raw_logs import repoimu
from walks import walk

from pyimu.recording.recording import Recording
from pyimu.rover.indoor_runs import Assumptions, one_run
from pyimu.rover.trajectory import Drive, motion

Maker = Callable[[Path], object]

ROWS = 2000

PART = """\
name = "mine"
sample_rate = {value = 100.0, unit = "Hz"}

[gyro.angle_random_walk]
N = {value = 0.3, unit = "deg/sqrt(h)"}

[accel.angle_random_walk]
N = {value = 0.001, unit = "m/s/sqrt(s)"}

[tolerance.gyro.turn_on_bias]
b0 = {value = 1.0, unit = "deg/s", distribution = "uniform"}
"""

EFFECTS = """\
import casadi as ca

from pyimu import Environment, Parameter, effect


@effect(stage="bias", term="rate-magnitude drift", equation=r"y = x + k |w|", source="a test")
def shown_in_the_docs(x, k: Parameter("{y}/(rad/s)"), w: Environment("rate")):
    return x + k * ca.sqrt(ca.sumsqr(w) + 1e-12)
"""

ANGLES = """\
[columns]
t = "time [s]"
roll = "ref_roll [deg]"
pitch = "ref_pitch [deg]"
yaw = "ref_yaw [deg]"
"""

CALIBRATION = """\
bias = {value = [0.0, 0.0, 0.0], unit = "uT"}
matrix = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
"""


def still(rows: int = ROWS, seed: int = 3, rate: float = 100.0) -> Recording:
    """A log at rest: white noise of gyro and accelerometer."""
    rng = np.random.default_rng(seed)
    gyro, force = 2e-3 * rng.standard_normal((rows, 3)), 0.01 * rng.standard_normal((rows, 3))
    return Recording.from_arrays(
        time=np.arange(rows) / rate, gyro=gyro, accel=force + [0.0, 0.0, 9.80665]
    )


def walked() -> Recording:
    """A log of a sensor on a foot."""
    own, rng = walk(0, seconds=20.0), np.random.default_rng(0)
    return Recording.from_arrays(
        time=own.time,
        gyro=own.rate + 2e-3 * rng.standard_normal(own.rate.shape),
        accel=own.force + 0.02 * rng.standard_normal(own.force.shape),
    )


def driven(rows: int = ROWS, seed: int = 3, reference: bool = True) -> Recording:
    """A log that turns about its vertical between two rests, with a scale factor and a field."""
    log, time = still(rows, seed), 0.01 * np.arange(rows)
    yaw, rate = turned(time)
    field = np.column_stack([20e-6 * np.cos(yaw), -20e-6 * np.sin(yaw), np.full(rows, -40e-6)])
    more = {"ref_rate": rate} if reference else {}
    return Recording.from_arrays(
        time=time, gyro=log.gyro + 1.03 * rate, accel=log.accel, mag=field, **more
    )


def turned(time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Yaw (n,) rad and rate (n, 3) rad/s of turns, one about each 4 s, between two rests of 4 s."""
    begin, end = 4.0, time[-1] - 4.0
    turns = max(1, round((end - begin) / 4.0))
    phase = turns * 2 * np.pi * (np.clip(time, begin, end) - begin) / (end - begin)
    speed = turns * 2 * np.pi / (end - begin)
    yaw = 0.6 * (phase - np.sin(phase))
    rate = np.zeros((len(time), 3))
    rate[:, 2] = 0.6 * (1 - np.cos(phase)) * speed
    return yaw, rate


def attitudes(path: Path) -> None:
    """The attitude of ``driven``, as cameras have it: a file of its own."""
    log = driven()
    half = turned(log.time)[0] / 2
    q = np.column_stack([np.cos(half), 0 * half, 0 * half, np.sin(half)])
    Recording.from_arrays(time=log.time, ref_q=q).write(path)


def nclt(path: Path) -> None:
    """``driven`` in the layout of NCLT, forward-right-down, with its truth."""
    log = driven()
    stamps = 1326030975726043 + np.round(1e6 * log.time)
    if path.name == "ms25.csv":
        down = [v * [1.0, -1.0, -1.0] for v in (1e4 * log.mag, log.accel, log.gyro)]
        table(path, np.column_stack([stamps, *down]))
    else:
        yaw = np.pi / 2 - turned(log.time)[0]
        table(path, np.column_stack([stamps, *np.zeros((5, len(yaw))), yaw]))


def angles(path: Path) -> None:
    """The attitude of ``driven`` as roll, pitch and yaw in degrees."""
    log = driven()
    yaw = np.degrees(turned(log.time)[0])
    table(path, np.column_stack([log.time, 0 * yaw, 0 * yaw, yaw]), "t,roll,pitch,yaw")


def table(path: Path, rows: np.ndarray, head: str = "") -> None:
    np.savetxt(path, rows, fmt="%.17g", delimiter=",", header=head, comments="")
    if not head:
        path.write_text(path.read_text().lstrip("\n"))


def from_repoimu(path: Path) -> None:
    """A log in the layout of RepoIMU, under another name."""
    log = driven()
    made = repoimu(path.parent, (np.round(log.time * 1e9).astype(int), log.gyro, log.accel))
    path.write_bytes(gzip.compress(made.read_bytes()))


def square() -> Recording:
    """A robot that drives two sides of a square, with the truth beside it."""
    truth = motion(Drive(legs=2, stops=2.0, first_rest=5.0, vibration=0.3), 50.0)
    noise = np.random.default_rng(4).standard_normal((2, len(truth.time), 3))
    gyro, accel = truth.ref_rate + 2e-3 * noise[0], truth.ref_force + 0.02 * noise[1]
    return replace(truth, gyro=gyro, accel=accel)


def upside_down() -> Recording:
    """The same by a sensor whose y and z axes are the other way round."""
    log, turned = square(), [1.0, -1.0, -1.0]
    return Recording.from_arrays(time=log.time, gyro=log.gyro * turned, accel=log.accel * turned)


def known_motion(number: int) -> Recording:
    return one_run(number, Assumptions()).known


def indoors(number: int) -> Recording:
    """A start-up motion and the drive behind it."""
    one = one_run(number, Assumptions())
    gyro = np.concatenate([one.known.gyro[:-1, 2], one.log.gyro[:, 2]])
    return one.motion.recording(gyro, name=f"run{number}")


def written(make: Callable[..., Recording], *arguments) -> Maker:
    return lambda path: make(*arguments).write(path)


def text(content: str) -> Maker:
    return lambda path: path.write_text(content)


FILES: dict[str, Maker] = {
    "log.csv": written(still),
    "static.csv": written(still),
    **{f"run{k}.csv": written(still, ROWS, k) for k in (1, 2, 3)},
    "drive.csv": written(driven),
    "table.csv": written(driven),
    **{
        f"{name}.csv": written(driven, ROWS, k)
        for k, name in enumerate(("first", "second", "third"))
    },
    "mocap.csv": attitudes,
    "ms25.csv": nclt,
    "groundtruth_2012-01-08.csv": nclt,
    "angles.csv": angles,
    "angles.toml": text(ANGLES),
    "square.csv": written(square),
    "walk.csv": written(walked),
    "tstick07.csv.gz": from_repoimu,
    "broad11.csv.gz": written(driven),
    "morpinet_rccar_n.csv.gz": written(upside_down),
    "frd.toml": text('[frame]\nbody = "frd"\n'),
    "model.toml": text(PART),
    "mypart.toml": text(PART),
    "my_gyro.toml": text(PART),
    "my_effects.py": text(EFFECTS),
    "magnetometer.toml": text(CALIBRATION),
    "robot.csv": written(indoors, 0),
    "start_up.csv": written(known_motion, 0),
}
"""What makes a file, by its name."""

OF_A_PAGE: dict[str, dict[str, Maker]] = {
    "docs/heading.md": {f"run{k}.csv": written(indoors, k) for k in (1, 2)},
}
"""Pages that mean something else by a name."""
