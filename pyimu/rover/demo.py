"""The paper's own open case as a recording: a rover's IMT30 with an unknown scale factor.

Hidalgo 2012, section 6.2, found 6.5 deg of heading error after a half turn on the spot and could
not say how much of it was scale factor. This recording is simulated from the paper's tables with a
scale factor put in that gives that error; ``pyimu.close`` is then told the tables and not the scale
factor.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import matplotlib
import numpy as np
from markupsafe import Markup
from matplotlib.figure import Figure

from pyimu.attitude import run
from pyimu.display.silent import silent
from pyimu.files import whole
from pyimu.identification.close import close
from pyimu.identification.errors.attitude_error import attitude_error
from pyimu.identification.model.simulated import Simulated
from pyimu.identification.report.deliver import check_delivery
from pyimu.identification.report.put_in import put_in
from pyimu.identification.result import Closed
from pyimu.model.part import Part
from pyimu.model.part_file import part
from pyimu.model.simulate import simulate
from pyimu.plant.rover_variables import CRUISE_SPEED, RADIUS, SPOT_TURN_RATE
from pyimu.recording.log import read_recording
from pyimu.recording.recording import Recording
from pyimu.report.figures import AFTER, BEFORE, FLOOR, STYLE, legend, svg_of
from pyimu.report.page import Picture
from pyimu.rover.drives import Motion, free_drive
from pyimu.rover.optical import optical_reference

SAMPLE_RATE = 50.0
"""Hz; the paper samples at 976 Hz and filters at 10 Hz."""

HALF_TURN = np.pi / SPOT_TURN_RATE
"""s of a turn on the spot, one way."""

MANOEUVRES = (
    (60.0, 0.0, 0.0),
    (HALF_TURN, 0.0, SPOT_TURN_RATE),
    (HALF_TURN, 0.0, -SPOT_TURN_RATE),
    (30.0, 0.0, 0.0),
    (250.0, CRUISE_SPEED, 0.0),
    (30.0, 0.0, 0.0),
    (np.pi * RADIUS / CRUISE_SPEED, CRUISE_SPEED, CRUISE_SPEED / RADIUS),
    (30.0, 0.0, 0.0),
    (HALF_TURN, 0.0, SPOT_TURN_RATE),
    (HALF_TURN, 0.0, -SPOT_TURN_RATE),
    (20.0, 0.0, 0.0),
)
"""The drive: s, speed in m/s and turn rate in rad/s. A turn on the spot out and back, a straight
line, an Ackermann half circle and a second turn on the spot, with stops between them."""

SHAKE = 0.03
"""m/s^2; standard deviation of the force of a rover that drives. Assumed."""

UNDECLARED = np.array([-0.018, 0.011, -6.5 / 180.0])
"""Scale factor errors of the gyros; about the vertical what makes 6.5 deg of 180."""

TURN_ON_BIAS = np.deg2rad([0.05, -0.03, 0.04])
"""rad/s; of the gyros. Assumed; the paper says nothing of it."""

ASSUMED_ACCEL = {"N": 5e-4, "b0": np.array([0.004, -0.003, 0.002])}
"""White noise in m/s/sqrt(s) and turn-on bias in m/s^2 of the accelerometer, of which the paper
gives nothing."""

MADE = (
    "This rover is simulated, so that the truth is known: a drive of 24 minutes with the IMT30 of "
    "Hidalgo 2012 (tables 1, 2 and 4) and an optical reference that is right to a tenth of a "
    "degree. The loop was told the tables, and none of what follows."
)

CAPTION = (
    "On rows that were not fitted. Left: what the gyro about the vertical measured less what the "
    "model says. Right: heading error of the attitude filter over the last turn on the spot, out "
    "and back, set right where the turn begins. Where the rover stands again (the last 20 s) the "
    "filter sees how far the bias has walked and takes the heading back accordingly."
)


def true_part() -> Part:
    """The IMT30 as it really is here: the paper's tables, a scale factor, and an accelerometer."""
    known = part("imt30")
    gyro = known.gyro.with_values("scale_factor", s=UNDECLARED)
    accel = known.accel.with_values("angle_random_walk", N=ASSUMED_ACCEL["N"]).with_values(
        "turn_on_bias", b0=ASSUMED_ACCEL["b0"]
    )
    return Part(
        "imt30 with a scale factor",
        SAMPLE_RATE,
        gyro.with_values("turn_on_bias", b0=TURN_ON_BIAS),
        accel,
    )


def motion(terrain: int = 2012) -> Motion:
    """The demo's drive of ``RoverDrive``, over the ground of that number."""
    times, *commands = np.array(MANOEUVRES).T
    starts = np.append(0.0, np.cumsum(times))
    table = np.column_stack([starts[:-1], *commands])
    return free_drive(
        table, sample_rate=SAMPLE_RATE, rest=times[-1], start_temperature=24.0, terrain=terrain
    )


