"""What a campaign is: everything but the number that a run is a function of."""

from __future__ import annotations

import hashlib
import json
import math
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from pyimu.block.variables import seed_of
from pyimu.errors import UserError
from pyimu.model.part import Part
from pyimu.model.part_writer import format_part
from pyimu.plant.bodies import BODIES
from pyimu.plant.low_pass import CUTOFF
from pyimu.rover.campaign.faults import FAULTS, NEEDS_HEADING
from pyimu.rover.campaign.motion import DRIVES, SOL
from pyimu.units import did_you_mean

FORMAT = 1
"""Number of what a run makes of its settings; a change of that is another campaign."""

SOL_RATE = 5.0
"""Hz at which a sol is simulated: see docs/campaign.md for what does not depend on it."""

PER_CUTOFF = 10
"""Samples of the filter in a period of the cut-off frequency, at least. A Butterworth low-pass of
second order lets a hundredth through of what is folded down there."""


@dataclass(frozen=True)
class Settings:
    """A campaign of a ``part`` on a ``drive``, a name in ``DRIVES``.

    ``seed`` begins all draws. With ``specimens`` each run has a part of its own, else the nominal
    one; None is with, where the part has tolerances. ``faults`` are names in ``FAULTS``: a run has
    one of them or none, each as likely. ``terrains`` is how many grounds there are. ``rate`` Hz is
    that of the sensors; None is the part's, and of a sol ``SOL_RATE``. ``body`` is a name in
    ``BODIES``; None is the Earth, and of a sol Mars. Every ``heading_every`` s, 0 for never, there
    is a heading, of a standard deviation of ``heading_std`` rad.

    Raises UserError for a value that is none.
    """

    part: Part
    drive: str = "turn-on-spot"
    seed: int = 0
    specimens: bool | None = None
    faults: tuple[str, ...] = ()
    terrains: int = 4
    rate: float | None = None
    body: str | None = None
    heading_every: float = 0.0
    heading_std: float = float(np.deg2rad(0.5))

    def __post_init__(self) -> None:
        _known("drive", self.drive, DRIVES)
        for name in self.faults:
            _known("fault", name, FAULTS)
        _known("body", self.on, BODIES)
        seed_of(self.seed)
        if self.specimens:
            self.part.specimen(0)
        if isinstance(self.terrains, bool) or not int(self.terrains) >= 1:
            raise UserError(f"terrains {self.terrains!r}: expected 1 or more")
        for name in ("heading_every", "heading_std"):
            if not 0.0 <= getattr(self, name) < math.inf:
                raise UserError(f"{name} {getattr(self, name)!r}: expected 0 s or more")
        if self.heading_every and not self.heading_std:
            raise UserError("heading_std 0: a heading sensor needs a standard deviation above zero")
        without = [n for n in self.faults if n in NEEDS_HEADING and not self.heading_every]
        if without:
            raise UserError(
                f"fault {without[0]}: there is no heading sensor to fail; give heading_every too"
            )
        if self.rate is not None and not 0.0 < self.rate < math.inf:
            raise UserError(f"rate {self.rate!r}: expected a positive number of Hz")

    @property
    def draws_specimens(self) -> bool:
        """Whether each run has a part of its own."""
        return bool(self.part.tolerances) if self.specimens is None else self.specimens

    @property
    def on(self) -> str:
        """The celestial body of the drives."""
        return self.body or ("Mars" if self.drive == SOL else "Earth")

    @property
    def sensor_rate(self) -> float:
        """Hz of the sensors' samples."""
        usual = SOL_RATE if self.drive == SOL else self.part.sample_rate
        return float(self.rate or usual)

    @property
    def every(self) -> int:
        """Samples of the sensors for one of the filter."""
        return max(1, math.floor(self.sensor_rate / (PER_CUTOFF * CUTOFF)))

    @property
    def low_pass(self) -> bool:
        """Whether the low-pass is in: not where it would cut off above half the sample rate."""
        return self.sensor_rate > 2 * CUTOFF

    def contents(self) -> dict[str, Any]:
        """The settings as plain types, which make the campaign what it is."""
        own = {f.name: getattr(self, f.name) for f in fields(self)}
        return (
            {"format": FORMAT}
            | own
            | {
                "part": format_part(self.part),
                "rate": self.sensor_rate,
                "specimens": self.draws_specimens,
                "body": self.on,
            }
        )

    def key(self) -> str:
        """A name for the campaign: equal where all that decides on its runs is."""
        text = json.dumps(self.contents(), sort_keys=True, default=list)
        return hashlib.sha256(text.encode()).hexdigest()[:16]


def _known(what: str, name: str, known) -> None:
    if name not in known:
        raise UserError(
            f"{what} '{str(name)[:40]}' is unknown{did_you_mean(str(name), known)}; known are "
            f"{', '.join(known)}"
        )
