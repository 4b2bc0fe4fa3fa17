"""The grammar of units, as ``pyimu.units`` says it."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

from pyimu.errors import UserError
from pyimu.units.near import nearest
from pyimu.units.printed import plain
from pyimu.units.table import ALIASES, ATOMS, BASES, HINTS, KNOWN, LARGEST_EXPONENT

_SHARE_OF_RANGE = re.compile(r"(?:%|ppm) ?(?:of )?(?:F\.?S|full[- ]scale|FSR|FSO|range)", re.I)

_PEAKS = re.compile(r"[ -]\(?(?:p-p|pp|pk-pk|peak[- ]to[- ]peak)\)?$", re.I)

_PER_RATE = re.compile(
    r"^(\s*(?:LSB|LSb|lsb|digits?|counts?|mV|V)\s*/\s*)(m?deg\s*/\s*s(?:ec)?)\s*$"
)
"""A sensitivity as data sheets print it, LSB/°/s, which is one to a rate: LSB/(°/s)."""

_TOKEN = re.compile(
    r"\s*(?:(?P<operator>[*/^()])|(?P<number>[-+]?\d+(?:\.5)?)|(?P<word>[^\s*/^()\d+-][^\s*/^()]*))"
)


class UnitError(UserError):
    """A unit that is not in the table, is malformed, or has the wrong dimension."""


@dataclass(frozen=True)
class Unit:
    """A unit: ``factor`` times the SI unit of ``dimension``.

    ``dimension`` holds the exponents of ``BASES``, ``text`` the spelling that was parsed.
    """

    factor: float
    dimension: tuple[Fraction, ...]
    text: str

    def __str__(self) -> str:
        return self.text

    @property
    def plain(self) -> str:
        """The spelling without signs that only print has: ``degC`` for ``°C``."""
        return plain(self.text)


_Value = tuple[float, tuple[Fraction, ...]]

LONGEST = 400
"""Characters of a unit, brackets in brackets among them."""

WORD = 5
"""Letters of an unknown name from which on its likeness to another says something by itself."""


def parse(text: str, like: str | Unit | None = None) -> Unit:
    """The unit that ``text`` spells, as ``"deg/h/sqrt(h)"``, ``"rad/s/(m/s^2)"`` or ``"µg/√Hz"``.

    Raises UnitError for text that is no unit, and for an atom outside the table, naming the nearest
    one: with it the unit is one ``like`` that which is expected, where that is said.
    """
    if not isinstance(text, str):
        raise UnitError(f"a unit must be text such as 'deg/s', not {str(text)[:LONGEST]!r}")
    if len(text) > LONGEST:
        raise UnitError(f"'{text[:LONGEST]}...' is not a unit: {len(text)} characters are too many")
    try:
        return _parsed(text)
    except UnitError:
        if like is not None:
            _Reader(text, unit_of(like).dimension).product()  # raises, by what is expected
        raise


@lru_cache(maxsize=1024)
def _parsed(text: str) -> Unit:
    reader = _Reader(text)
    factor, dimension = reader.product()
    reader.end()
    return Unit(factor, dimension, text.strip())


def unit_of(unit: str | Unit, like: Unit | str | None = None) -> Unit:
    return unit if isinstance(unit, Unit) else parse(unit, like)


class _Reader:
    """Recursive descent parser of the grammar in the module's docstring.

    The method of each rule returns (factor, dimension). ``like`` is the dimension that is expected,
    None where none is; only errors ask for it.
    """

    def __init__(self, text: str, like: tuple[Fraction, ...] | None = None) -> None:
        self.text = text
        self.like = like
        self.tokens = self._tokens()
        self.position = 0

    def _tokens(self) -> list[str]:
        tokens, start, text = [], 0, _PER_RATE.sub(r"\1(\2)", plain(self.text))
        while start < len(text):
            match = _TOKEN.match(text, start)
            if not match:
                raise self.error(f"unexpected '{text[start:].strip()}'")
            tokens.append(match.group().strip())
            start = match.end()
        return tokens

    def error(self, reason: str) -> UnitError:
        return UnitError(f"'{self.text}' is not a unit: {reason}")

    def peek(self) -> str:
        return self.tokens[self.position] if self.position < len(self.tokens) else ""

    def take(self) -> str:
        token = self.peek()
        self.position += 1
        return token

    def expect(self, token: str) -> None:
        if self.take() != token:
            raise self.error(f"a '{token}' is missing")

    def end(self) -> None:
        if self.peek():
            raise self.error(self._said_otherwise() or f"unexpected '{self.peek()}'")

    def _said_otherwise(self) -> str | None:
        """What a unit of data sheets that is none says, None of any other."""
        if _SHARE_OF_RANGE.search(self.text):
            return "a share of the range has the range's unit: 0.1 % of 2000 dps is 2 dps"
        if _PEAKS.search(self.text):
            return "a figure from peak to peak is no rms; write the rms, or the density"
        if "/" in self.text and self.peek()[:1].isalpha():
            return f"unexpected '{self.peek()}'; behind a '/' write '*' or '/' before it"
        return None

    def product(self) -> _Value:
        factor, dimension = self.power()
        while self.peek() in ("*", "/"):
            sign = 1 if self.take() == "*" else -1
            f, d = self.power()
            factor = factor * f if sign > 0 else factor / f
            dimension = tuple(a + sign * b for a, b in zip(dimension, d))
        return factor, dimension

    def power(self) -> _Value:
        factor, dimension = self.factor()
        if self.peek() != "^":
            return factor, dimension
        self.take()
        text = self.take()
        if not re.fullmatch(r"[-+]?\d{1,2}(?:\.5)?", text):
            raise self.error(f"a power must be an integer below 100, or half of one, not '{text}'")
        power = Fraction(text)
        if factor != 0 and abs(power * math.log10(abs(factor))) > LARGEST_EXPONENT:
            raise self.error(f"the power {power} is beyond all sizes")
        exponent = int(power) if power.denominator == 1 else float(power)
        return factor**exponent, tuple(e * power for e in dimension)

    def factor(self) -> _Value:
        token = self.take()
        if token == "(":
            return self._bracketed()
        if token == "sqrt":
            self.expect("(")
            factor, dimension = self._bracketed()
            return math.sqrt(factor), tuple(e / 2 for e in dimension)
        return self._atom(token)

    def _bracketed(self) -> _Value:
        value = self.product()
        self.expect(")")
        return value

    def _atom(self, token: str) -> _Value:
        if token in ALIASES:
            unit = parse(ALIASES[token])
            return unit.factor, unit.dimension
        raised = re.fullmatch(r"([A-Za-z]+)([23])", token)
        if raised and raised[1] in KNOWN:
            factor, dimension = self._atom(raised[1])
            return factor ** int(raised[2]), tuple(e * int(raised[2]) for e in dimension)
        if token not in KNOWN:
            raise self.error(self._unknown(token))
        factor, exponents = KNOWN[token]
        return factor, tuple(Fraction(exponents.get(base, 0)) for base in BASES)

    def _unknown(self, token: str) -> str:
        if not token or token in "*/^()":
            return "a unit is missing" + (f" before '{token}'" if token else " at its end")
        if said := self._said_otherwise():
            return said
        meant = HINTS.get(token) or HINTS.get(token.casefold()) or self._nearest(token)
        return f"unknown '{token}'" + (
            f", did you mean {meant}?" if meant else f"; known are {', '.join(ATOMS)}"
        )

    def _nearest(self, token: str) -> str | None:
        """The name that may be meant by the unknown ``token``, which was taken last."""
        names = [*ATOMS, *ALIASES]
        if self.like is not None:
            names = [name for name in names if self._with(name) == self.like]
        elif len(token) < WORD:  # a short word is like many: it may be in other letters, no more
            names = [name for name in names if name.casefold() == token.casefold()]
        return nearest(token, names, cutoff=0.5)

    def _with(self, name: str) -> tuple[Fraction, ...] | None:
        """The dimension with ``name`` in place of the token that was taken last, None if none."""
        other = _Reader(self.text)
        other.tokens[self.position - 1] = name
        try:
            return other.product()[1]
        except UnitError:
            return None
