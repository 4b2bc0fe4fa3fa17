"""What the columns of a file may be: guesses, and all of them together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from pyimu.display.brief import Brief
from pyimu.recording.columns import GROUP_OF

CHOICES = {"time": ("s", "ms", "us", "ns"), "gyro": ("rad/s", "deg/s")} | {
    "mag": ("uT", "gauss", "mgauss"),
    "accel": ("m/s^2", "g"),
    "temperature": ("degC", "K", "degF"),
    "ref_q": ("rad", "deg"),
}
"""Units to choose from where nothing tells."""


@dataclass(frozen=True)
class Guess:
    """A column of the file and what it may be: ``target`` such as ``gyro_x``, its unit, and why.

    ``unit`` is None where nobody knows; ``value`` the size of a count in it, ``sizes`` those
    that it may have, in deg/s or g, and ``choices`` the units, where they are fewer than usual.
    """

    cell: str
    target: str
    unit: str | None
    why: str
    value: float | None = None
    sizes: tuple[float, ...] = ()
    choices: tuple[str, ...] = ()

    @property
    def group(self) -> str:
        return GROUP_OF[self.target]


@dataclass(frozen=True)
class Offer:
    """Columns that are left out as long as nobody says that they are wanted: the ``guesses`` by
    which they would be read, and a ``note`` on what they may be.
    """

    note: str
    guesses: tuple[Guess, ...]


@dataclass(repr=False)
class Proposal(Brief):
    """What the columns of a file may be.

    ``notes`` say what else could be meant, ``offers`` are those of them with lines for a map;
    ``rate`` [Hz] is what the file says of itself, or a map of it, where it has no times; ``topic``
    the word in its rows, of a file with those of several sensors.
    """

    path: Path
    header: tuple[str, ...]
    guesses: list[Guess] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    offers: list[Offer] = field(default_factory=list)
    rate: float | None = None
    topic: str = ""

    @property
    def timeless(self) -> bool:
        """Whether neither a column nor the file says when its samples were taken."""
        return self.rate is None and "time" not in self.groups

    @property
    def open_questions(self) -> list[str]:
        """Groups whose unit nobody knows."""
        return list(dict.fromkeys(g.group for g in self.guesses if g.unit is None))

    @property
    def units(self) -> dict[str, str]:
        """Groups to their units, as far as they are known."""
        return {g.group: g.unit for g in self.guesses if g.unit is not None}

    @property
    def given_to(self) -> str:
        """Which commands take the map, and by which option."""
        if self.holds == "reference":
            return "pyimu close as --reference-columns"
        return "the other commands as --columns"

    @property
    def holds(self) -> str:
        """What the file holds, as ``Source`` has it: a "sensor", or a "reference" alone."""
        sensor = {"gyro", "accel"} & set(self.groups)
        alone = not sensor and any(group.startswith("ref_") for group in self.groups)
        return "reference" if alone else "sensor"

    @property
    def groups(self) -> list[str]:
        return list(dict.fromkeys(g.group for g in self.guesses))

    def offer(self, note: str, guesses: Sequence[Guess]) -> None:
        """Note columns that are left out, with what would read them."""
        self.notes.append(note)
        self.offers.append(Offer(note, tuple(guesses)))

    def add(self, guesses: Sequence[Guess]) -> None:
        self.guesses += guesses
