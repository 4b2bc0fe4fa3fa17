"""Table 6 of Hidalgo 2012: the paper's test drives through sensor, low-pass and filter.

Unit ``RoverDrive`` -> sensor -> ``LowPass`` at 10 Hz -> attitude, each block stepped over the whole
drive at the part's sample rate. The sensor is the part with what it does not declare: a scale
factor of its gyros, biases, and an accelerometer where it has none. Three ways to the attitude:

* the gyros alone, integrated: what the part declares of a gyro that does not turn is taken off;
* the filter as published, with the part as declared;
* our filter with the part that ``pyimu.close`` finds from turns on the spot, which have noise of
  their own and are in no row of the table.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.attitude import run
from pyimu.display.silent import silent
from pyimu.errors import UserError
from pyimu.identification.close import close
from pyimu.identification.result import Closed
from pyimu.model.catalogue import POWER_ON, WALK, WHITE
from pyimu.model.part import Part
from pyimu.model.simulate import simulate
from pyimu.plant.low_pass import CUTOFF, low_pass
from pyimu.recording.integration import integrated
from pyimu.recording.recording import Recording
from pyimu.rover.demo import ASSUMED_ACCEL, TURN_ON_BIAS, UNDECLARED
from pyimu.rover.drives import Motion, drive
from pyimu.rover.heading_noise import HeadingNoise
from pyimu.rover.optical import optical_reference
from pyimu.rover.outcome import DriveRuns, Traces
from pyimu.rover.paper import PAPER_DRIVES, PaperDrive
from pyimu.rover.result import RoverTests

METHODS = ("gyros alone", "filter as published", "our filter, loop closed")

SEEDS = (1, 2, 3)
"""Of the noise of the drives in the table."""

OF_A_SEED = 10
"""Seeds of the sensor that belong to one of the table, one a drive."""

FIT_SEEDS = (9, 19, 29, 39)
"""Of the turns on the spot that the loop is closed on, none of them the table's; the last is held
out."""

MOST_RATE = 1000.0
"""Hz; a faster part is simulated at a whole part of its rate, or the drives would take minutes."""

LOG_RATE = 50.0
"""Hz; about the rate of the logs that the loop is closed on, a whole number of samples each."""

REST = 60.0
"""s at rest before each drive. The paper says nothing of it; a rover that turns its filter on
before it drives has it."""

SHOWN = 0.5
"""s between the points of the pictures' lines."""


@dataclass(frozen=True)
class Rover:
    """The part as declared, with an accelerometer, and as it is in truth."""

    known: Part
    true: Part

    @classmethod
    def of(cls, part: Part) -> Rover:
        """Raises UserError for a part that these drives say nothing of."""
        where = f"part {part.name}"
        declared = part.gyro.values
        if not np.all(declared.get(WHITE[0], {}).get(WHITE[1], np.zeros(3)) > 0):
            raise UserError(
                f"{where}: its gyro has no noise ({'.'.join(WHITE)}), without which no filter "
                "knows what to make of it; pyimu characterize finds it from a log at rest"
            )
        if part.sample_rate <= 2 * CUTOFF:
            raise UserError(
                f"{where}: its sample rate is {part.sample_rate:g} Hz, the low-pass of {CUTOFF:g} "
                f"Hz needs more than {2 * CUTOFF:g} Hz"
            )
        part = replace(part, sample_rate=part.sample_rate / math.ceil(part.sample_rate / MOST_RATE))
        if part.estimate:
            names = ", ".join(".".join(key) for key in sorted(part.estimate))
            raise UserError(f"{where}: {names} is to be estimated, a simulation needs its value")
        accel = part.accel
        if not accel.effects:
            accel = accel.with_values(WHITE[0], **{WHITE[1]: ASSUMED_ACCEL["N"]})
        known = replace(part, accel=accel)
        scale = declared.get("scale_factor", {}).get("s", np.zeros(3))
        gyro = part.gyro.with_values("scale_factor", s=scale + UNDECLARED)
        gyro = gyro.with_values(POWER_ON[0], **{POWER_ON[1]: TURN_ON_BIAS})
        accel = accel.with_values(POWER_ON[0], **{POWER_ON[1]: ASSUMED_ACCEL["b0"]})
        return cls(known, Part(part.name, part.sample_rate, gyro, accel))

    def noise(self, duration: float) -> HeadingNoise:
        """What the declared noise of the gyro about the vertical makes of the heading."""
        n, k = (self.known.gyro.values.get(e, {}).get(c, np.zeros(3))[2] for e, c in (WHITE, WALK))
        return HeadingNoise(float(n), float(k), REST, duration)


def rover_tests(
    part: Part,
    seeds: Sequence[int] = SEEDS,
    drives: Sequence[PaperDrive] = PAPER_DRIVES,
    say: Callable[..., None] = silent,
) -> RoverTests:
    """The test drives with a part, each with every seed of the noise, by each method.

    Raises UserError for a part without noise of its gyro or too slow for the low-pass.
    """
    rover = Rover.of(part)
    steps = len(drives) * len(seeds)
    say("closing the loop on turns on the spot", 0.0)
    closed = loop_closed(rover, say)
    found = replace(rover.known, gyro=closed.after.gyro)
    runs = []
    for i, paper in enumerate(drives):
        say(f"{paper.title}: the motion", (i + 0.5) / (len(drives) + 0.5))
        motion = drive(paper.name, sample_rate=rover.known.sample_rate, start_time=REST)
        flown = []
        for j, seed in enumerate(seeds):
            say(
                f"{paper.title}: noise {j + 1} of {len(seeds)}",
                (i * len(seeds) + j + 1) / (steps + 1),
            )
            # A noise of its own for each drive, or they would all share their luck.
            flown.append(_flown(rover, found, motion, OF_A_SEED * seed + i))
        largest, true = (
            np.array([getattr(f, n) for f in flown]) for n in ("largest", "largest_true")
        )
        runs.append(DriveRuns(paper, largest, true, flown[0], *_noise(rover, motion)))
    return RoverTests(rover.known, rover.true, found, METHODS, tuple(seeds), tuple(runs), closed)


