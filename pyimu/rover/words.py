"""What the test drives showed in sentences, and as lines for a terminal."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from pyimu.report.lines import in_columns
from pyimu.report.numbers import joined, number
from pyimu.rover.outcome import WALK_UNIT, DriveRuns, RoverOutcome, walk_in_people
from pyimu.rover.paper import ANGLES

MADE = (
    "The rover is simulated, so that the truth is known: RoverDrive, the sensor, the low-pass of "
    "10 Hz and the filter, at the sensor's rate. Errors are against an optical reference that is "
    "itself wrong by 0.1 to 0.2 deg, as the paper's was."
)

PAPERS_PART = "imt30"

HEAD = ("largest error [deg]", "", *ANGLES)

PAPER, TARGET, ALLOWED, REFERENCE, TRUTH = (
    "paper, table 6",
    "target with the loop closed",
    "the declared noise alone",
    "the reference itself",
    "the same against the truth",
)


def table(o: RoverOutcome) -> list[tuple[str, ...]]:
    """The table: a drive's figures in the paper, by each method, and what is allowed."""
    return [cells for r in o.runs for cells in _of_drive(o, r)]


def _of_drive(o: RoverOutcome, r: DriveRuns) -> Iterator[tuple[str, ...]]:
    yield r.paper.title, PAPER, *(f"{r.paper.paper[a]:g}" for a in ANGLES)
    for m, name in enumerate(o.methods):
        yield "", name, *_over_seeds(r.largest[:, m])
    yield "", TRUTH, *_over_seeds(r.largest_true[:, len(o.methods) - 1])
    yield "", REFERENCE, *_over_seeds(r.largest_true[:, -1])
    a = r.allowed
    yield "", ALLOWED, f"{number(a['median'], 2)} (95 %: {number(a['p95'], 2)})", "", ""
    yield "", TARGET, *(f"{r.paper.target[a]:g}" for a in ANGLES)


def _over_seeds(largest: np.ndarray) -> Iterator[str]:
    """Median, least and most (3,) of the largest errors (seeds, 3)."""
    for v in largest.T:
        middle, least, most = (number(float(f(v)), 2) for f in (np.median, np.min, np.max))
        yield f"{middle} ({least} to {most})"


def in_lines(o: RoverOutcome) -> str:
    """Table and findings for a terminal."""
    return "\n".join([MADE, "", *in_columns([HEAD, *table(o)]), "", *findings(o)])


def findings(o: RoverOutcome) -> list[str]:
    """What the table says."""
    return [*_scale(o), *(_allowed(r) for r in o.runs), *_contradictions(o), _tilt(o)]


def _scale(o: RoverOutcome) -> Iterator[str]:
    put_in, found = o.scale
    others = joined([n for a in o.closed.added for n in a.alternatives])
    yield (
        f"Scale factor about the vertical: {_percent(put_in)} put in, {_percent(found)} found by "
        f"the loop on turns on the spot that are in no row ({o.closed.verdict}"
        f"{f': {o.closed.reason}' if o.closed.reason else ''}"
        f"{f'; the data allow as well: {others}' if others else ''})."
    )
    for r in o.runs:
        if r.paper.name == "turn_on_spot":
            paper = r.paper.paper["heading"]
            yield (
                f"{_percent(-np.deg2rad(paper) / np.abs(r.turned).max())} makes the paper's "
                f"{paper:g} deg of a half turn; with the noise of this gyro, half of all such "
                f"turns reach it with {_percent(r.scale_for_paper)}."
            )


def _percent(value: float) -> str:
    return f"{number(100 * value)} %"


def _allowed(r: DriveRuns) -> str:
    a, target = r.allowed, r.paper.target["heading"]
    own = float(np.median(r.largest[:, -1, 0]))
    met = "meets" if own <= target else "misses"
    return (
        f"{r.paper.title.capitalize()}, {number(a['duration'])} s: our filter with the loop closed "
        f"{met} the target of {target:g} deg with a median of {number(own, 2)} deg over "
        f"{len(r.largest)} noises. Allowed by the "
        f"declared noise: median {number(a['median'], 2)} deg, 95 % {number(a['p95'], 2)} deg "
        f"(standard deviation at the end {number(a['std_at_end'], 2)} deg); with a perfect scale "
        f"factor {_share(a['share_within_target'])} of drives stay within the target."
    )


def _share(value: float) -> str:
    return f"{number(100 * value, 2)} %"


def _tilt(o: RoverOutcome) -> str:
    own, reference = (
        max(float(np.median(r.largest_true[:, m, 1:], axis=0).max()) for r in o.runs)
        for m in (-2, -1)
    )
    return (
        f"Pitch and roll of our filter are right to {number(own, 2)} deg (median of the largest "
        f"error of the worst drive, against the truth); the reference itself is up to "
        f"{number(reference, 2)} deg off, which is most of what the table shows of them."
    )


def _contradictions(o: RoverOutcome) -> Iterator[str]:
    """Where the paper's tables do not go together, if the sensor is the paper's."""
    if o.known.name != PAPERS_PART:
        return
    runs = {r.paper.name: r for r in o.runs}
    if "straight" in runs:
        yield from _straight(runs["straight"])
    if {"turn_on_spot", "ackermann"} <= set(runs):
        yield _turns(runs["turn_on_spot"], runs["ackermann"])


def _straight(r: DriveRuns) -> Iterator[str]:
    a, paper, walk = r.allowed, r.paper.paper["heading"], r.allowed["walk_for_paper"]
    if walk is not None:
        share = a["share_within_paper"]
        yield (
            f"Table 6 prints {paper:g} deg for the straight lines. The declared noise alone leaves "
            f"{_share(share)} of such drives within it, and {_share(share**2)} of pairs of drives "
            "(the table has one column for both lines). For half of the drives K would have to be "
            f"{number(walk_in_people(walk), 2)} {WALK_UNIT} where "
            f"{number(walk_in_people(r.noise.K))} is declared: of the paper's IMT30 tables 4 and 6 "
            "contradict each other."
        )


def _turns(spot: DriveRuns, arc: DriveRuns) -> str:
    scale, paper = spot.scale_for_paper, arc.paper.paper["heading"]
    largest = arc.with_scale(scale)
    within = _share(float(np.mean(largest <= paper)))
    return (
        "Both turns are of 180 deg, so that one scale factor gives both the same error: with the "
        f"{_percent(scale)} of the turn on the spot Ackermann steering has a median of "
        f"{number(float(np.median(largest)), 2)} deg, and {within} of drives are within the "
        f"{paper:g} deg that table 6 prints. The two figures contradict each other unless the "
        "scale factor changes with the rate of turn: 1.15 deg/s on the spot, 0.46 in the arc."
    )
