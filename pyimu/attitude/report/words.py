"""Sentences about a run of the attitude filter, for the terminal and the page."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from pyimu.attitude.error import AttitudeError, root_mean_square
from pyimu.attitude.filter.compensation import NOT_UNDONE
from pyimu.attitude.filters import OWN, UNUSED
from pyimu.attitude.heading_against_field import STEADY
from pyimu.attitude.magnetometer import Magnetometer
from pyimu.attitude.outcome import NIS_BOUNDS, Outcome
from pyimu.attitude.world_field import WorldField
from pyimu.errors import Finding
from pyimu.report.numbers import joined, number, quantity

ALIGNED = (
    "the reference's body axes are assumed to be the sensor's, and the heading is set right at "
    "its first row"
)

SMOOTHED = "each sample is smoothed by all of the log, also by what follows it"
"""Said of a smoothed attitude."""

MOSTLY = 0.5
"""Share of the samples from which on a disturbed field is said first."""

FREEDOM = "3 degrees of freedom, if accelerations are as accel_std"


def about(a: Outcome) -> str:
    """What was run over what."""
    seen = a.rest is not None and a.rest.seen
    other = a.rest is not None and a.rest.other_force is not None
    start = f"{a.rest.duration:.1f} s at rest" if seen else "in motion"
    if other:
        start = "still, under a force that is not gravity"
    part = f"part {a.part}" if a.part else "no part, noise as in the log"
    if a.method != OWN:
        part = f"filter {a.method}, {part}"
    smoothed = "; smoothed" if a.smoothed else ""
    return (
        f"{len(a.time):,} samples, {a.duration:.1f} s at {a.recording.sample_rate:.4g} Hz, starts "
        f"{start}; {part}{smoothed}"
    )


def notes(a: Outcome) -> list[str]:
    """What must be known before the figures are read."""
    found = []
    if a.smoothed:
        found.append(
            f"{SMOOTHED}; quasi-static, NIS, status and rests are those of the filter before that"
        )
    if a.left_in:
        found.append(f"left in, {NOT_UNDONE}: {joined(a.left_in)}")
    unused = [n for n in UNUSED.get(a.method, ()) if getattr(a.recording, n, None) is not None]
    if unused:
        found.append(f"the filter {a.method} uses no column {joined(unused)}")
    of_field = [_about_field(f) for f in a.magnetometer.findings]
    if a.magnetometer.used and a.magnetometer.is_uneven:
        of_field.append(_about_strength(a.magnetometer))
    if a.magnetometer.used and a.disturbed > MOSTLY:
        of_field.append(
            f"the magnetic field is disturbed in {a.disturbed:.1%} of the samples: iron near by or "
            "on board, no calibration, or axes of the magnetometer that are not the body's; the "
            "heading is by what is left, and may be off by more than its standard deviation, as "
            "that field need not be the place's"
        )
    return found + _about_columns(a) + of_field


def _about_strength(m: Magnetometer) -> str:
    return (
        f"the strength of the magnetic field differs by {quantity(m.scatter, 'T')} from sample to "
        f"sample, {m.scatter / m.strength:.0%} of it: no calibration, or iron near by or on board; "
        "the heading is believed accordingly less. pyimu characterize calibrates a magnetometer by "
        "a log that turns all round"
    )


READ_AS = {
    "compass": "they count clockwise, as a compass does: write 90 deg less the compass heading, or "
    'map the log with [frame] world = "ned"',
    "degrees": "their numbers are degrees: write heading [deg] in the log's header, or map it "
    "there with --columns",
}
"""What to do about headings that are something else than their header says."""

ALONE = {"heading_std": "heading", "heading_age": "heading", "speed_std": "speed"}
"""Columns that say nothing without another."""


def _about_columns(a: Outcome) -> list[str]:
    """What is wrong with the columns beside the gyro, and what would be right."""
    found, kinds, there = [], {f.kind: f for f in a.findings}, a.recording.groups
    if "accel" not in there:
        found.append(
            "no accelerometer (accel_x, accel_y, accel_z): nothing shows the vertical; roll and "
            "pitch are the gyro's alone, from a level start, and drift with it"
        )
    if "gravity_down" in kinds:
        found.append(
            "gravity lies on -z at rest: the body is upside down; or its axes are not "
            'forward-left-up, and a column map says [frame] body = "frd"; or the accelerometer has '
            "the other sign, as iOS does"
        )
    if "gravity_off" in kinds:
        off = kinds["gravity_off"].detail
        found.append(
            f"gravity at rest is {number(off['magnitude'])} m/s^2, {off['share']:+.1%} off: a "
            "scale factor, a bias, or another unit of the accelerometer; the tilt is less sure by "
            "that"
        )
    if "even_turn" in kinds:
        found.append(_about_even_turn(kinds["even_turn"]))
    if "gyro_drifts" in kinds:
        found.append(_about_drift(kinds["gyro_drifts"]))
    found += about_contradicted(a.findings)
    if "heading_late" in kinds:
        found.append(_about_late(kinds["heading_late"]))
    if "heading_against_field" in kinds:
        differ, declination = kinds["heading_against_field"], a.parameters.get("declination", 0.0)
        found.append(_about_field_and_headings(differ, declination))
    for name, of in ALONE.items():
        if name in there and of not in there:
            found.append(f"the column {name} has no column {of} beside it, and was not used")
    return found


def about_contradicted(findings: Iterable[Finding]) -> list[str]:
    """What ``contradicted`` finds, and what would be right."""
    kinds = {f.kind: f for f in findings}
    found = [_about_gyro(kinds[k]) for k in ("gyro_unit", "gyro_axes") if k in kinds]
    if "speed_sign" in kinds:
        found.append(
            "the forces say that the speed has the wrong sign, or is not along the body's x axis: "
            "it was not used; turn its sign, or the axes"
        )
    if "speed_axis" in kinds:
        angle = np.degrees(float(kinds["speed_axis"].detail["angle"]))
        found.append(
            f"the forces say that the body drives {abs(angle):.0f} deg to the "
            f"{'left' if angle > 0 else 'right'} of its x axis: the speed was not used; write gyro "
            "and accelerometer in axes whose x is forward, in the log or with --columns ([frame] "
            "body)"
        )
    if "speed_unit" in kinds:
        found.append(_about_speed(kinds["speed_unit"]))
    if "heading_reading" in kinds:
        kind = str(kinds["heading_reading"].detail["as"])
        what = "; ".join(text for name, text in READ_AS.items() if name in kind)
        found.append(f"the headings do not turn as the gyro does, and were not used: {what}")
    return found


def _about_field_and_headings(finding: Finding, declination: float) -> str:
    """By how much headings and magnetometer differ, and what that may be."""
    angle, std, scatter = np.degrees(
        [float(finding.detail[n]) for n in ("angle", "std", "scatter")]
    )
    differ = f"the headings count {angle:+.1f} ± {std:.1f} deg against the magnetometer"
    if scatter > np.degrees(STEADY):
        return f"{differ}, and not the same all the time: iron near by, or a wrong heading"
    if declination:
        return f"{differ}, all the time: one of the two is mounted askew, or needs a calibration"
    return (
        f"{differ}, all the time: a declination of {-angle:.1f} deg would do that, which "
        "--declination tells; else one of the two is mounted askew, or needs a calibration"
    )


def _about_late(finding: Finding) -> str:
    """By how much the headings are late, which no column says."""
    lag, std = (float(finding.detail[n]) for n in ("lag", "std"))
    return (
        f"the headings are {lag:.3f} ± {std:.3f} s late by the gyro's turns, and were taken so; "
        "a column heading_age [s] says how late they are where that is known"
    )


def _about_gyro(finding: Finding) -> str:
    """What gravity or the reference say of the gyro, and what would be right."""
    if finding.kind == "gyro_axes":
        return (
            "gravity does not turn in the body as the gyro says, but as if the right axes of the "
            f"gyro were others of its columns ({finding.detail['axes']}); or those of the "
            "accelerometer are the wrong ones: put their names and signs right, in the log or with "
            "--columns"
        )
    factor = float(finding.detail["factor"])
    if factor > 1:
        stated, right, off = "rad/s", "deg/s", "large"
    else:
        stated, right, off = "deg/s", "rad/s", "small"
    return (
        f"the gyro's rates are {number(max(factor, 1 / factor))} times too {off}, by how gravity "
        f"or the reference turns: numbers in {right} under a header of {stated} look so, or "
        f"converted twice; write gyro_x [{right}] in the log's header, or map it there with "
        "--columns"
    )


def _about_drift(finding: Finding) -> str:
    """What a gyro that warms up means for the estimate."""
    by = quantity(finding.detail["in_a_minute"], "rad/s")
    return (
        f"the gyro's bias is another from rest to rest, by some {by} in a minute at the start: "
        "more than its part accounts for, as of a gyro that warms up; the standard deviations have "
        "it"
    )


def _about_even_turn(finding: Finding) -> str:
    """What the other rests of a log say of the first."""
    turn, std = (np.degrees(finding.detail[name]) for name in ("turn", "std"))
    if turn:
        return (
            f"the body turned evenly by {number(turn)} deg/s about the vertical where it seems to "
            "rest at the start: the gyro's bias is that of the later rests, which are alike"
        )
    return (
        "the body turns evenly about the vertical at the start or later, and no gyro tells which "
        f"is its rest: the bias is unsure by {number(std)} deg/s and no rest is used; a column "
        "stationary tells, or headings"
    )


def _about_speed(finding: Finding) -> str:
    """By which factor the forces say that the speed is off, and the unit that has it."""
    factor, read = float(finding.detail["factor"]), finding.detail["as"]
    size = f"{number(max(factor, 1 / factor))} times too {'large' if factor > 1 else 'small'}"
    looks = f": numbers in {read} look so; write that unit in the header, or" if read else "; write"
    return f"the forces say that the speed is {size}, and it was not used{looks} speed in m/s"


def _about_field(finding: Finding) -> str:
    """What a finding about the magnetometer means to the heading."""
    detail = finding.detail
    if finding.kind == "mag_zeros":
        return "the magnetometer shows zeros alone, and was not used"
    if finding.kind == "mag_missing":
        return "the magnetometer has no sample, and was not used"
    if finding.kind == "mag_axis_missing":
        return f"the magnetometer's axis {detail['axes']} shows zeros alone: it was not used"
    if finding.kind == "mag_axes":
        return (
            "the magnetic field does not turn in the body as the gyro says, but as if the right "
            f"axes of the magnetometer were others of its columns ({detail['axes']}): it was not "
            "used; put their names and signs right, in the log or with --columns (of the gyro, "
            "where the body turns about one axis alone: its sign there looks the same)"
        )
    if finding.kind == "mag_not_of_the_place":
        return (
            f"the magnetometer shows a field of {number(1e6 * detail['strength'])} uT where the "
            f"World Magnetic Model has {number(1e6 * detail['model'])} uT: iron is near, or it is "
            "not calibrated; where it shows that lastingly, the log's own strength and dip are "
            "taken"
        )
    shown = (
        f"the magnetometer shows a field of {quantity(detail['strength'], 'T')}, the Earth's has "
        "22 to 67 uT: it was not used"
    )
    if finding.kind == "mag_strength":
        return shown
    return (
        f"{shown}; numbers in {detail['as']} under a header of {detail['stated']} look so: write "
        f"mag_x [{detail['as']}] in the log's header, or map it there with --columns"
    )


def heading_from(a: Outcome) -> str:
    """What told the heading beside the gyro."""
    if not a.magnetometer.used:
        return ""
    headings = getattr(a.recording, "heading", None) is not None
    headings &= not any(f.kind == "heading_reading" for f in a.findings)
    start = ", beside the headings, by which it starts" if headings else ""
    undone = ", calibrated" if a.magnetometer.calibration is not None else ""
    place = _place_of(a.magnetometer.world)
    return (
        f"magnetometer{undone}{start}{place}; field disturbed in {a.disturbed:.1%} of the samples, "
        f"median strength {number(1e6 * a.magnetometer.strength)} uT"
    )


def _place_of(world: WorldField | None) -> str:
    """What is known of the field beforehand."""
    if world is None:
        return ""
    declination, declination_std, dip, dip_std = np.degrees(
        [world.declination, world.declination_std, world.dip, world.dip_std]
    )
    return (
        f", against true north by {world.model} (declination {declination:.2f} ± "
        f"{declination_std:.2f} deg, strength {1e6 * world.strength:.2f} ± "
        f"{1e6 * world.strength_std:.2f} uT, dip {dip:.2f} ± {dip_std:.2f} deg)"
    )


def last_attitude(a: Outcome) -> str:
    roll, pitch, yaw = np.degrees(a.euler[-1])
    std = ", ".join(f"{s:.2f}" for s in np.degrees(a.std[-1, :3]))
    return (
        f"roll {roll:z.2f}, pitch {pitch:z.2f}, yaw {yaw:z.2f} deg; std {std} deg (body x, y, z), "
        f"of the heading {np.degrees(a.heading_std[-1]):.2f} deg"
    )


def last_bias(a: Outcome) -> str:
    pairs = np.degrees([a.gyro_bias[-1], a.std[-1, 3:]]).T
    return f"{', '.join(f'{b:z.4f} ± {s:.4f}' for b, s in pairs)} deg/s"


def gravity_used(a: Outcome) -> str:
    """How often gravity was used, and how well it fitted."""
    text, nis = f"{np.mean(a.quasi_static):.1%} of the samples", a.nis[a.updates]
    if not len(nis):
        return text
    low, high = NIS_BOUNDS
    return (
        f"{text}, mean NIS {nis.mean():.3g} ({FREEDOM}), {nis_inside(a):.1%} within their 95 % "
        f"bounds {low:.3g} to {high:.3g}"
    )


def nis_inside(a: Outcome) -> float:
    """Share of the normalised innovations squared within their bounds."""
    nis, (low, high) = a.nis[a.updates], NIS_BOUNDS
    return float(np.mean((nis >= low) & (nis <= high))) if len(nis) else float("nan")


def error_sizes(error: AttitudeError) -> dict[str, tuple[float, float]]:
    """RMS and 95 % [rad] of the error's inclination, of all of it and of its heading, by name."""
    sides = {"inclination": error.inclination, "total": error.total, "heading": error.heading}
    return {n: (root_mean_square(v), float(np.percentile(np.abs(v), 95))) for n, v in sides.items()}


