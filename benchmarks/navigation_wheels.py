"""Whether the position is honest beside a measured speed, and yaw beside positions with the
vehicle's constraint: ``python benchmarks/navigation_wheels.py [runs] [first seed] [CASE...]``.

Robots that drive squares and slaloms, and cars with stops, by equations of their own: wheels of a
scale that is off by 1 to 3 %, that slip in bursts where they speed up and drift sideways in turns,
encoders that count ticks, a sensor that is mounted askew, beside the point that does not slip, and
shaken. Printed are, case by case, the median error of position and yaw at the end, and the mean
normalised squares of both (1 is right: that of the position is of one axis).
"""

import sys
from dataclasses import dataclass

import numpy as np
from scipy.signal import lfilter
from scipy.spatial.transform import Rotation

from pyimu import Recording
from pyimu.ins import run
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.model.tolerance import Tolerance

H = 0.01
NOISE = {"gyro": 1.5e-3, "accel": 0.02}
OFF = (("turn_on_bias", "b0", 0.01, 0.15), ("scale_factor", "s", 0.01, 0.01))
PART = Part(
    "robot",
    1 / H,
    *(
        Sensor(
            kind,
            {
                "angle_random_walk": {"N": np.full(3, noise * np.sqrt(H))},
                "rate_random_walk": {"K": np.full(3, walk)},
            },
        )
        for (kind, noise), walk in zip(NOISE.items(), (3e-5, 1e-4), strict=True)
    ),
    tolerances=tuple(
        Tolerance((kind, effect, name), (of[i],) * 3, "normal")
        for effect, name, *of in OFF
        for i, kind in enumerate(NOISE)
    )
    + tuple(Tolerance((kind, "misalignment", "m"), (0.005,) * 6, "normal") for kind in NOISE),
)
"""What is known of the sensors."""

RUNS = 20
G = 9.80665


@dataclass(frozen=True)
class Kind:
    """A vehicle: its rows per measured speed, the tick of its encoder in m, how far the sensor is
    from the point that does not slip (m, standard deviation along and across), how long in s a
    push to the side moves it (``drift``: lateral speed over lateral acceleration), its shaking, and
    the angle in rad by which it ``crabs`` for some 10 s.
    """

    every: int
    tick: float
    arm: tuple
    drift: float
    shaken: float
    crabs: float


ROBOT = Kind(5, 0.002, (0.03, 0.02), 0.003, 0.3, 0.005)
CAR = Kind(10, 0.02, (0.3, 0.1), 0.02, 0.3, 0.015)


def smooth(values, seconds):
    """Steps as ramps that last so long."""
    n = max(3, round(seconds / H))
    window = np.hanning(n + 2)[1:-1]
    window /= window.sum()
    padded = np.concatenate([np.full(n, values[0]), values, np.full(n, values[-1])])
    return np.convolve(padded, window, "same")[n:-n]


def steps(*parts):
    """Speed and turn rate (n,) of pairs of s, m/s and rad/s."""
    return tuple(
        np.concatenate([np.full(round(p[0] / H), float(p[i])) for p in parts]) for i in (1, 2)
    )


def square(rng):
    side, speed = rng.uniform(1.5, 2.5), rng.uniform(0.25, 0.4)
    rate = np.radians(rng.uniform(35, 55)) * rng.choice([-1, 1])
    turn = np.pi / 2 / abs(rate)
    leg = [(side / speed, speed, 0), (2.5, 0, 0), (turn, 0, rate), (2.5, 0, 0)]
    v, w = steps((8, 0, 0), *leg * 4)
    return smooth(v, 0.6), smooth(w, 0.6), ROBOT


def slalom(rng):
    v, w = steps((8, 0, 0), *[(20, rng.uniform(0.4, 0.7), 0), (3, 0, 0)] * 4)
    v = smooth(v, 1.0)
    period, most = rng.uniform(5, 9), rng.uniform(0.5, 0.9)
    w = (
        most
        * np.sin(2 * np.pi * np.arange(len(v)) * H / period)
        * (v / v.max())
        * rng.choice([-1, 1])
    )
    return v, w, ROBOT


