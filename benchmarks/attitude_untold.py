"""Is the attitude filter honest about what nobody told it?

``python benchmarks/attitude_untold.py [--runs N] [--first I] [--only TEXT] [--seed S]`` prints a
row for each case: the RMS error of tilt and heading in degrees beside what is claimed of them, and
the mean normalised estimation error squared (NEES) of tilt, heading and bias, 1 where the filter is
as good as it says. Bodies and samples are those of ``drives/cases.py``; the filter is told no more
than a log's user tells it by default, or the part's white noise where a case says so.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from attitude_honesty import errors, estimated
from drives import bodies
from drives.cases import (
    hand,
    matched,
    off_scale,
    record,
    turned_one_way,
    vehicle,
    with_headings,
)
from drives.log import Log
from generators import rotation
from generators.motion import eased

from pyimu.attitude import run
from pyimu.recording.recording import Recording


@dataclass(frozen=True)
class Untold:
    """How a log is made by ``make(rng)``, and whether the filter has the ``part`` of it."""

    name: str
    make: Callable[[np.random.Generator], Log]
    part: bool = False
    since: float = 10.0


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=20)
    parser.add_argument("--first", type=int, default=0, help="number of the first run")
    parser.add_argument("--only", default="")
    parser.add_argument("--seed", type=int, default=1)
    told = parser.parse_args()
    print(
        f"{'':44s}{'tilt [deg]':>16s}{'heading [deg]':>16s}{'NEES':>24s}\n{'case':44s}"
        + f"{'error':>8s}{'claimed':>8s}" * 2
        + "    tilt heading    bias"
    )
    for case in (c for c in CASES if told.only in c.name):
        numbers = range(told.first, told.first + told.runs)
        runs = [scored(case, np.random.default_rng([told.seed, i])) for i in numbers]
        size, nees = np.mean([r[:4] for r in runs], axis=0), np.mean([r[4:] for r in runs], axis=0)
        rms = "".join(f"{v:8.3f}" for v in np.degrees(np.sqrt(size)))
        print(f"{case.name:44s}{rms}{''.join(f'{v:8.2f}' for v in nees)}", flush=True)


def scored(case: Untold, rng) -> list[float]:
    """Mean squares of the error of tilt and heading, each beside that claimed, and the NEES."""
    log = case.make(rng)
    at = log.time >= log.time[0] + case.since
    found = estimated(log, smooth=False) if case.part else _by_default(log)
    tilt, heading = errors(found.q, log, at, headed=True)
    bias = (found.gyro_bias - log.bias)[at]
    own = 2 * found.tilt_std[at] ** 2, found.heading_std[at] ** 2
    squares = [v for e, s in zip((tilt, heading), own, strict=True) for v in (e**2, s)]
    nees = (tilt**2 / own[0], heading**2 / own[1], bias**2 / found.std[at, 3:] ** 2)
    return [float(np.mean(v)) for v in (*squares, *nees)]


def _by_default(log: Log):
    samples = {"time": log.time, "gyro": log.gyro, "accel": log.accel}
    return run(Recording.from_arrays(**samples, **log.heading), **log.told)


def late(make: Callable[..., Log], age: float) -> Callable[..., Log]:
    """Headings ``age`` s late, without the column that says so."""

    def unsaid(rng) -> Log:
        log = with_headings(rng, make(rng), age=age)
        return replace(log, heading={n: v for n, v in log.heading.items() if n != "heading_age"})

    return unsaid


def car(rng) -> Log:
    return record(rng, vehicle(rng, 180.0, 0.5, (3.0, 8.0)), 180.0)


FIELD = np.array([0.0, 19e-6, -45e-6])
"""T; east, north and up, of a dip of 67 deg."""

MAG_STD = 3e-7
"""T; white noise of a sample of a magnetometer."""

IRON = 25e-6
"""T; of the field of the iron that bends another."""


def in_field(make: Callable[..., Log], *near: tuple[float, float]) -> Callable[..., Log]:
    """A magnetometer, which is ``near`` iron of a place between so many and so many s."""

    def seen(rng) -> Log:
        log = make(rng)
        direction = rng.standard_normal(3)
        bent = IRON * direction / np.linalg.norm(direction)
        field = FIELD + eased(log.time, list(near), 2.0)[:, None] * bent
        mag = rotation.in_body(log.q, field) + MAG_STD * rng.standard_normal(field.shape)
        return replace(log, heading=log.heading | {"mag": mag})

    return seen


def holes(make: Callable[..., Log], share: float) -> Callable[..., Log]:
    """A log of which a ``share`` of the rows has no gyro and no accelerometer."""

    def torn(rng) -> Log:
        log = make(rng)
        rows = rng.random(len(log.time)) < share
        log.gyro[rows], log.accel[rows] = np.nan, np.nan
        return log

    return torn


CASES = (
    Untold("headings in time", late(matched, 0.0), part=True),
    Untold("headings 0.1 s late", late(matched, 0.1), part=True),
    Untold("headings 0.5 s late", late(matched, 0.5), part=True),
    Untold("headings 1 s late", late(matched, 1.0), part=True),
    Untold("headings 0.5 s late, no part", late(matched, 0.5)),
    Untold("car, headings 0.5 s late", late(car, 0.5), part=True),
    Untold("car, headings 1 s late", late(car, 1.0), part=True),
    Untold("field: the same all the time", in_field(matched), since=60.0),
    Untold("field: iron in the first 20 s", in_field(matched, (-9.0, 20.0)), since=60.0),
    Untold("field: iron in the first 20 s, a car", in_field(car, (-9.0, 20.0)), since=60.0),
    Untold("field: iron from 50 s on", in_field(matched, (50.0, 200.0)), since=80.0),
    Untold("field: iron from 50 s on, a car", in_field(car, (50.0, 300.0)), since=80.0),
    Untold("field: iron from 50 to 60 s", in_field(matched, (50.0, 60.0)), since=80.0),
    Untold("one row in twenty missing", holes(late(matched, 0.0), 0.05), part=True),
    Untold("one row in twenty missing, a car", holes(late(car, 0.0), 0.05), part=True),
    Untold("gyro scale 2 % off, one way", off_scale(turned_one_way)),
    Untold("gyro scale 2 % off, to and fro", off_scale(matched)),
    Untold("gyro scale 2 % off, a hand", off_scale(hand(1.0, 0.3, 2.0, 2.0))),
    Untold("gyro scale 2 % off, headings", off_scale(late(turned_one_way, 0.0))),
    Untold("arm, sensors as bought", lambda rng: bodies.arm(rng, sensors=bodies.AS_BOUGHT)),
)

if __name__ == "__main__":
    main()
