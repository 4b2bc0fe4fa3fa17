"""A robot that drives along a polygon and stops before and after each turn, in closed form.

Each leg is straight, each turn on the spot, and every ramp the polynomial of
``pyimu.plant.manoeuvre.progress``: position, velocity, acceleration, heading and turn rate are
exact at every instant, however it is sampled.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.errors import UserError
from pyimu.recording.recording import Recording
from pyimu.symbolic.earth import EARTH_RATE
from pyimu.units import STANDARD_GRAVITY

RAMP = 0.5
"""s in which a leg or a turn reaches its speed, and in which it ends."""


@dataclass(frozen=True)
class Drive:
    """A polygon: legs of ``side`` m at ``speed`` m/s, turns of ``turn`` rad at ``turn_rate`` rad/s.

    It rests ``first_rest`` s at the start and ``stops`` s before and after each turn; without
    stops (0) legs and turns follow each other. ``legs`` is how many there are; each is followed by
    a turn. ``tilt`` is roll and pitch in rad of the body on its wheels, ``vibration`` m/s^2 the
    root mean square of what motors at ``vibration_frequency`` Hz shake it by along each axis while
    it moves, without net motion. ``latitude`` in rad; ``gravity`` m/s^2.
    """

    side: float = 2.0
    speed: float = 0.3
    turn_rate: float = math.radians(45.0)
    stops: float = 3.0
    turn: float = math.pi / 2
    legs: int = 4
    first_rest: float = 10.0
    ramp: float = RAMP
    tilt: tuple[float, float] = (0.0, 0.0)
    vibration: float = 0.0
    vibration_frequency: float = 23.0
    latitude: float = math.radians(13.73)
    gravity: float = STANDARD_GRAVITY

    def __post_init__(self) -> None:
        for name in ("side", "speed", "turn_rate", "turn", "ramp"):
            if not 0 < abs(getattr(self, name)) < math.inf:
                raise UserError(
                    f"square: {name} is {getattr(self, name)}, expected a number above 0"
                )
        if self.side / self.speed < self.ramp or abs(self.turn / self.turn_rate) < self.ramp:
            raise UserError(
                f"square: a leg or a turn is shorter than its ramp of {self.ramp:g} s; make it "
                "slower or longer"
            )
        if self.stops < 0 or self.first_rest < 0 or self.legs < 1:
            raise UserError("square: stops and first_rest must not be below 0, legs not below 1")

    @property
    def moves(self) -> list[tuple[float, float, bool]]:
        """Start and duration in s at cruising speed of each move, and whether it is a turn."""
        found, at = [], self.first_rest
        for _ in range(self.legs):
            for duration, turns in (
                (self.side / self.speed, False),
                (abs(self.turn / self.turn_rate), True),
            ):
                found.append((at, duration, turns))
                at += duration + self.ramp + self.stops
        return found

    @property
    def duration(self) -> float:
        """s, to the end of the last stop."""
        start, length, _ = self.moves[-1]
        return start + length + self.ramp + max(self.stops, 1.0)


def square(
    side: float = 2.0,
    speed: float = 0.3,
    turn_rate: float = math.radians(45.0),
    stops: float = 3.0,
    *,
    sample_rate: float = 100.0,
    **more,
) -> Recording:
    """The true motion along a square (``Drive``), as a recording at ``sample_rate`` Hz.

    It has ``ref_q``, ``ref_rate``, ``ref_force``, ``ref_velocity``, position, latitude, ``moving``.
    Raises UserError for a drive that is none.
    """
    return motion(Drive(side, speed, turn_rate, stops, **more), sample_rate)


def motion(drive: Drive, sample_rate: float = 100.0) -> Recording:
    """The true motion of a drive; as ``square``."""
    if not 0 < sample_rate < math.inf:
        raise UserError(f"square: sample_rate {sample_rate} must be above 0 Hz")
    time = np.arange(round(drive.duration * sample_rate) + 1) / sample_rate
    heading = np.zeros((2, len(time)))
    place = np.zeros((3, 2, len(time)))
    angle, moving = 0.0, np.zeros(len(time))
    for start, duration, turns in drive.moves:
        done = np.array(_progress(time - start, duration, drive.ramp))
        moving[(time > start) & (time < start + duration + drive.ramp)] = 1.0
        if turns:
            rate = math.copysign(drive.turn_rate, drive.turn)
            heading += rate * done[:2]
            angle += drive.turn
        else:
            course = np.array([math.cos(angle), math.sin(angle)])
            place += drive.speed * done[:3, None] * course[None, :, None]
    return _as_recording(drive, time, heading, place, moving)


def _progress(time: np.ndarray, duration: float, ramp: float) -> tuple[np.ndarray, ...]:
    """``pyimu.plant.manoeuvre.progress`` of an array, less its last derivative."""
    start, end = np.clip(time / ramp, 0, 1), np.clip((time - duration) / ramp, 0, 1)
    (up, up_slope, risen), (down, down_slope, fallen) = _smooth_step(start), _smooth_step(end)
    steady = np.clip(time - ramp, 0, duration - ramp)
    done = steady + ramp * (risen + (end - fallen))
    return done, up - down, (up_slope - down_slope) / ramp


def _smooth_step(x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    step = x**3 * (10 + x * (6 * x - 15))
    return step, 30 * x**2 * (1 - x) ** 2, x**4 * (2.5 + x * (x - 3))


def _as_recording(drive: Drive, time, heading, place, moving) -> Recording:
    level = Rotation.from_euler("ZYX", [[0.0, drive.tilt[1], drive.tilt[0]]])
    q = Rotation.from_euler("Z", heading[0][:, None]) * level
    earth = EARTH_RATE * np.array([0.0, math.cos(drive.latitude), math.sin(drive.latitude)])
    flat = np.zeros((3, 3, len(time)))
    flat[:, :2] = place
    flat += _shaken(drive, time, moving)
    position, velocity, acceleration = flat.transpose(0, 2, 1)
    turning = np.outer(heading[1], [0.0, 0.0, 1.0])
    force = acceleration + 2 * np.cross(earth, velocity) + [0.0, 0.0, drive.gravity]
    return Recording.from_arrays(
        "square",
        time=time,
        ref_q=q.as_quat(scalar_first=True),
        ref_rate=q.inv().apply(turning + earth),
        ref_force=q.inv().apply(force),
        ref_velocity=velocity,
        ref_east=position[:, 0],
        ref_north=position[:, 1],
        ref_up=position[:, 2],
        latitude=np.full(len(time), drive.latitude),
        moving=moving,
    )


def _shaken(drive: Drive, time: np.ndarray, moving: np.ndarray) -> np.ndarray:
    """Displacement, velocity and acceleration (3, 3, n) in world axes by the motors, in each move a
    whole sine that is faded in and out over its ramps.
    """
    out = np.zeros((3, 3, len(time)))
    if not drive.vibration:
        return out
    omega = 2 * math.pi * drive.vibration_frequency
    size = math.sqrt(2) * drive.vibration / omega**2
    for start, duration, _ in drive.moves:
        t = time - start
        _, share, slope = _progress(t, duration, drive.ramp)
        bend = np.gradient(slope, time)
        for axis, phase in enumerate((0.0, 2.0, 4.0)):
            s, c = np.sin(omega * t + phase), np.cos(omega * t + phase)
            out[0, axis] += size * share * s
            out[1, axis] += size * (share * omega * c + slope * s)
            out[2, axis] += size * (-share * omega**2 * s + 2 * slope * omega * c + bend * s)
    return out


def stop_times(drive: Drive) -> Sequence[tuple[float, float]]:
    """Start and end in s of each rest."""
    ends = [(0.0, drive.first_rest)]
    moves = drive.moves
    for (start, length, _), (after, *_) in zip(moves, [*moves[1:], (drive.duration,)], strict=True):
        ends.append((start + length + drive.ramp, after))
    return ends
