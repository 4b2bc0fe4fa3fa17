"""What was taken out of the clocks and lags of the logs' references, in words."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

import numpy as np

from pyimu.errors import Finding
from pyimu.identification.errors.held_out import clock_of
from pyimu.identification.fit.clock import Clock
from pyimu.identification.fit.trial import Trial
from pyimu.identification.reference.scales import POSITIONS_SCALE
from pyimu.identification.search.investigation import Investigation
from pyimu.recording.reference.play import OF_JOINT, PLAY
from pyimu.recording.reference.unfiltered_places import LATE, SIDEWAYS
from pyimu.recording.reference.unlagged import ADAPTS, HIGHEST, LAG
from pyimu.recording.reference.unsmoothed import SMOOTHED
from pyimu.report.numbers import joined, number, quantity, with_limits

FEW = 3
"""Up to so many logs are said each by itself."""

OR_SENSOR = (
    "; the reference has a clock of its own, and whether that is early or the sensor late "
    "(time_delay) a single log does not tell: a second, with both started anew, would"
)
"""What is said of a lag that one log shows beside a reference on another clock."""

NO_ERROR = ", and no error of the sensor"
"""What is said of a lag of any other clock."""

Heading = tuple[float, float] | None


def taken_out(found: Mapping[str, Investigation], heading: Heading) -> str:
    """What was wrong with the references' clocks, and what it was worth.

    Nothing where they are right, or where nobody can tell.
    """
    seen = {t.name: clock_of(inv, t.name) for inv, t in _trials(found)}
    clocks = {name: c for name, c in seen.items() if c is not None and c.taken_out}
    if not clocks:
        return ""
    if len(clocks) > FEW:
        most = max(float(np.abs(c.late).max()) for c in clocks.values())
        said = f"the clocks of {len(clocks)} references are off by up to {_time(most)}"
    else:
        said = joined([_off(name, clock) for name, clock in clocks.items()])
    whose = OR_SENSOR if any(c.or_sensor for c in clocks.values()) else NO_ERROR
    return f"{said}: taken out{whose}{_worth(heading)}"


def undone(findings: Sequence[Finding]) -> str:
    """Which references, or positions of them, were taken before a gear with play, lag as behind a
    filter, or were smoothed, which positions are late beside attitudes, or of another scale, and
    which have a vertical that is not z; nothing where none is.
    """
    by_kind = {
        (kind, what): [
            f.detail
            for f in findings
            if f.kind == kind and PLACES.get(f.column, "") == what and not _is_or_gain(f)
        ]
        for what in ("", *PLACES.values())
        for kind in SAID
    }
    said = " and ".join(SAID[kind](found, what) for (kind, what), found in by_kind.items() if found)
    return f"{said}: undone, and no error of the sensor" if said else ""


def or_gain(findings: Iterable[Finding]) -> str:
    """Which positions are of another scale, unless the accelerometer is; nothing where none is."""
    found = [f.detail for f in findings if _is_or_gain(f)]
    if not found:
        return ""
    return (
        f"{_scaled(found, PLACES['ref_east'])}, or the accelerometer's scale factors are off by as "
        "much, which a body that keeps level does not tell: neither is named; its six faces at "
        "rest would tell"
    )


def _is_or_gain(f: Finding) -> bool:
    return f.kind == POSITIONS_SCALE and f.detail["told"] == "no"


def _scaled(found: list[dict], what: str) -> str:
    most = max(found, key=lambda f: abs(f["factor"] - 1.0))
    up_to = "up to " if len(found) > 1 else ""
    size = with_limits(*(most[k] for k in ("factor", "low", "high")))
    return f"{_of(what, found)} are {up_to}{size} times as large as the way of the body"


def _lagging(lags: list[dict], what: str) -> str:
    slowest = max(lag["time_constant"] for lag in lags)
    cut_off = f"{number(1.0 / (2.0 * np.pi * slowest))} Hz ({_time(slowest)})"
    if len(lags) == 1 and not what:
        who = f"the reference of {lags[0]['recording']} lags as one"
        return f"{who} behind a low-pass filter of {cut_off} does"
    down_to = "down to " if len(lags) > 1 else ""
    return f"{_of(what, lags)} lag as those behind a low-pass filter of {down_to}{cut_off} do"


def _adapting(found: list[dict], what: str) -> str:
    most = max(found, key=lambda f: f["time_constant"])
    by, at = _time(most["time_constant"]), number(float(np.degrees(most["halves_at"])), 2)
    adapts = f"a filter that adapts: by {by} at rest and half of that at {at} deg/s"
    lags = "lags as one" if len(found) == 1 else "lag as those"
    return f"{_of(what, found)} {lags} behind {adapts}"


def _smooth(smoothed: list[dict], what: str) -> str:
    most = max(smoothed, key=lambda s: s["seconds"])
    below, are = number(most[HIGHEST]), "are" if what else "is"
    by = f"as by {most['filter']} {_time(most['seconds'])} and {are} used below {below} Hz"
    if len(smoothed) == 1:
        return f"{_of(what, smoothed)} {'were' if what else 'was'} smoothed {by}"
    those = "those" if what else "that"
    return f"{_of(what, smoothed)} were smoothed; {those} of {most['recording']} {by}"


def _before_play(found: list[dict], what: str) -> str:
    gears = "was taken before a gear" if len(found) == 1 else "were taken before gears"
    plays: dict[str, float] = {}
    for name, width in (item for f in found for item in f.items()):
        if name.endswith(OF_JOINT):
            joint = (
                name.removesuffix(OF_JOINT).replace("_", " ").replace("vertical", "the vertical")
            )
            plays[joint] = max(plays.get(joint, 0.0), width)
    up_to = "up to " if len(found) > 1 else ""
    about = [f"{up_to}{quantity(w, 'rad', 2)} about {name}" for name, w in plays.items()]
    return f"{_of(what, found)} {gears} with a play of {joined(about)}"


def _late(found: list[dict], what: str) -> str:
    most = max((f["late"] for f in found), key=abs)
    up_to, side = "up to " if len(found) > 1 else "", "late" if most > 0.0 else "early"
    return f"{_of(what, found)} are {up_to}{_time(abs(most))} {side} beside the attitudes"


def _sideways(found: list[dict], what: str) -> str:
    are = "is" if len(found) == 1 else "are"
    return f"{_of(what, found)} {are} in a world in which {found[0]['way']}"


def _of(what: str, found: list[dict]) -> str:
    """The references of findings, or the positions of these."""
    of = f"the {what} of " if what and len(found) == 1 else f"{what} of " if what else ""
    return of + (
        f"the reference of {found[0]['recording']}"
        if len(found) == 1
        else f"{len(found)} references"
    )


PLACES = {"ref_east": "positions", "ref_velocity": "velocities"}
"""By the columns of findings, what of a reference they are about, unless its attitudes or rates."""

SAID: dict[str, Callable[[list[dict], str], str]] = {
    PLAY: _before_play,
    LAG: _lagging,
    ADAPTS: _adapting,
    SMOOTHED: _smooth,
    LATE: _late,
    POSITIONS_SCALE: _scaled,
    SIDEWAYS: _sideways,
}
"""What is said of the findings of each kind."""


def _trials(found: Mapping[str, Investigation]) -> Iterable[tuple[Investigation, Trial]]:
    return ((inv, t) for inv in found.values() for t in (*inv.after.trials, *inv.held))


def _off(name: str, clock: Clock) -> str:
    whose = f"the reference of {name}"
    if clock.slips:
        times = len(clock.slips)
        often = "once" if times == 1 else f"{times} times"
        return (
            f"{whose} slips {often} by {_time(abs(clock.slips[0].size))}, its clock being "
            f"{ppm(clock)} off the sensor's"
        )
    if clock.skew is not None:
        return f"the clock of {whose} is {ppm(clock)} off the sensor's"
    least, most = float(clock.late.min()), float(clock.late.max())
    if not clock.keeps_step:
        return (
            f"the sensor shows the motion {_time(least)} to {_time(most)} later than {whose} says"
        )
    side = "later" if most > 0 else "earlier"
    return f"the sensor shows the motion {_time(abs(most))} {side} than {whose} says"


def ppm(clock: Clock) -> str:
    return f"{number(1e6 * abs(clock.skew[0]))} ppm" if clock.skew else ""


def _time(seconds: float) -> str:
    return f"{number(seconds)} s" if abs(seconds) >= 0.1 else f"{number(1e3 * seconds)} ms"


def _worth(heading: Heading) -> str:
    if heading is None or not heading[1] < heading[0]:
        return ""
    before, after = (number(float(np.degrees(v))) for v in heading)
    return f"; the heading's error on held-out rows falls from {before} to {after} deg with it"
