"""A navigated recording in words."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from pyimu.attitude.report.words import about_contradicted
from pyimu.errors import Finding
from pyimu.ins.filter.variables import STATUS_NAMES
from pyimu.ins.measured import CONTRADICTED
from pyimu.ins.outcome import Outcome
from pyimu.ins.report.held import held
from pyimu.ins.report.rests import (
    FIXES,
    creeps,
    in_doubt,
    on_a_foot,
    steady,
    unsure,
    witnessed,
    wrong_rest,
)
from pyimu.ins.too_sure import WRONG_REST
from pyimu.report.findings import in_line
from pyimu.report.numbers import counted, number, quantity

TITLES = {
    "paper": "Wongwirat 2010, as printed",
    "strapdown": "integrated exactly, nulls of the rest",
    "filter": "filter",
    "smoother": "smoothed by the whole log",
}

MOSTLY = 0.5
"""Share of the samples of rests beyond which these are none, if they contradict the estimate."""

UNTOLD = (
    "without a part the sensor's noise is that of its rest, and its scale factors and axes are "
    "those of a consumer part; --part, or the model.toml of pyimu close, says what they are"
)

UNSEEN = 1
"""Bit of the status of samples that are missing."""

OBSERVABLE = (
    "Yaw cannot be seen from zero velocities: between two headings it is the integral of the gyro, "
    "and its error turns the path about the start"
)


def about(a: Outcome) -> str:
    moves = any(f.kind == "no_rest" for f in a.findings) and not _of_later_rest(a.settings)
    part = f"part {a.part}" if a.part else f"noise of the log's own {'start' if moves else 'rest'}"
    more = f", {a.gains} scale factors and misalignments estimated" if a.gains else ""
    constraint = ", vehicle's constraint" if a.nhc else ""
    constraint += f"; heading at the start by {a.heading_from}" if a.heading_from else ""
    return (
        f"{len(a.time):,} samples, {quantity(a.duration, 's')} at "
        f"{a.recording.sample_rate:.4g} Hz, {part}{more}{constraint}"
    )


def _of_later_rest(settings: Mapping[str, float]) -> bool:
    """Whether the bias with which a log in motion was begun is that of a rest later on."""
    return any(settings.get(f"gyro_bias0[{i}]", 0.0) for i in (1, 2, 3))


def _in_motion_at_first(settings: Mapping[str, float]) -> str:
    """What a log that begins in motion was begun with."""
    if _of_later_rest(settings):
        return (
            "There is no rest at the start: the gyro's bias there is that of a later rest, and the "
            "tilt follows from the forces after it, so that its standard deviation is wide; some "
            "seconds of rest before the drive would tell them"
        )
    return (
        "There is no rest at the start: tilt and biases were not known when the drive began, "
        "and the standard deviations are wide for that reason; some seconds of rest before it "
        "would tell them"
    )


def notes(a: Outcome) -> list[str]:
    """What should be known first: where there is nothing to update with, and what was refused."""
    out = [held(a), *on_a_foot(a), *witnessed(a), *in_doubt(a), *unsure(a), *creeps(a)]
    kinds = {f.kind: f for f in a.findings}
    out += [text[0].upper() + text[1:] for text in about_contradicted(a.findings)]
    if "no_rest" in kinds:
        out.append(_in_motion_at_first(a.settings))
    if "constraint" in kinds:
        lost = np.any(a.filter.scalar("status").astype(int) & UNSEEN)
        out.append(_constraint(kinds["constraint"], bool(lost)))
    if "shakes_at_rest" in kinds:
        size = kinds["shakes_at_rest"].detail
        out.append(
            f"Something shakes the sensor at rest by {number(size['force'], 2)} m/s^2 and "
            f"{number(np.degrees(size['rate']), 2)} deg/s, as an engine does: rests were told by "
            "its motion without that"
        )
    if "gravity_off" in kinds:
        off = kinds["gravity_off"].detail
        out.append(
            f"The force at rest is {number(off['magnitude'], 4)} m/s^2, {off['share']:+.1%} of "
            "gravity off: a scale factor, a bias, or a unit"
        )
    out += steady(a)
    out += [
        f"{counted(f.count, 'sample')} of {f.column} that no motion makes "
        f"{'was' if f.count == 1 else 'were'} left out, the first at {f.detail['first']:.6g} s"
        for f in a.findings
        if f.kind == "outliers"
    ]
    out += _of_samples(kinds)
    if "coning" in kinds:
        detail = kinds["coning"].detail
        out.append(
            f"Up to {np.degrees(detail['turn']):.3g} deg of turn lie between two samples (at "
            f"{detail['at']:.6g} s): the sample rate is too low for the turn rate, or the unit of "
            "gyro or time is another than in its header"
        )
    out += [*_gaps(a), *_fixes(a)]
    for f in a.findings:
        if f.kind == "not_integrated":
            out.append(f"The method {f.detail['method']} was left out: {f.detail['reason']}")
    if abs(a.settings.get("latitude", 9.0)) > np.pi / 2:
        out.append(
            "No latitude: the Earth's rate was not taken off, which a rest hides in the gyro bias "
            "until the body turns"
        )
    out += [*_status(a), *_too_sure(a)]
    return [*out, OBSERVABLE] if a.later_stops else out


def _constraint(f: Finding, lost: bool) -> str:
    angle = abs(np.degrees(f.detail["along"]))
    if np.isfinite(angle):
        side = "left" if f.detail["along"] > 0 else "right"
        return (
            f"Without the vehicle's constraint the body moves {angle:.0f} deg to the {side} of x: "
            "its axes are not forward-left-up, which a column map's [frame] says, and what comes "
            "out is not to be relied on; --nhc is for a vehicle that drives along x"
        )
    why = "is it a vehicle, and are the axes forward-left-up?"
    return (
        f"{f.detail['share']:.0%} of the drive contradicts the vehicle's constraint, and what "
        "comes out is not to be relied on: "
        + ("the attitude was lost where samples are missing" if lost else why)
    )


def _gaps(a: Outcome) -> Iterator[str]:
    found = [(a.time[b] - a.time[b - 1], a.time[b - 1]) for _, b in a.recording.segments[:-1]]
    if found:
        longest, start = max(found)
        yield (
            f"No samples for up to {quantity(longest, 's')} (from {start:.6g} s; "
            f"{counted(len(found), 'gap')}): the standard deviations are wider by what a robot of "
            f"at most {a.settings['top_speed']:g} m/s may have done meanwhile (--top-speed)"
        )


def _of_samples(kinds: dict[str, Finding]) -> Iterator[str]:
    """What a finding of each kind says of gyro, accelerometer and reference."""
    if (f := kinds.get("leaning")) is not None:
        yield (
            f"Gravity is on {f.detail['axis']} at rest: the body lies on its side, or its axes are "
            "not forward-left-up, which a column map's [frame] says"
        )
    if (f := kinds.get("reference_jump")) is not None:
        yield (
            f"The reference jumps by {number(f.detail['largest'])} m at {f.detail['first']:.6g} s "
            f"({counted(f.count, 'time')}): the errors beside it are the reference's own"
        )
    if (f := kinds.get("reference_scale")) is not None:
        yield (
            f"The reference's path is {number(f.detail['factor'])} times as large as the "
            f"estimate's and of its shape ({number(f.detail['after'])} m from it in that size, not "
            f"{number(f.detail['before'])} m): is it in another unit than m?"
        )
    if (f := kinds.get("reference_frame")) is not None:
        mirrored = "mirrored and " if f.detail["mirrored"] else ""
        yield (
            f"The reference {mirrored}turned by {np.degrees(f.detail['turn']):.3g} deg would be "
            f"{number(f.detail['after'])} m from the path, not {number(f.detail['before'])} m: is "
            "it in another frame than east-north-up, or the heading at the start another?"
        )


def _fixes(a: Outcome) -> Iterator[str]:
    for f in a.findings:
        if f.kind == "lasting_fixes":
            yield (
                "The errors of the measured positions last, as a receiver's do, or their claimed "
                "standard deviation is too large: from one to the next they change by less. "
                f"Errors of {quantity(f.detail['std'], 'm')} that are forgotten in "
                f"{quantity(f.detail['time'], 's')} were estimated beside new ones of "
                f"{quantity(f.detail['new'], 'm')} each time"
            )
        if f.kind == "crabbing":
            yield (
                "The vehicle crabs: by the measured positions it moves askew to its axis by "
                f"{quantity(np.degrees(f.detail['std']), 'deg')} (1 std), which lasts for "
                f"{quantity(f.detail['time'], 's')}; the constraint claims no more than that"
            )
        if f.kind not in FIXES:
            continue
        stands = a.zupt == "foot" and f.column == "velocity"
        what = "moments of stance" if stands else f"measured {f.column} samples"
        text = f"{f.detail['of']:,} {what} correct the filter"
        nis = a.mean_nis(f"{f.column}_nis")
        if nis is not None:
            text += f", mean NIS {number(nis)}"
        if f.count:
            text += (
                f"; {f.count:,} of them ({f.detail['share']:.2%}, the first at "
                f"{f.detail['first']:.6g} s) contradicted it and were weighed down: a jump, "
                "another frame, or a standard deviation that is too small"
            )
        yield text


def _status(a: Outcome) -> Iterator[str]:
    status = a.filter.scalar("status").astype(int)
    for bit, text in STATUS_NAMES.items():
        if bit in CONTRADICTED.values():
            continue
        rows = np.flatnonzero(status & bit)
        if len(rows):
            where = f"{counted(len(rows), 'sample')}, the first at {a.time[rows[0]]:.6g} s"
            text = f"{text[0].upper()}{text[1:]} ({where})"
            yield text if bit != WRONG_REST else text + wrong_rest(a)


def _too_sure(a: Outcome) -> Iterator[str]:
    """Where the log itself shows that the standard deviations are too small."""
    wrong = a.filter.scalar("status").astype(int) & WRONG_REST > 0
    if np.count_nonzero(wrong & a.still) > MOSTLY * np.count_nonzero(a.still):
        yield (
            "Most of what was taken for rest contradicts the estimate: it is none, and neither the "
            "path nor its standard deviations are to be relied on"
        )
        return
    if a.too_sure == 1.0:
        return
    lacking = "" if a.part else f": {UNTOLD}"
    off = f"at the end of the drives the velocity was off by {number(a.too_sure, 2)} times what "
    if a.fixes is not None:
        yield f"The standard deviations are too small: {off}they say{lacking}"
        return
    yield (
        f"The standard deviations are {number(a.too_sure, 2)} times as large as the noise makes "
        f"them: {off}it explains{lacking}"
    )


def ends(a: Outcome) -> Iterator[tuple[str, str]]:
    """Where each method ends, with the standard deviation of those that know it."""
    for name, track in a.tracks.items():
        place = ", ".join(number(v) for v in track.position[-1])
        std = track.position_std
        more = ""
        if std is not None:
            more = f" ± {', '.join(number(v) for v in 2 * std[-1])}"
        yield name, f"{place}{more} m"


def error_words(a: Outcome) -> Iterator[tuple[str, str]]:
    """Errors against the reference in a line each."""
    for name, e in a.errors.items():
        yaw = "" if not np.isfinite(e.yaw) else f", yaw at the end {np.degrees(e.yaw):.3g} deg"
        share = f" ({number(100 * e.end / e.length, 2)} % of the way)" if e.length > 0.1 else ""
        yield (
            name,
            (
                f"at the end {number(e.end)} m{share}, "
                f"RMS {number(e.rms)} m, largest {number(e.most)} m{yaw}"
            ),
        )


def consistency(a: Outcome) -> str | None:
    """The normalised innovations of the first zero velocities, None without later stops."""
    first = a.first_zupts
    if not len(first):
        return None
    zaru = a.mean_nis("zaru_nis")
    text = (
        f"first zero velocity of each stop: mean NIS {number(float(first.mean()))} over "
        f"{counted(len(first), 'stop')}"
    )
    return (
        text if zaru is None else f"{text}; zero turn rates: {number(zaru)} (3 is right for both)"
    )


def _of_log(a: Outcome) -> Iterator[Finding]:
    """What the terminal says of the log below the notes."""
    yield from a.recording.findings
    yield from (f for f in a.findings if f.kind == "rate_of_part")


def in_lines(a: Outcome) -> str:
    """The report for a terminal."""
    lines = [f"{a.name}: {about(a)}"]
    lines += [f"  note        {text}" for text in notes(a)]
    lines += [
        f"  end         {name:10s} {text} (east, north, up; ± 2 std)" for name, text in ends(a)
    ]
    lines += [f"  error       {name:10s} {text}" for name, text in error_words(a)]
    if (text := consistency(a)) is not None:
        lines.append(f"  consistency {text}")
    lines += [f"  log         {text}" for text in in_line(_of_log(a))]
    return "\n".join(lines)