def loop_closed(rover: Rover, say: Callable[[str], None] = silent) -> Closed:
    """The loop closed on turns on the spot: a log of each of ``FIT_SEEDS``, the last held out."""
    rate = rover.known.sample_rate / max(1, round(rover.known.sample_rate / LOG_RATE))
    motion = drive("turn_on_spot", sample_rate=rate, start_time=REST)
    true = replace(rover.true, sample_rate=rate)
    logs = [_log(true, motion, seed) for seed in FIT_SEEDS]
    return close(logs[:-1], rover.known, logs[-1:], say=say)


def _log(true: Part, motion: Motion, seed: int) -> Recording:
    gyro, accel = _measured(true, motion, seed)
    rate = true.sample_rate
    return Recording.from_arrays(
        name=f"turn_on_spot_{seed}",
        time=motion.time,
        gyro=gyro,
        accel=accel,
        temperature=motion.temperature,
        ref_q=optical_reference(motion.q, rate, np.random.default_rng(seed)),
        stationary=motion.standing,
        latitude=np.full(len(motion.time), motion.parameters["latitude"]),
    )


def _measured(true: Part, motion: Motion, seed: int | None) -> tuple[np.ndarray, np.ndarray]:
    others = {"mag": motion.mag} if "mag" in true.signals else {}
    return simulate(
        true, motion.rate, motion.specific_force, motion.temperature, seed=seed, **others
    )


# One drive


def _flown(rover: Rover, found: Part, motion: Motion, seed: int) -> Traces:
    """One drive with one noise, by each method."""
    h = rover.known.sample_period
    gyro, accel = _measured(rover.true, motion, seed)
    passed, _ = low_pass(h).run(np.hstack([gyro, accel]))
    log = Recording.from_arrays(
        name=motion.name,
        time=motion.time,
        gyro=passed[:, :3],
        accel=passed[:, 3:],
        temperature=motion.temperature,
        mag=motion.mag,
    )
    rng = np.random.default_rng([seed, len(motion.time)])
    every = round(rover.known.sample_rate)
    seen = optical_reference(motion.q, rover.known.sample_rate, rng, every)
    reference, true = (_angles(Rotation.from_quat(q, scalar_first=True)) for q in (seen, motion.q))
    given = {"latitude": motion.parameters["latitude"], "heading0": 0.0, "magnetometer": False}
    published = run(log, rover.known, settings={"filter": "hidalgo2012", "low_pass": 0.0}, **given)
    # The wheels know when the rover stands. A drive of 1 cm/s is so even that by its gyros and
    # accelerometers alone our filter takes a third of the straight line for rest.
    own = run(replace(log, stationary=motion.standing), found, **given)
    alone = _gyros_alone(rover.known, motion, passed[:, :3])
    angles = [_angles(alone), published.euler[:, ::-1], own.euler[:, ::-1]]
    return _compared(motion, reference, true, angles)


def _gyros_alone(known: Part, motion: Motion, gyro: np.ndarray) -> Rotation:
    """The integral of the gyros, less what the part declares of one that does not turn."""
    standing = replace(motion, outputs=motion.outputs.copy())
    standing.outputs[:, motion.columns["rate"]] = 0.0
    still, _ = _measured(known, standing, None)
    start = Rotation.from_quat(motion.q[0], scalar_first=True)
    return integrated(gyro - still, known.sample_period, start)


def _angles(attitude: Rotation) -> np.ndarray:
    """Heading, pitch, roll (n, 3) in rad."""
    return attitude.as_euler("ZYX")


def _compared(
    motion: Motion, reference: np.ndarray, true: np.ndarray, angles: Sequence[np.ndarray]
) -> Traces:
    """Estimates beside the reference and the truth; headings set right where the drive starts."""
    driving = np.flatnonzero(motion.standing == 0)
    start, end = int(driving[0]), int(driving[-1]) + 1
    errors = [_error(found, reference, start) for found in angles]
    exact = [_error(found, true, start) for found in (*angles, reference)]
    largest, largest_true = (
        np.array([np.abs(e[start:end]).max(axis=0) for e in of]) for of in (errors, exact)
    )
    shown = np.arange(0, len(motion.time), max(1, round(SHOWN / (motion.time[1] - motion.time[0]))))
    seen = np.rad2deg(np.column_stack([np.unwrap(reference[:, 0]), reference[:, 1:]]))
    return Traces(
        motion.time[shown],
        float(motion.time[start]),
        float(motion.time[end - 1]),
        seen[shown],
        np.array([e[shown] for e in errors]),
        largest,
        largest_true,
    )


def _error(found: np.ndarray, true: np.ndarray, start: int) -> np.ndarray:
    """Error (n, 3) in deg of heading, pitch and roll; the heading's from row ``start`` on."""
    error = (found - true + np.pi) % (2 * np.pi) - np.pi
    error[:, 0] = np.unwrap(error[:, 0])
    error[:, 0] -= error[start, 0]
    return np.rad2deg(error)


def _noise(rover: Rover, motion: Motion) -> tuple[HeadingNoise, np.ndarray]:
    """The heading's noise over a drive, and the angle turned at its instants."""
    driving = motion.time[motion.standing == 0]
    noise = rover.noise(float(driving[-1] - driving[0]))
    turned = np.interp(driving[0] + noise.time, motion.time, np.unwrap(motion.yaw))
    return noise, turned - turned[0]
