"""The paper's own open case as a recording: a rover's IMT30 with an unknown scale factor.

Hidalgo 2012, section 6.2, found 6.5 deg of heading error after a half turn on the spot and could
not say how much of it was scale factor. This recording is simulated from the paper's tables with a
scale factor put in that gives that error; ``pyimu.close`` is then told the tables and not the scale
factor.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from scipy.ndimage import gaussian_filter1d
from scipy.spatial.transform import Rotation

from pyimu.attitude.error import AttitudeError
from pyimu.files import whole
from pyimu.identification.attitude_error import attitude_error
from pyimu.identification.close import close
from pyimu.identification.report.deliver import check_delivery
from pyimu.identification.result import Closed
from pyimu.model.part import Part
from pyimu.model.part_file import part
from pyimu.model.simulate import simulate
from pyimu.recording.log import read_recording
from pyimu.recording.recording import Recording
from pyimu.rover.trajectory import Motion, ackermann, drive, stop, straight, turn_on_spot

SAMPLE_RATE = 50.0
"""Hz; the paper samples at 976 Hz and filters at 10 Hz."""

LATITUDE = np.deg2rad(52.22)
"""rad; Noordwijk, where the paper's rover drove."""

UNDECLARED = np.array([-0.018, 0.011, -6.5 / 180.0])
"""Scale factor errors of the gyros; about the vertical what makes 6.5 deg of 180."""

REFERENCE_WANDER = np.deg2rad(0.1)
"""rad; slow error of the optical reference, Hidalgo 2012: 0.1 to 0.2 deg."""

REFERENCE_NOISE = np.deg2rad(0.01)
"""rad; its white noise from sample to sample."""


def true_part() -> Part:
    """The IMT30 as it really is here: the paper's tables, a scale factor, and an accelerometer."""
    known = part("imt30")
    gyro = known.gyro.with_values("scale_factor", s=UNDECLARED)
    accel = known.accel.with_values("angle_random_walk", N=5e-4).with_values(
        "turn_on_bias", b0=[0.004, -0.003, 0.002]
    )
    return Part(
        "imt30 with a scale factor",
        SAMPLE_RATE,
        gyro.with_values("turn_on_bias", b0=np.deg2rad([0.05, -0.03, 0.04])),
        accel,
    )


def motion(seed: int = 2012) -> Motion:
    """The demo's drive, with stops between its manoeuvres.

    Turn on the spot, straight line, Ackermann half circle, and a second turn on the spot.
    """
    parts = [
        stop(60.0),
        *turn_on_spot(),
        stop(30.0),
        *straight(2.5),
        stop(30.0),
        *ackermann(),
        stop(30.0),
        *turn_on_spot(),
        stop(20.0),
    ]
    return drive(parts, SAMPLE_RATE, LATITUDE, seed)


def recording(seed: int = 2012) -> Recording:
    """The demo's recording.

    Gyro, accelerometer, temperature, optical reference attitude, and when the rover stands.
    """
    m = motion(seed)
    rng = np.random.default_rng(seed + 1)
    shake = 0.03 * rng.standard_normal(m.force.shape) * (m.standing[:, None] == 0)
    temperature = (
        24.0 + 6.0 * (1 - np.exp(-m.time / 500.0)) + 0.8 * np.sin(2 * np.pi * m.time / 420.0)
    )
    gyro, accel = simulate(true_part(), m.rate, m.force + shake, temperature, seed=seed)
    return Recording.from_arrays(
        name="rover",
        time=m.time,
        gyro=gyro,
        accel=accel,
        temperature=temperature,
        ref_q=_seen(m, rng),
        stationary=m.standing,
        latitude=np.full(len(m.time), LATITUDE),
    )


def _seen(m: Motion, rng: np.random.Generator) -> np.ndarray:
    """The attitude (n, 4) as the optical reference gives it.

    It is right to a tenth of a degree, wandering over 20 s.
    """
    slow = gaussian_filter1d(rng.standard_normal((len(m.time), 3)), 20.0 * SAMPLE_RATE, axis=0)
    error = REFERENCE_WANDER * slow / slow.std() + REFERENCE_NOISE * rng.standard_normal(slow.shape)
    return (Rotation.from_rotvec(error) * Rotation.from_quat(m.q, scalar_first=True)).as_quat(
        scalar_first=True
    )


@dataclass(frozen=True)
class Demo:
    """The result of the demo: the closed loop, and the heading error before and after.

    The heading error [rad] is that over the held-out rows.
    """

    closed: Closed
    before: AttitudeError
    after: AttitudeError

    def report(self) -> str:
        """The headline and what ``close`` says."""
        worst = [np.rad2deg(np.abs(e.heading).max()) for e in (self.before, self.after)]
        return (
            f"heading error on the held-out half turns: {worst[0]:.1f} deg before, {worst[1]:.1f} "
            "deg after\n" + self.closed.report()
        )


def run_demo(out: Path | str, say: Callable[[str], None] = lambda text: None) -> Demo:
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
    entry, held = closed.recordings[0].log_state["gyro"], closed.recordings[0].held_out
    pair = [
        attitude_error(log, p, np.array(entry["rotation"]), len(log.time) - held)
        for p in (closed.before, closed.after)
    ]
    closed.write(out, say=say)
    shown = Demo(closed, *pair)
    draw_before_and_after(shown, out / "heading.png")
    return shown


def draw_before_and_after(shown: Demo, path: Path) -> None:
    """Draw rate residual about the vertical and heading error, before and after, as a PNG.

    Both are on the held-out rows.
    """
    figure = Figure(figsize=(8.4, 3.0), layout="constrained", dpi=150)
    left, right = figure.subplots(1, 2)
    for name, colour, error in (
        ("before", "#e69f00", shown.before),
        ("after", "#0072b2", shown.after),
    ):
        for trace in shown.closed.exhibits["gyro"].traces:
            rate = np.rad2deg(getattr(trace, name)[:, 2])
            left.plot(trace.time, rate, color=colour, lw=0.8, label=name)
        right.plot(error.time, np.rad2deg(error.heading), color=colour, lw=1.4, label=name)
    left.set(
        xlabel="time [s]", ylabel="rate residual, z [deg/s]", title="gyro less model, held-out rows"
    )
    right.set(
        xlabel="time [s]", ylabel="heading error [deg]", title="attitude filter, held-out rows"
    )
    for panel in (left, right):
        panel.grid(alpha=0.3)
        panel.legend(frameon=False)
    with whole(path) as unfinished:
        figure.savefig(unfinished, format="png")
