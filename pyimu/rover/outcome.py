"""What the test drives showed, as frozen data, and its form in report.json."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from pyimu.files import plain
from pyimu.identification.result import Closed
from pyimu.model.part import Part
from pyimu.rover.heading_noise import HeadingNoise, largest_walk, scale_factor_for
from pyimu.rover.paper import ANGLES, PaperDrive
from pyimu.units import convert

WALK_UNIT = "deg/h/sqrt(h)"


@dataclass(frozen=True, eq=False)
class Traces:
    """One drive with one noise: ``m`` instants of it, and the largest errors of all of it.

    ``time`` (m,) s; the rover drives from ``start`` to ``end`` s; ``reference`` (m, 3) deg is its
    heading, pitch and roll; ``errors`` (methods, m, 3) deg against it, the heading's set right at
    ``start``; ``largest`` (methods, 3) deg while it drives, ``largest_true`` (methods + 1, 3) the
    same against the truth, of the methods and then of the reference.
    """

    time: np.ndarray
    start: float
    end: float
    reference: np.ndarray = field(repr=False)
    errors: np.ndarray = field(repr=False)
    largest: np.ndarray = field(repr=False)
    largest_true: np.ndarray = field(repr=False)


@dataclass(frozen=True, eq=False)
class DriveRuns:
    """A drive with several noises.

    ``largest`` (seeds, methods, 3) deg and ``largest_true`` (seeds, methods + 1, 3) as in
    ``Traces``, which are those of the first seed; ``noise`` is what the declared noise makes of the
    heading, ``turned`` (m,) rad the angle turned at its instants.
    """

    paper: PaperDrive
    largest: np.ndarray
    largest_true: np.ndarray
    traces: Traces = field(repr=False)
    noise: HeadingNoise
    turned: np.ndarray = field(repr=False)

    @cached_property
    def allowed(self) -> dict[str, float | None]:
        """What the declared noise alone allows of the heading [deg], beside paper and target."""
        largest = np.rad2deg(self.noise.largest())
        paper, target = (np.deg2rad(x["heading"]) for x in (self.paper.paper, self.paper.target))
        walk = largest_walk(self.noise, paper)
        return {
            "duration": self.noise.duration,
            "std_at_end": float(np.rad2deg(self.noise.std(self.noise.duration))),
            "median": float(np.median(largest)),
            "p95": float(np.quantile(largest, 0.95)),
            "share_within_paper": self.noise.share_below(paper),
            "share_within_target": self.noise.share_below(target),
            "walk_for_paper": walk if walk < self.noise.K else None,
        }

    @property
    def turns(self) -> bool:
        """True where the drive turns far enough to show a scale factor."""
        return float(np.abs(self.turned).max()) > 1.0

    def with_scale(self, scale: float) -> np.ndarray:
        """Largest heading errors (draws,) in deg by the noise and a scale factor error."""
        return np.rad2deg(self.noise.largest(scale * self.turned))

    @cached_property
    def scale_for_paper(self) -> float:
        """Scale factor error with which the median of the largest error is the paper's."""
        return scale_factor_for(self.noise, self.turned, np.deg2rad(self.paper.paper["heading"]))


@dataclass(frozen=True, eq=False)
class RoverOutcome:
    """The test drives of a part: as declared, in truth, and as the loop found it."""

    known: Part
    true: Part
    found: Part
    methods: tuple[str, ...]
    seeds: tuple[int, ...]
    runs: tuple[DriveRuns, ...]
    closed: Closed

    def rows(self) -> Iterator[tuple[DriveRuns, int]]:
        """The rows of the table: a drive and a method."""
        return ((r, m) for r in self.runs for m in range(len(self.methods)))

    @property
    def scale(self) -> tuple[float, float]:
        """Scale factor error about the vertical: put in beyond what is declared, and found."""
        declared, true, found = (
            float(p.gyro.values.get("scale_factor", {}).get("s", np.zeros(3))[2])
            for p in (self.known, self.true, self.found)
        )
        return true - declared, found - declared

    def as_dict(self) -> dict[str, Any]:
        """The contents of report.json.

        ``table6`` has a row a drive and method: the median over the seeds of the largest error in
        deg against the optical reference, the least and the most of them, each of them, the median
        against the truth, the paper's figure and, for the last method, the target.
        """
        put_in, found = self.scale
        return plain(
            {
                "simulated": True,
                "part": self.known.name,
                "seeds": list(self.seeds),
                "table6": [self._row(r, m) for r, m in self.rows()],
                "heading_noise": [self._noise(r) for r in self.runs],
                "scale_factor": {
                    "axis": "z",
                    "unit": "1",
                    "put_in": put_in,
                    "found": found,
                    "for_paper": {r.paper.name: r.scale_for_paper for r in self.runs if r.turns},
                },
                "loop": {
                    "verdict": self.closed.verdict,
                    "reason": self.closed.reason,
                    "added": [a.as_dict() for a in self.closed.added],
                },
            }
        )

    def _row(self, r: DriveRuns, method: int) -> dict[str, Any]:
        own = method == len(self.methods) - 1
        return {
            "drive": r.paper.name,
            "method": self.methods[method],
            "unit": "deg",
            **_by_angle(np.median(r.largest[:, method], axis=0)),
            "least": _by_angle(r.largest[:, method].min(axis=0)),
            "most": _by_angle(r.largest[:, method].max(axis=0)),
            "each": _by_angle(r.largest[:, method].T),
            "against_truth": _by_angle(np.median(r.largest_true[:, method], axis=0)),
            "paper": dict(r.paper.paper),
            "target": dict(r.paper.target) if own else None,
        }

    @staticmethod
    def _noise(r: DriveRuns) -> dict[str, Any]:
        walk = {"walk_unit": "rad/s/sqrt(s)"}
        return {"drive": r.paper.name, "unit": "deg", **r.allowed, **walk}


def _by_angle(values: np.ndarray) -> Mapping[str, Any]:
    return dict(zip(ANGLES, values, strict=True))


def walk_in_people(value: float) -> float:
    """K of rad/s/sqrt(s) in the paper's unit."""
    return float(convert(value, "rad/s/sqrt(s)", WALK_UNIT))
