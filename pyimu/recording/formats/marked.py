"""Lines that say what their values are, by a word that tells what follows.

``$VNIMU,...*62`` is what a VectorNav sensor writes (VN-100 user manual, asynchronous ASCII
messages), and ``UncalGyro,...`` Android's GnssLogger, whose head names the fields of each word.
Such a line is rewritten as a row of a table: its values between commas.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import reduce

Rewrite = Callable[[str], str | None]
"""A line as a row of a table; None of one that holds nothing of it."""

SHARE = 0.8
"""Of the last half of the first lines so many have labels, the same ones."""


@dataclass(frozen=True)
class Marked:
    """How marked lines are read: the ``names`` of the values, what makes a row of a line, what is
    ``said`` of it, and the axes that are defined. ``commented`` says that they begin as comments
    do; ``rate`` [Hz] is the data set's own.
    """

    names: tuple[str, ...]
    rewrite: Rewrite
    said: str
    clocks: tuple[int, ...] = ()
    body: str | None = None
    commented: bool = False
    rate: float | None = None
    word: str = ""
    words: tuple[str, ...] = ()
    """The word in the rows, and those in rows of other sensors of the same log."""
    anew: Callable[[], Rewrite] | None = None
    """What gives one that begins anew, where a row is made of several lines."""

    def rewriter(self) -> Rewrite:
        """What makes rows of the lines of one pass over the file."""
        return self.rewrite if self.anew is None else self.anew()


VECTORNAV = {
    "$VNIMU": "mag accel gyro temperature pressure",
    "$VNYMR": "yaw pitch roll mag accel gyro",
    "$VNQMR": "q_x q_y q_z q_w mag accel gyro",
    "$VNMAR": "mag accel gyro",
}
"""What the messages of a VectorNav sensor hold, in their order; a vector x first."""

VECTORNAV_UNITS = {"mag": "gauss", "accel": "m/s^2", "gyro": "rad/s", "temperature": "degC"}


def vectornav(lines: Sequence[str]) -> Marked | None:
    """How the ``lines`` of a VectorNav sensor are read, None of any others.

    Of several messages the first of ``VECTORNAV`` counts. A line whose checksum is wrong stays as
    it is, and is no row.
    """
    there = {line.partition(",")[0].strip() for line in lines}
    tag = next((name for name in VECTORNAV if name in there), None)
    if tag is None:
        return None
    names = []
    for word in VECTORNAV[tag].split():
        unit = f" [{VECTORNAV_UNITS[word]}]" if word in VECTORNAV_UNITS else ""
        vector = word in ("mag", "accel", "gyro")
        names += [f"{word}_{a}{unit}" for a in "xyz"] if vector else [f"{word}{unit}"]

    def rewrite(line: str) -> str | None:
        if not line.startswith(tag + ","):
            return None
        body, _, sum_said = line.strip().partition("*")
        if sum_said and sum_said.upper() != _checksum(body[1:]):
            return line
        return ",".join(body.split(",")[1 : len(names) + 1])

    return Marked(tuple(names), rewrite, f"the messages {tag}", body="frd")


def _checksum(text: str) -> str:
    """That of NMEA 0183: all characters between $ and * by exclusive or, in two digits."""
    return f"{reduce(lambda a, b: a ^ b, text.encode(), 0):02X}"


_SENTENCE = re.compile(r"\$([A-Z]{3,}),(.*)\*([0-9A-Fa-f]{2})\s*")

LEAST_FIELDS = 6
"""Numbers of a sentence that may hold a sensor's samples."""


def sentences(lines: Sequence[str]) -> Marked | None:
    """How the sentences of NMEA 0183 are read that have the most numbers among ``lines``, None of
    any others. What they hold their words do not say. One whose checksum is wrong is no row.
    """
    found = [match for line in lines if (match := _SENTENCE.fullmatch(line))]
    kinds = Counter((match[1], match[2].count(",") + 1) for match in found)
    full = [kind for kind in kinds if kind[1] >= LEAST_FIELDS and kinds[kind] > len(lines) // 4]
    if not full or len(found) < SHARE * len(lines):
        return None
    tag, count = max(full, key=lambda kind: (kind[1], kinds[kind]))

    def rewrite(line: str) -> str | None:
        match = _SENTENCE.fullmatch(line)
        if match is None or match[1] != tag:
            return None
        right = match[3].upper() == _checksum(line.strip()[1:].rpartition("*")[0])
        return match[2] if right else line

    names = tuple(f"column {k + 1}" for k in range(count))
    return Marked(names, rewrite, f"the sentences ${tag}")


GNSS_LOGGER = ("UncalGyro", "Gyro", "UncalAccel", "Accel", "UncalMag", "Mag")
"""Words before the samples of GnssLogger that are no satellite's."""


def gnss_logger(lines: Sequence[str], word: str) -> Marked | None:
    """How the rows of GnssLogger that begin with ``word`` are read: its head names their fields."""
    names = next((_fields(line) for line in lines if _fields(line)[:1] == [word]), None)
    if names is None or len(names) < 6:
        return None

    def rewrite(line: str) -> str | None:
        return line if line.startswith(word + ",") else None

    return Marked(tuple(names), rewrite, f"the rows {word}")


def _fields(line: str) -> list[str]:
    return [field.strip() for field in line.lstrip("# ").split(",")] if line[:1] == "#" else []