def recording(seed: int = 2012) -> Recording:
    """The demo's recording.

    Gyro, accelerometer, temperature, optical reference attitude, and when the rover stands.
    """
    m = motion(seed)
    rng = np.random.default_rng(seed + 1)
    shake = SHAKE * rng.standard_normal(m.specific_force.shape) * (m.standing[:, None] == 0)
    force = m.specific_force + shake
    gyro, accel = simulate(true_part(), m.rate, force, m.temperature, seed=seed)
    return Recording.from_arrays(
        name="rover",
        time=m.time,
        gyro=gyro,
        accel=accel,
        temperature=m.temperature,
        ref_q=optical_reference(m.q, SAMPLE_RATE, rng),
        stationary=m.standing,
        latitude=np.full(len(m.time), m.parameters["latitude"]),
    )


@dataclass(frozen=True)
class LastTurn:
    """The last turn on the spot of the demo, which was held out, from stand to stand.

    ``before`` and ``after`` are the errors of heading [rad] against the optical reference, set
    right where the turn begins, at ``time`` [s]; ``std`` [rad] is what the declared noise of the
    gyros makes of it by the filter's own account.
    """

    time: np.ndarray
    before: np.ndarray
    after: np.ndarray
    std: np.ndarray

    @property
    def said(self) -> tuple[str, ...]:
        """What the picture shows, in sentences."""
        pair = [np.rad2deg(e) for e in (self.before, self.after)]
        worst, end = ([float(f(np.abs(e))) for e in pair] for f in (np.max, lambda e: e[-1]))
        noise = 2 * np.rad2deg(self.std.max())
        over = (
            "Heading error over the last turn on the spot (0-180-0 deg, held out): at most "
            f"{worst[0]:.1f} deg before, {worst[1]:.1f} deg after; the declared noise of the gyros "
            f"alone makes up to {noise:.1f} deg of it (2 sigma)."
        )
        back = (
            f"Once the rover has turned back it is {end[0]:.1f} deg before and {end[1]:.1f} deg "
            "after: what a scale factor does on the way out the way back undoes, so that only "
            "noise is left there, and which of the two is smaller is chance."
        )
        return over, back


@dataclass(frozen=True)
class Demo:
    """The result of the demo: the closed loop, and the heading before and after."""

    closed: Closed
    turn: LastTurn

    def report(self) -> str:
        """What was put in, what was found, and what ``close`` says."""
        return self.closed.report()


def run_demo(out: Path | str, say: Callable[[str], None] = silent) -> Demo:
    """Run the demo and write everything to ``out``.

    It makes the recording and closes the loop on it with the paper's tables alone.
    """
    out = Path(out)
    check_delivery(out)
    say("simulating the rover")
    rover = recording()
    out.mkdir(parents=True, exist_ok=True)
    log = read_recording(rover.write(out / "rover.csv"))
    closed = close(log, "imt30", say=say)
    say("heading before and after")
    turn = last_turn(closed, log)
    with matplotlib.rc_context(STYLE):
        figure = before_and_after(closed, turn)
        picture = Picture(Markup(svg_of(figure)), CAPTION, "rate residual and heading error")
    closed = replace(
        closed, simulated=Simulated(MADE, put_in(closed, true_part()), turn.said, (picture,))
    )
    closed.write(out, say=say)
    # Its labels have room by the style that it was laid out in.
    with matplotlib.rc_context(STYLE), whole(out / "heading.png") as unfinished:
        figure.savefig(unfinished, format="png", dpi=150, facecolor="white")
    return Demo(closed, turn)


def last_turn(closed: Closed, log: Recording) -> LastTurn:
    """The heading over the last drive from stand to stand by the parts before and after."""
    mounting = np.array(closed.recordings[0].log_state["gyro"]["rotation"])
    start = int(np.flatnonzero(np.diff(log.stationary) < 0)[-1])
    before, after = (attitude_error(log, p, mounting, start) for p in (closed.before, closed.after))
    variance = run(log, closed.after, magnetometer=False).heading_std[start:] ** 2
    # What the filter knows of the heading at the start is set right there.
    std = np.sqrt(np.maximum(variance - variance[0], 0.0))
    return LastTurn(after.time, before.heading, after.heading, std)


def before_and_after(closed: Closed, turn: LastTurn) -> Figure:
    """Rate residual about the vertical on held-out rows, and heading error over the last turn."""
    figure = Figure(figsize=(8.4, 3.1), layout="constrained")
    left, right = figure.subplots(1, 2)
    for name, colour in (("before", BEFORE), ("after", AFTER)):
        for trace in closed.exhibits["gyro"].traces:
            rate = np.rad2deg(getattr(trace, name)[:, 2])
            left.plot(trace.time, rate, color=colour, lw=0.8, label=name)
        error = np.rad2deg(getattr(turn, name))
        right.plot(turn.time, error, color=colour, lw=1.4, label=name)
    band = 2 * np.rad2deg(turn.std)
    right.fill_between(
        turn.time, -band, band, color=FLOOR, alpha=0.25, lw=0, label="±2σ of the declared noise"
    )
    left.set(
        xlabel="time [s]", ylabel="rate residual, z [deg/s]", title="gyro less model, held out"
    )
    right.set(
        xlabel="time [s]", ylabel="heading error [deg]", title="last turn on the spot, held out"
    )
    for panel in (left, right):
        panel.title.set_fontsize(9.5)
    legend(figure, right, 3)
    return figure
