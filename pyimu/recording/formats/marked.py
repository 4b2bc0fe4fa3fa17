"""Lines that say what their values are: a label before each, or a word that tells what follows.

``ax: 0.12 ay: 0.98``, ``gx=1,gy=2`` and JSON on a line each are what small boards write to a serial
port; ``$VNIMU,...*62`` a VectorNav sensor (VN-100 user manual, asynchronous ASCII messages), and
``UncalGyro,...`` Android's GnssLogger, whose head names the fields of each word. Such a line is
rewritten as a row of a table: its values between commas.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import reduce

from pyimu.errors import UserError
from pyimu.recording.formats.lines import is_comment
from pyimu.recording.formats.several_lines import Joined, turns
from pyimu.recording.spelling import unit_of

Rewrite = Callable[[str], str | None]
"""A line as a row of a table; None of one that holds nothing of it."""

SHARE = 0.8
"""Of the last half of the first lines so many have labels, the same ones."""

SOME = 0.5
"""Share that is enough where the labels are not the same ones: of a sample in several lines."""

_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?|[-+]?nan|[-+]?inf"
_PAIR = re.compile(
    rf'[\s,;|]*"?(?P<label>[A-Za-z_][\w./()\[\]°]*(?: [\w./()\[\]°]+)*)"?\s*[:=]\s*'
    rf"(?P<value>{_NUMBER})(?=$|[\s,;|}}A-Za-z°µ])",
    re.I,
)
_WORD = re.compile(r"\s*([A-Za-z°µ%][^\s,;|:=}]*)(?=$|[\s,;|}])")
_STAMP = re.compile(r"\s*(\d{1,2}:\d{2}:\d{2}[.,]?\d*)\s*->\s*")
"""What Arduino's serial monitor writes before a line."""

STAMP = "time of day"
"""The column of such stamps."""

_FRONT = re.compile(r"\s*(\d+\.?\d*)(?:\s*[:;,]\s*|\s+)(?=[A-Za-z_\"])")
"""A number before the first label, as of a time: ``10: ax=0.12 ay=0.98``."""

FRONT = "column 1"
"""The column of such numbers."""

IN_FRONT = (STAMP, FRONT)


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


def labelled(head: Sequence[str], where: object) -> Marked | None:
    """How the lines of a file with these first ones are read, where most have a label before each
    of their numbers.

    Raises UserError where the values of one sample stand in several lines, out of turn.
    """
    lines = [line for line in head if line.strip() and not is_comment(line)]
    found = [pairs for line in lines[len(lines) // 2 :] if (pairs := _pairs(line)) is not None]
    kinds = Counter(_labels(pairs) for pairs in found)
    (labels, count), *others = kinds.most_common() or [((), 0)]
    share = len(found) / max(len(lines) - len(lines) // 2, 1)
    if share < (SOME if others else SHARE):
        return None
    if count < SHARE * len(found):
        return _in_turn(found, head, where)
    if len(labels) < 2:
        return None
    names = _columns(next(pairs for pairs in found if _labels(pairs) == labels))

    def rewrite(line: str) -> str | None:
        pairs = _pairs(line)
        known = pairs is not None and _labels(pairs) == labels
        return ",".join(value for _, value, _ in pairs) if known and pairs else line

    return Marked(tuple(names), rewrite, "a label before each number", _clocks(names))


def _in_turn(found: Sequence[Pairs], head: Sequence[str], where: object) -> Marked:
    """How lines with these labels are read, of which several make a sample.

    Raises UserError where they do not come in turn.
    """
    there = {_labels(pairs) for pairs in found}
    lines = [taken if (taken := _labels(_pairs(line) or [])) in there else None for line in head]
    order = turns(lines)
    if not order:
        kinds = Counter(_labels(pairs) for pairs in found).most_common(2)
        raise UserError(
            f"{where}: the values of one sample stand in several lines, which do not come in turn, "
            f"those of {' and '.join(kind[0] for kind, _ in kinds)}; have them written in one line"
        )
    each = [_columns(next(p for p in found if _labels(p) == labels)) for labels in order]
    names = [
        n if n not in sum(each[:k], []) else f"{n} of line {k + 1}"
        for k, of in enumerate(each)
        for n in of
    ]

    def taken(line: str) -> tuple[tuple[str, ...], list[str]] | None:
        pairs = _pairs(line)
        return None if pairs is None else (_labels(pairs), [value for _, value, _ in pairs])

    def begins(line: str) -> str | None:
        told = taken(line)
        return line if told is None or told[0] != order[0] else ",".join(told[1])

    said = f"a label before each number, a sample in {len(order)} lines"
    return Marked(tuple(names), begins, said, _clocks(names), anew=lambda: Joined(taken, order))


def _columns(pairs: Pairs) -> list[str]:
    """The names of the columns that a line makes, with their units."""
    names = _with_stems([label for label, _, _ in pairs])
    units = _units(pairs)
    return [f"{name} [{unit}]" if unit else name for name, unit in zip(names, units, strict=True)]


def _clocks(names: Sequence[str]) -> tuple[int, ...]:
    return tuple(k for k, name in enumerate(names) if name.startswith(STAMP))


Pairs = list[tuple[str, str, str | None]]
"""Label, number as it stands there, and unit behind it."""


def _labels(pairs: Pairs) -> tuple[str, ...]:
    return tuple(label for label, _, _ in pairs)


def _pairs(line: str) -> Pairs | None:
    """The labels and numbers of a line, None of one that has anything else."""
    found: Pairs = []
    line = line.strip().strip("{}").rstrip(",; ")
    stamp = _STAMP.match(line)
    at = 0
    if stamp is not None:
        found.append((STAMP, stamp[1], None))
        at = stamp.end()
    front = _FRONT.match(line, at)
    if front is not None:
        found.append((FRONT, front[1], None))
        at = front.end()
    while at < len(line):
        match = _PAIR.match(line, at)
        if match is None:
            return None
        at, unit = match.end(), None
        word = _WORD.match(line, at)
        if word is not None and unit_of(word[1]) is not None:
            at, unit = word.end(), unit_of(word[1])
        found.append((match["label"], match["value"], unit))
    return found or None


def _units(pairs: Pairs) -> list[str | None]:
    """The unit of each value; one behind the last of a vector is that of its other two, too."""
    units = [unit for _, _, unit in pairs]
    for k, (label, _, unit) in enumerate(pairs):
        if unit and k >= 2 and units[k - 2 : k] == [None, None] and label[-1:] in "zZ":
            units[k - 2 : k] = [unit, unit]
    return units


def _with_stems(labels: Sequence[str]) -> list[str]:
    """The labels; an axis alone has the words of the one before it: ``Acceleration X: 1, Y: 2``."""
    found: list[str] = []
    for label in labels:
        if label in tuple("xyzXYZ") and found and " " in found[-1] and found[-1] not in IN_FRONT:
            label = f"{found[-1].rpartition(' ')[0]} {label}"
        found.append(label)
    return found


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