def car(rng):
    parts = [(10, 0, 0)]
    for _ in range(5):
        speed, rate = rng.uniform(5, 10), rng.uniform(0.2, 0.35) * rng.choice([-1, 1])
        parts += [(8, speed, 0), (np.pi / 2 / abs(rate), speed / 1.5, rate), (8, speed, 0)]
        parts += [(4, 0, 0)]
    v, w = steps(*parts)
    return smooth(v, 4.0), smooth(w, 2.0), CAR


DRIVES = {"square": square, "slalom": slalom, "car": car}


def crabbed(rng, n, kind):
    """The angle (n,) rad by which the body crabs, on a camber or in the wind."""
    kept = np.exp(-H / 10)
    new = np.sqrt(1 - kept**2) * rng.normal(0, 1, n)
    new[0] = rng.normal()
    return kind.crabs * lfilter([1], [1, -kept], new)


def truth(drive, rng):
    """Times, course (n,), speed along and across (n,), turn rate, place (n, 2), and the kind."""
    v, w, kind = DRIVES[drive](rng)
    n = len(v)
    course = np.concatenate([[0.0], np.cumsum((w[1:] + w[:-1]) / 2 * H)])
    sideways = -rng.normal(0, 1) * kind.drift * smooth(v * w, 0.2) + v * crabbed(rng, n, kind)
    c, s = np.cos(course), np.sin(course)
    velocity = np.column_stack([c * v - s * sideways, s * v + c * sideways])
    place = np.zeros((n, 2))
    place[1:] = np.cumsum((velocity[1:] + velocity[:-1]) / 2 * H, axis=0)
    return np.arange(n) * H, course, v, w, velocity, place, kind


