"""Monte Carlo of an indoor robot's heading: Hong and Park's experiment under stated assumptions.

The paper says neither how long its runs are, nor how many, nor what its gyro does. The numbers of
``Assumptions`` are such that its results table comes out; they are no measurement. A run is drawn
by its number alone, so that any share of them can be made anywhere.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

import numpy as np

from pyimu.display.silent import silent
from pyimu.heading.result import HeadingResult
from pyimu.heading.run import METHODS, run
from pyimu.heading.threshold import TYPICAL
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.model.simulate import simulate
from pyimu.recording.recording import Recording
from pyimu.rover.indoor import Indoor, indoor

DEG = np.radians(1.0)

KELVIN = 10.0
"""K by which the part warms up; only the product with its thermal bias counts."""

ROOM = 25.0
"""degC."""


@dataclass(frozen=True)
class Assumptions:
    """What the runs are made of, SI; pairs are mean and standard deviation from run to run.

    ``n`` rad/sqrt(s) and ``k`` rad/s/sqrt(s) are the gyro's noise, ``bias`` rad/s that at power-on,
    ``warm_up`` rad/s by how much it grows with the time constant ``warm_up_time`` s once the
    start-up motion is over. ``scale_factor`` and ``slip`` (of the known motion) are standard
    deviations; ``wander`` rad/s is the RMS of the heading's wander while the robot drives.
    """

    n: float = 0.01 * DEG
    k: float = 3e-4 * DEG
    bias: tuple[float, float] = (0.0041 * DEG, 0.0030 * DEG)
    warm_up: tuple[float, float] = (0.0150 * DEG, 0.0044 * DEG)
    warm_up_time: float = 120.0
    scale_factor: float = 0.0035
    slip: float = 0.0032
    wander: float = 0.037 * DEG
    threshold: float = TYPICAL
    sample_rate: float = 50.0

    @property
    def part(self) -> Part:
        """What the filter is told: the noise, with a walk that in the warm-up's time grows by as
        much, in mean square, as the warm-up does of which nobody told.
        """
        mean, std = self.warm_up
        walk = np.sqrt(self.k**2 + (mean**2 + std**2) / self.warm_up_time)
        return self._part(walk)

    def _part(self, k: float, **effects: dict) -> Part:
        gyro = {"angle_random_walk": {"N": self.n}, "rate_random_walk": {"K": k}}
        return Part("indoor robot", self.sample_rate, Sensor("gyro", gyro | effects))

    def drawn(self, rng: np.random.Generator) -> Part:
        """The part of one run, as it really is."""
        about = np.array([0.0, 0.0, 1.0])
        s = self.scale_factor * rng.standard_normal()
        bias, warm = (m + d * rng.standard_normal() for m, d in (self.bias, self.warm_up))
        return self._part(
            self.k,
            scale_factor={"s": s * about},
            turn_on_bias={"b0": bias * about},
            thermal_bias={"kT": warm / KELVIN * about, "T0": ROOM},
        )


@dataclass(frozen=True)
class Run:
    """One run: the drive after the start-up motion as a log, and the known motion as another."""

    log: Recording
    known: Recording
    motion: Indoor


def one_run(number: int, given: Assumptions = Assumptions()) -> Run:
    """The run of this number."""
    rng = np.random.default_rng([2008, number])
    slip, true = given.slip * rng.standard_normal(), given.drawn(rng)
    m = indoor(given.sample_rate, slip=slip, wander=given.wander, seed=number)
    since = np.maximum(m.time - m.time[m.start_up - 1], 0.0)
    temperature = ROOM + KELVIN * -np.expm1(-since / given.warm_up_time)
    rate = np.zeros((len(m.time), 3))
    rate[:, 2] = m.rate
    gyro, _ = simulate(true, rate, m.force, temperature, seed=number)
    log = m.recording(gyro[:, 2], name=f"run {number}")
    known = m.recording(gyro[:, 2], known=True, name=f"start-up of run {number}")
    return Run(log.slice(m.start_up - 1), known, m)


def scored(
    one: Run, given: Assumptions, methods: Iterable[str] = tuple(METHODS), declared: bool = True
) -> HeadingResult:
    """The run's heading by each method; rests are those of the robot's own wheels (``declared``),
    else found by gyro and accelerometer.
    """
    log = one.log if declared else replace(one.log, stationary=None)
    return run(
        log,
        given.part,
        list(methods),
        known=one.known,
        threshold=given.threshold,
        slip_std=given.slip,
    )


@dataclass(frozen=True)
class Errors:
    """Heading errors in rad at the ends of runs, (n,) by method, and of the filter the claimed
    standard deviations (n,).
    """

    by_method: dict[str, np.ndarray]
    claimed: np.ndarray

    def __getitem__(self, method: str) -> np.ndarray:
        return self.by_method[method]

    @property
    def nees(self) -> float:
        """Mean of the filter's squared errors over their claimed variance."""
        return float(np.mean((self.by_method["filter"] / self.claimed) ** 2))


def errors(
    runs: int,
    given: Assumptions = Assumptions(),
    declared: bool = True,
    say: Callable[..., None] = silent,
) -> Errors:
    """The errors of so many runs by every method."""
    found: dict[str, list[float]] = {name: [] for name in METHODS}
    claimed = []
    for number in range(runs):
        say(f"run {number + 1} of {runs}", number / runs)
        result = scored(one_run(number, given), given, declared=declared)
        for m in result.methods:
            found[m.name].append(m.tracks[0].last_error)
        claimed.append(float(result["filter"].tracks[0].filter.heading_std[-1]))
    return Errors({n: np.array(v) for n, v in found.items()}, np.array(claimed))
