"""What holds the position of a navigated log, in words."""

from __future__ import annotations

import numpy as np

from pyimu.ins.measured import measures_speed
from pyimu.ins.outcome import Outcome
from pyimu.ins.short_rests import SWUNG
from pyimu.recording.rest import rests
from pyimu.report.numbers import counted, number, quantity

LONG_REST = 3.0
"""s; a rest by the log's own noise that is worth a word."""

LONG, OFTEN = 5.0, 0.8
"""s without a rest are longer than any step; a leg swings in a good part of the time, so that this
quantile of the rates is that of a swing."""


def held(a: Outcome) -> str:
    """What the numbers mean: how much of the log rests, and what is known of its end."""
    others = _others(a)
    if a.zupt == "off":
        return _alone("Zero-velocity updates are off", "nothing holds the position", a, others)
    if not a.still.any():
        where = "The column stationary declares no rest" if a.declares_rests else "There is no rest"
        text = _alone(f"{where} in this log", "there was nothing to update with", a, others)
        return text + _of_its_own_noise(a)
    if a.still.all():
        return "The whole log is at rest: there is no path"
    share = f"{number(100 * float(a.still.mean()), 2)} % of the time"
    if not a.later_stops:
        why = f"There is no rest after that at the start ({share})"
        lost = f"for {quantity(a.longest_leg, 's')} there was nothing to update with"
        return _alone(why, lost, a, others) + _of_feet(a)
    stops = counted(len(a.later_stops), "time")
    return (
        f"It rests in {share}, {stops} after the start; the longest drive "
        f"between two rests takes {quantity(a.longest_leg, 's')}{_known(a)}{_of_feet(a)}"
    )


def _others(a: Outcome) -> str:
    """What else than rests holds the position, empty where nothing does."""
    stands = a.zupt == "foot"
    measured = "the foot's stances" if stands else "what it measured of position and velocity"
    found = [measured] if a.fixes is not None else []
    found += ["the measured speed"] if measures_speed(a.recording) else []
    found += ["the vehicle's constraint"] if a.nhc else []
    return " and ".join(found)


def _alone(why: str, lost: str, a: Outcome, others: str) -> str:
    """What a path without rests is worth, by ``others`` that hold it."""
    if others:
        return f"{why}: what holds the position is {others}{_known(a)}"
    std = _std(a)
    if std is None:
        return f"{why}, so {lost}: the position is integrated alone"
    return (
        f"{why}, so {lost}: the position is integrated alone, and its standard deviation has grown "
        f"to {quantity(std, 'm')} at the end, which is what it is worth"
    )


def _known(a: Outcome) -> str:
    """How well the end is known, where a method says."""
    std = _std(a)
    if std is None:
        return ""
    return f"; the standard deviation of the position at the end is {quantity(std, 'm')}"


def _std(a: Outcome) -> float | None:
    """m; of the last position in the plane, None of a path that has none."""
    if a.best is None or a.best.position_std is None:
        return None
    return float(np.linalg.norm(a.best.position_std[-1, :2]))


def _of_its_own_noise(a: Outcome) -> str:
    """Where a log rests that is judged by its own noise: the part's is then too small for it."""
    if a.zupt not in ("auto", "live") or a.declares_rests:
        return ""
    own = max((j - i for i, j in rests(a.recording)), default=0) * a.recording.sample_period
    if own < LONG_REST:
        return ""
    part = a.part or "the part"
    return (
        f". By its own noise it rests for {quantity(own, 's', 2)}: the noise of {part} is too "
        "small for it, is it another part?"
    )


def _of_feet(a: Outcome) -> str:
    """What a sensor on a foot needs, of a log without rests for long whose body swings."""
    size = np.linalg.norm(np.nan_to_num(a.recording.gyro), axis=1)
    swings = float(np.quantile(size, OFTEN)) > SWUNG
    if a.zupt not in ("auto", "live") or a.declares_rests or a.longest_leg < LONG or not swings:
        return ""
    return "; of a sensor on a foot, --zupt foot takes its stances as well"