def measured_speed(rng, v, kind, scale):
    """What the encoder makes of the speed: with a scale factor, bursts of slip while it speeds up,
    and whole ticks.
    """
    slip = np.zeros(len(v))
    faster = np.flatnonzero(np.gradient(v, H) > 0.3 * np.gradient(v, H).max())
    for start in faster[:: max(1, len(faster) // 6)]:
        slip[start : start + round(rng.uniform(0.2, 0.5) / H)] = rng.uniform(0.02, 0.15)
    wheel = np.cumsum(v * (1 + scale) * (1 + slip)) * H
    counts = np.floor(wheel / kind.tick + rng.uniform())
    speed, rows = np.full(len(v), np.nan), np.arange(kind.every, len(v), kind.every)
    speed[rows] = np.diff(counts[:: kind.every])[: len(rows)] * kind.tick / (kind.every * H)
    return speed


def logged(drive, seed, rtk=False, ordinary=True):
    """A log, and the true yaw (n,) and position (n, 2) of its sensor."""
    rng = np.random.default_rng(seed)
    time, course, v, w, velocity, place, kind = truth(drive, rng)
    n, mounted = len(time), rng.normal(0, 0.015)
    yaw = course + mounted
    c, s = np.cos(course), np.sin(course)
    # the sensor is beside the point that does not slip
    arm = rng.normal(0, 1, 2) * kind.arm
    sensor = place + np.column_stack([c * arm[0] - s * arm[1], s * arm[0] + c * arm[1]])
    origin = sensor[0]
    moves = velocity + w[:, None] * np.column_stack(
        [-s * arm[0] - c * arm[1], c * arm[0] - s * arm[1]]
    )
    pushed = np.gradient(moves, H, axis=0)
    cy, sy = np.cos(yaw), np.sin(yaw)
    moving = smooth((v > 0.02) | (abs(w) > 0.02), 0.1)[:, None]
    force = np.column_stack(
        [cy * pushed[:, 0] + sy * pushed[:, 1], cy * pushed[:, 1] - sy * pushed[:, 0]]
    )
    leans = Rotation.from_rotvec([*rng.normal(0, 0.015, 2), 0.0])
    force = leans.apply(np.column_stack([force, np.full(n, G)]))
    rate = leans.apply(np.column_stack([np.zeros((n, 2)), w]))
    gains = [
        np.eye(3)
        + np.diag(rng.normal(0, 0.01, 3))
        + 0.005 * rng.normal(0, 1, (3, 3)) * (1 - np.eye(3))
        for _ in "ga"
    ]
    gyro = rate @ gains[0].T + rng.normal(0, 0.01, 3) + rng.normal(0, 1.5e-3, (n, 3))
    gyro += np.cumsum(rng.normal(0, 3e-5 * np.sqrt(H), (n, 3)), axis=0)
    accel = force @ gains[1].T + rng.normal(0, 0.15, 3) + rng.normal(0, 0.02, (n, 3))
    # what shakes comes back: it is the change of a velocity, and of an angle
    accel += (
        kind.shaken / np.sqrt(2) * np.diff(moving * rng.normal(0, 1, (n, 3)), axis=0, prepend=0)
    )
    gyro += 0.02 / np.sqrt(2) * np.diff(moving * rng.normal(0, 1, (n, 3)), axis=0, prepend=0)
    columns = {"time": time, "gyro": gyro, "accel": accel}
    speed = measured_speed(rng, v, kind, rng.uniform(0.01, 0.03) * rng.choice([-1, 1]))
    if rtk:
        off = 0.02 * rng.normal(0, 1, (n, 2))
        at = np.arange(n) % 20 == 0
        for i, axis in enumerate(("east", "north")):
            columns[f"position_{axis}"] = np.where(at, sensor[:, i] + off[:, i], np.nan)
        columns["position_std"] = np.full(n, 0.02)
        origin = origin + off[0]  # the first position is the origin
    else:
        columns["speed"] = speed
        columns["speed_std"] = np.full(n, kind.tick / (kind.every * H) / np.sqrt(6))
    return Recording.from_arrays(**columns), yaw, sensor - origin


CASES = {
    f"{drive}, {how}": (drive, how)
    for how in ("speed", "speed, nhc", "rtk, nhc", "rtk")
    for drive in DRIVES
}


def made(name, seed):
    """Error of position in m and yaw in deg at the end, and both squared over their variance."""
    drive, how = CASES[name]
    rtk = how.startswith("rtk")
    log, yaw, place = logged(drive, seed, rtk)
    known = {} if rtk and drive == "car" else {"heading0": yaw[0]}
    settings = {"top_speed": 20.0} if drive == "car" else {}
    found = run(log, PART, method="filter", nhc="nhc" in how, settings=settings, **known)
    track = found.tracks["filter"]
    rows = np.linspace(0.3, 1, 8) * (len(yaw) - 1)
    out = []
    for row in rows.astype(int):
        off = track.position[row, :2] - place[row]
        a, b = track.position_std[row, :2]
        both = track.correlation[row] * a * b
        nees = off @ np.linalg.solve([[a * a, both], [both, b * b]], off) / 2
        turned = (track.yaw[row] - yaw[row] + np.pi) % (2 * np.pi) - np.pi
        of_yaw = (turned / track.attitude_std[row, 2]) ** 2
        out.append(
            (
                np.linalg.norm(off),
                np.degrees(turned),
                nees,
                of_yaw,
                a,
                np.degrees(track.attitude_std[row, 2]),
            )
        )
    return np.array(out), found


def main(runs, first, names):
    print(f"{runs} runs{'':14}  end, m  claims  yaw deg  claims    NEES     yaw   speed")
    for name in names or CASES:
        rows, nis = [], []
        for seed in range(first, first + runs):
            row, found = made(name, seed)
            rows.append(row)
            nis.append(found.mean_nis("speed_nis") or np.nan)
        rows = np.array(rows)
        end = rows[:, -1]
        figures = (
            *(np.median(end[:, 0]), np.median(end[:, 4])),
            *(np.sqrt(np.mean(end[:, 1] ** 2)), np.sqrt(np.mean(end[:, 5] ** 2))),
            *(np.mean(rows[:, :, 2]), np.mean(rows[:, :, 3])),
            np.mean(nis),
        )
        print(f"{name:20}" + "".join(f"{v:9.3g}" for v in figures), flush=True)


if __name__ == "__main__":
    arguments = sys.argv[1:]
    main(
        int(arguments[0]) if arguments else RUNS,
        int(arguments[1]) if len(arguments) > 1 else 0,
        arguments[2:],
    )
