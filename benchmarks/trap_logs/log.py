"""A log with the truth of what was done to it, and the scene that logs are made from."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from generators import rotation
from generators.instrument import Sensor, any_sensor
from generators.motion import Motion, any_motion

Columns = dict[str, np.ndarray]


@dataclass(frozen=True)
class Log:
    """One case: the columns of one or several logs of one part, the part's file, and what is wrong.

    ``references`` are columns of references in files of their own, one for each log, if any;
    ``cause`` names it, ``figures`` says how large it is; ``own`` are effects that the sensor truly
    has and a part that nobody declared lacks; ``late`` says that the sensor shows all motion late
    by one time, which may be its own delay.
    """

    logs: tuple[Columns, ...]
    part: str
    motions: tuple[str, ...]
    cause: str = "nothing"
    figures: Mapping[str, float] = field(default_factory=dict)
    own: frozenset[str] = frozenset()
    late: bool = False
    references: tuple[Columns, ...] = ()


@dataclass(frozen=True)
class Scene:
    """A sensor that rides a motion; what it and its reference show is made once asked for."""

    rng: np.random.Generator
    hz: float
    time: np.ndarray
    motion: Motion
    sensor: Sensor
    reference_std: float

    @property
    def h(self) -> float:
        return 1 / self.hz

    def again(self) -> Scene:
        """Another log of the same part: a motion and a bias of its own."""
        other = new_scene(self.rng, self.hz)
        gyro = replace(self.sensor.gyro, bias=other.sensor.gyro.bias)
        return replace(other, sensor=replace(self.sensor, gyro=gyro))

    def sensed(self, early: float = 0.0, warmth: np.ndarray | None = None) -> Columns:
        """Time, gyro and accelerometer; the samples show the motion ``early`` s before its time."""
        at = self.time + early
        return {
            "time": self.time,
            "gyro": self.sensor.gyro.measure(self.rng, self.motion.rate(at), self.h, warmth),
            "accel": self.sensor.accel.measure(self.rng, self.motion.force(at), self.h),
        }

    def attitude(self, late: np.ndarray | float = 0.0) -> np.ndarray:
        """A reference's attitude (n, 4), which shows the motion ``late`` s after its time, with
        white noise.
        """
        return self.attitude_at(self.time - late)

    def attitude_at(self, at: np.ndarray) -> np.ndarray:
        error = self.reference_std * self.rng.standard_normal((len(at), 3))
        return rotation.product(self.motion.attitude(at), rotation.from_vector(error))

    def log(self, columns: Columns | tuple[Columns, ...], cause: str = "nothing", **truth) -> Log:
        """The case that these columns make, with its ``truth``: figures, own, late."""
        logs = columns if isinstance(columns, tuple) else (columns,)
        part = self.sensor.part_file(self.hz)
        return Log(logs, part, (self.motion.name,), cause, **truth)


def new_scene(
    rng: np.random.Generator,
    hz: float = 100.0,
    motion: Callable[..., Motion] = any_motion,
    thermal: bool = False,
    duration: float | None = None,
) -> Scene:
    """60 to 120 s of a motion at ``hz``, a reference attitude with 0.02 to 0.1 deg of noise."""
    duration = float(rng.uniform(60, 120)) if duration is None else duration
    time = np.arange(round(duration * hz)) / hz
    made = motion(rng, duration)
    return Scene(rng, hz, time, made, any_sensor(rng, thermal), np.deg2rad(rng.uniform(0.02, 0.1)))


def beside(
    scene: Scene,
    sensed: Columns,
    cause: str,
    stamped: Callable[[np.ndarray], np.ndarray] = np.array,
    hz: tuple[float, float] = (100.0, 240.0),
    **truth,
) -> Log:
    """The case of a reference in a file of its own, of so many Hz, whose samples at the times t
    have the stamps ``stamped(t)``.
    """
    rate = float(scene.rng.uniform(*hz))
    time = np.arange(round(scene.time[-1] * rate)) / rate
    seen: Columns = {"time": stamped(time), "ref_q": scene.attitude_at(time)}
    return replace(scene.log(sensed, cause, **truth), references=(seen,))