def reference_words(a: Outcome) -> str:
    """What the reference seems to be that its columns do not say; nothing where they fit."""
    found = next((f for f in a.findings if f.kind == "reference_order"), None)
    if found is None:
        return ""
    return (
        f"that is the reference's: read as {found.detail['as']}, ref_q is "
        f"{number(np.degrees(found.detail['rms']))} deg RMS off; put its columns right, or map "
        "them with --columns"
    )


def claimed_inclination(a: Outcome) -> float:
    """Root mean square [rad] of the inclination that the standard deviations claim, over the rows
    of the error. Of a heading that is set right at the first row they claim nothing.
    """
    return root_mean_square(np.sqrt(2) * a.tilt_std[np.isin(a.time, a.error.time)])


def error_words(a: Outcome) -> str:
    """The error against the reference in a line."""
    sizes = []
    for name, (rms, most) in error_sizes(a.error).items():
        claimed = f" ({_degrees(claimed_inclination(a))} claimed)" * (name == "inclination")
        sizes.append(f"{name} {_degrees(rms)} deg RMS{claimed}, 95 % below {_degrees(most)} deg")
    return f"{'; '.join(sizes)} ({len(a.error.time):,} rows; {ALIGNED})"


def _degrees(angle: float) -> str:
    return number(np.degrees(angle))
