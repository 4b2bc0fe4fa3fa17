"""What a campaign says in a few words: for a terminal and as notes of its page."""

from __future__ import annotations

import numpy as np

from pyimu.report.numbers import joined, number
from pyimu.rover.campaign.faults import NONE
from pyimu.rover.campaign.score import ANGLES
from pyimu.rover.campaign.sensitivity import LEAST, LEVEL, Index
from pyimu.rover.campaign.summary import CLAIM, TARGETS, Share, Summary, explained

LISTED = 3
"""Causes that are named in a line."""


def degrees(value: float) -> str:
    """rad as degrees with three figures."""
    return number(float(np.rad2deg(value)))


def share(s: Share) -> str:
    """A share in percent with its interval."""
    low, high = s.interval
    return f"{s.value:.1%} ({low:.1%} to {high:.1%})"


def plain_name(column: str) -> str:
    """The name of a column without its unit."""
    return column.partition(" [")[0]


def lines(s: Summary) -> list[str]:
    """The summary in lines: errors, the claim, honesty, causes."""
    out = []
    if s.sound.any():
        for name in reversed(ANGLES):
            half, most = (s.quantiles(f"{name}_error_max [rad]")[i] for i in (0, 2))
            out.append(
                f"largest {name} error: {degrees(half.value)} deg in half of the runs, below "
                f"{degrees(most.value)} deg in 95 %"
            )
        out += [claim(s, kind) for kind in ("end", "max")]
        out += [honesty(s, name) for name in ("attitude", "heading", "bias")]
        out += [cause(s, name) for name in TARGETS]
    faults = [name for name in s.fault_names if name != NONE]
    if faults:
        out.append(f"runs with a fault ({joined(faults)}) are listed by themselves in the report")
    return out


def claim(s: Summary, kind: str) -> str:
    """Which share of the runs is within the claim, at their end or always."""
    when = {"end": "at the end", "max": "all the time"}[kind]
    return (
        f"heading, pitch and roll within {degrees(CLAIM)} deg {when}: {share(s.within(kind))} of "
        f"the runs"
    )


def honesty(s: Summary, name: str) -> str:
    """Whether the filter is as good as it says."""
    h = s.honesty(name)
    low, high = h.bounds
    verdict = "within" if low <= h.mean <= high else "above" if h.mean > high else "below"
    return (
        f"normalised {name} error squared at the end: {number(h.mean)} in the mean, {verdict} the "
        f"{number(low)} to {number(high)} of a filter that is as good as it says "
        f"({share(h.inside)} of the runs inside {LEVEL:.0%} bounds of one)"
    )


def cause(s: Summary, target: str) -> str:
    """The parameters that drive an error."""
    found, angle = s.causes[target], plain_name(target).removesuffix("_error_max")
    what = f"what drives the largest {angle} error:"
    if not found:
        few = int(s.sound.sum()) < LEAST
        return f"{what} {f'not said of less than {LEAST} runs' if few else 'nothing is varied'}"
    named = [i for i in found if i.value > s.chance][:LISTED]
    if not named:
        return f"{what} no parameter beyond chance; noise, start and what acts together"
    return (
        f"{what} {joined([factor(i) for i in named])} of its variance; all parameters one by one "
        f"{explained(found):.0%}"
    )


def factor(i: Index) -> str:
    """A parameter with its index."""
    return f"{plain_name(i.factor)} {i.value:.0%} ({i.low:.0%} to {i.high:.0%})"
