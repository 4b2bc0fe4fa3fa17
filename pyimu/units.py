"""Units: a closed table of atoms and a small strict grammar over it.

A general unit parser reads ``g`` as gram and knows no ``deg/sqrt(h)``; here ``g`` is standard
gravity, and a spelling that is not in the table is an error that names the nearest one that is::

    product = power (("*" | "/") power)*         left to right: deg/h/sqrt(h) = deg/(h sqrt(h))
    power   = factor ["^" (integer | half)]          half: 0.5, 1/2, (-3/2)
    factor  = atom [integer] | "sqrt" "(" product ")" | "(" product ")"

What data sheets and the package's own reports print is read as well: degree and micro signs, roots
with their sign or as rtHz, raised powers, any sign of minus and fraction, and the names in
``ALIASES``, so that ``°/s``, ``mdps/√Hz``, ``µg/rtHz``, ``m/s2`` and ``ppm/°C`` are units, and
``LSB/°/s`` is LSB/(°/s). A blank or a point between two names multiplies where no sign of division
stands (``m s⁻²``, ``rad.s-1``); behind one it could mean either, and is an error. A trailing
``rms``, as in ``mg rms``, says how a figure was measured and is no part of its unit; so does
``(1σ)``.

The radian and the count of a converter (LSB) are kept as dimensions of their own, so that a column
in 1/s is not taken for a rate, nor one in counts for a pure number.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from dataclasses import dataclass
from difflib import get_close_matches
from fractions import Fraction
from functools import lru_cache

import numpy as np

from pyimu.errors import UserError

STANDARD_GRAVITY = 9.80665
"""m/s^2, exact by definition (3rd CGPM, 1901)."""

LARGEST_EXPONENT = 150
"""Powers of ten that a unit's factor may have, so that its square and its inverse are numbers."""

ZERO_CELSIUS = 273.15
"""K, exact by definition."""

IN_SI: dict[str, dict[str, int]] = {
    "rad": {"rad": 1},
    "s": {"s": 1},
    "m": {"m": 1},
    "K": {"K": 1},
    "V": {"kg": 1, "m": 2, "s": -3, "A": -1},
    "T": {"kg": 1, "s": -2, "A": -1},
    "LSB": {},
}
"""The base units of this module in those of SI."""

BASES = tuple(IN_SI)
"""The base units, in the order of the exponents in ``Unit.dimension``."""

_DEG = math.pi / 180

_ATOMS: dict[str, tuple[float, dict[str, int]]] = {
    "1": (1.0, {}),
    "ppm": (1e-6, {}),
    "%": (1e-2, {}),
    "rad": (1.0, {"rad": 1}),
    "mrad": (1e-3, {"rad": 1}),
    "urad": (1e-6, {"rad": 1}),
    "deg": (_DEG, {"rad": 1}),
    "mdeg": (1e-3 * _DEG, {"rad": 1}),
    "rev": (2 * math.pi, {"rad": 1}),
    "arcmin": (_DEG / 60, {"rad": 1}),
    "arcsec": (_DEG / 3600, {"rad": 1}),
    "s": (1.0, {"s": 1}),
    "ms": (1e-3, {"s": 1}),
    "us": (1e-6, {"s": 1}),
    "ns": (1e-9, {"s": 1}),
    "min": (60.0, {"s": 1}),
    "h": (3600.0, {"s": 1}),
    "day": (86400.0, {"s": 1}),
    "Hz": (1.0, {"s": -1}),
    "kHz": (1e3, {"s": -1}),
    "m": (1.0, {"m": 1}),
    "um": (1e-6, {"m": 1}),
    "mm": (1e-3, {"m": 1}),
    "cm": (1e-2, {"m": 1}),
    "km": (1e3, {"m": 1}),
    "ft": (0.3048, {"m": 1}),
    "mi": (1609.344, {"m": 1}),
    "kn": (1852 / 3600, {"m": 1, "s": -1}),
    "g": (STANDARD_GRAVITY, {"m": 1, "s": -2}),
    "mg": (1e-3 * STANDARD_GRAVITY, {"m": 1, "s": -2}),
    "ug": (1e-6 * STANDARD_GRAVITY, {"m": 1, "s": -2}),
    "K": (1.0, {"K": 1}),
    "degC": (1.0, {"K": 1}),
    "degF": (5 / 9, {"K": 1}),
    "V": (1.0, {"V": 1}),
    "mV": (1e-3, {"V": 1}),
    "T": (1.0, {"T": 1}),
    "mT": (1e-3, {"T": 1}),
    "uT": (1e-6, {"T": 1}),
    "nT": (1e-9, {"T": 1}),
    "gauss": (1e-4, {"T": 1}),
    "mgauss": (1e-7, {"T": 1}),
    "ugauss": (1e-10, {"T": 1}),
    "LSB": (1.0, {"LSB": 1}),
}

ATOMS = tuple(_ATOMS)
"""Every spelling that the table knows."""

ALIASES = {
    "dps": "deg/s",
    "DPS": "deg/s",
    "mdps": "mdeg/s",
    "Deg": "deg",
    "dph": "deg/h",
    "rpm": "rev/min",
    "RPM": "rev/min",
    "kph": "km/h",
    "mph": "mi/h",
    "knot": "kn",
    "knots": "kn",
    "degree": "deg",
    "degrees": "deg",
    "radian": "rad",
    "radians": "rad",
    "arcsecond": "arcsec",
    "arcseconds": "arcsec",
    "arc-sec": "arcsec",
    "arcminute": "arcmin",
    "arcminutes": "arcmin",
    "arc-min": "arcmin",
    "sec": "s",
    "Sec": "s",
    "msec": "ms",
    "usec": "us",
    "nsec": "ns",
    "minute": "min",
    "minutes": "min",
    "second": "s",
    "seconds": "s",
    "hr": "h",
    "Hr": "h",
    "hrs": "h",
    "sps": "Hz",
    "SPS": "Hz",
    "milli-g": "mg",
    "micro-g": "ug",
    "g0": "g",
    "g₀": "g",
    "gₙ": "g",
    "volt": "V",
    "volts": "V",
    "hour": "h",
    "hours": "h",
    "days": "day",
    "Gauss": "gauss",
    "mGauss": "mgauss",
    "milligauss": "mgauss",
    "uGauss": "ugauss",
    "lsb": "LSB",
    "LSb": "LSB",
    "LSBs": "LSB",
    "count": "LSB",
    "counts": "LSB",
    "digit": "LSB",
    "digits": "LSB",
}
"""Names that data sheets use, in those of the table; each is one factor: LSB/dps = LSB/(deg/s)."""

_SIGNS = {
    "samples/second": "Hz",
    "samples/sec": "Hz",
    "samples/s": "Hz",
    "Samples/s": "Hz",
    "° C": "degC",
    "º C": "degC",
    "deg C": "degC",
    "deg. C": "degC",
    "°K": "K",
    "°C": "degC",
    "ºC": "degC",
    "℃": "degC",
    "°F": "degF",
    "ºF": "degF",
    "℉": "degF",
    "°": "deg",
    "º": "deg",
    "µ": "u",
    "μ": "u",
    "·": "*",
    "⋅": "*",
    "×": "*",
    "**": "^",
    "∕": "/",
    "⁄": "/",
    "−": "-",
    "–": "-",
    "％": "%",
    "^½": "^0.5",
    "½": "^0.5",
    "arc sec": "arcsec",
    "arc min": "arcmin",
    "″": "arcsec",
}
"""Signs in print, and what they stand for; the longer ones go first."""

_UNSEEN = re.compile("[\u0305\u200b-\u200f\u2060\ufeff]")
"""What print sets without a width of its own: the line over what stands under a root, and joints of
words.
"""

_RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺ᐟ", "0123456789-+/")

_RAISED_ONES = re.compile(f"[{''.join(map(chr, _RAISED))}]+")

_HALF = re.compile(r"\^ ?\( ?([-+]?\d{1,2}(?:\.[05]|/2)?) ?\)|\^ ?([-+]?\d?[13579]/2)(?!\d)")
"""A power in brackets, and one that is half a whole number without them."""

_BARE_POWER = re.compile(r"(?<=[*. ])([A-Za-z]{1,3})(-\d)(?![\d.])")
"""A power that print has raised and a copy of it has not: m s-2."""

_BESIDE = re.compile(r"(?<=[\w)%])(?<!sqrt)(?: +|\.)(?=[A-Za-z(])")
"""What stands between two names that are multiplied."""

_ROOT = re.compile(r"(?:√ ?|\b(?:rt|sqrt|root)[ -]?)([A-Za-z]+)|(?:√|\brt)(?= ?\()")
"""The root of one name, √Hz or rtHz, or of what stands in brackets."""

_MEASURED = re.compile(
    r"(?:(?<=\S)(?:[ -]|, ?)\(?(?:rms|RMS|1 ?σ|1[- ]sigma)\)?|(?<=g)rms"
    r"|(?<=\S)\((?:rms|RMS|1 ?σ)\))$"
)
"""How data sheets say behind a unit that the figure is a root mean square."""

_SHARE_OF_RANGE = re.compile(r"(?:%|ppm) ?(?:of )?(?:F\.?S|full[- ]scale|FSR|FSO|range)", re.I)

_PEAKS = re.compile(r"[ -]\(?(?:p-p|pp|pk-pk|peak[- ]to[- ]peak)\)?$", re.I)

_HINTS = {
    "mG": "mgauss (field) or mg (gravity)",
    "G": "gauss (field) or g (gravity)",
    "Gs": "gauss (field) or g (gravity)",
    "mGs": "mgauss (field) or mg (gravity)",
    "bit": "LSB",
    "bits": "LSB",
    "code": "LSB",
    "codes": "LSB",
    "meter": "m",
    "metre": "m",
    "C": "degC",
    "celsius": "degC",
    "fahrenheit": "degF",
    "kelvin": "K",
    "rps": "rev/s or rad/s",
}
"""What common spellings outside the table are called in it; only for error messages."""

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
            _Reader(text, _unit(like).dimension).product()  # raises, by what is expected
        raise


@lru_cache(maxsize=1024)
def _parsed(text: str) -> Unit:
    reader = _Reader(text)
    factor, dimension = reader.product()
    reader.end()
    return Unit(factor, dimension, text.strip())


def same_dimension(a: str | Unit, b: str | Unit) -> bool:
    """Whether a value in ``a`` can be converted to ``b``. Raises UnitError for an unknown unit."""
    return _unit(a).dimension == _unit(b).dimension


def convert(values, source: str | Unit, target: str | Unit):
    """Convert ``values`` from unit ``source`` to unit ``target``.

    Gives a float for a scalar, else an array of the same shape.

    Temperatures convert as differences; for readings of a thermometer see ``to_degc``. Raises
    UnitError where the dimensions differ.
    """
    target = _unit(target)
    source = _unit(source, target)
    if source.dimension != target.dimension:
        raise UnitError(
            f"'{source}' cannot be converted to '{target}': {_describe(source)} is not "
            f"{_describe(target)}"
        )
    with np.errstate(over="ignore", invalid="ignore"):  # infinite and missing ones stay it
        scaled = np.asarray(values, dtype=float) * (source.factor / target.factor)
    return float(scaled) if scaled.ndim == 0 else scaled


FREEZING = {"K": ZERO_CELSIUS, "degC": 0.0, "degF": 32.0}
"""What water freezes at, in units of temperature."""

DEGREES = tuple(unit for unit in FREEZING if unit != "K")
"""Units of temperatures alone: K may be of a difference, too."""


def to_degc(values, unit: str | Unit):
    """Convert temperatures read in ``unit`` (``K``, ``degC`` or ``degF``) to degC; a float for a
    scalar.

    Raises UnitError for another unit.
    """
    unit = _unit(unit, "K")
    if unit.plain not in FREEZING:
        raise UnitError(f"a temperature must be in degC, K or degF, not '{unit}'")
    shifted = (np.asarray(values, dtype=float) - FREEZING[unit.plain]) * unit.factor
    return float(shifted) if shifted.ndim == 0 else shifted


def nearest(name: str, names: Iterable[str], cutoff: float = 0.7) -> str | None:
    """The member of ``names`` closest in spelling to ``name``, ignoring case, or None."""
    folded: dict[str, str] = {}
    for candidate in names:
        folded.setdefault(candidate.casefold(), candidate)
    match = get_close_matches(str(name).casefold(), folded, n=1, cutoff=cutoff)
    return folded[match[0]] if match else None


def did_you_mean(name: str, names: Iterable[str], cutoff: float = 0.7) -> str:
    """``", did you mean NEAREST?"`` to end an error message with, empty where nothing is near."""
    near = nearest(name, names, cutoff)
    return f", did you mean {near}?" if near else ""


def or_known(name: str, names: Iterable[str]) -> str:
    """The end of an error message as ``did_you_mean``; all ``names`` where nothing is near."""
    listed = list(names)
    return did_you_mean(name, listed) or f"; known are {', '.join(listed)}"


def plain(text: str) -> str:
    """``text`` in the letters of the table: ``udeg`` for ``µ°``, ``sqrt(h)`` for ``√h``."""
    text = re.sub(r"\s", " ", _UNSEEN.sub("", text))
    text = _RAISED_ONES.sub(lambda m: f"^{m[0].translate(_RAISED)}", text)
    for sign, letters in _SIGNS.items():
        text = text.replace(sign, letters)
    text = _HALF.sub(_half, text)
    text = _ROOT.sub(lambda m: f"sqrt({m[1]})" if m[1] else "sqrt", text).strip()
    text = _MEASURED.sub("", text)
    if "/" in text:
        return text
    return _BESIDE.sub("*", _BARE_POWER.sub(r"\1^\2", text))


def _half(match: re.Match[str]) -> str:
    """The power that ``_HALF`` found, as a decimal number."""
    power = match[1] or match[2]
    return f"^{float(Fraction(power)):g}"


def _unit(unit: str | Unit, like: Unit | str | None = None) -> Unit:
    return unit if isinstance(unit, Unit) else parse(unit, like)


def _describe(unit: Unit) -> str:
    """The dimension in SI: ``rad s^-1``."""
    parts = [base if e == 1 else f"{base}^{e}" for base, e in zip(BASES, unit.dimension) if e]
    return " ".join(parts) or "a pure number"


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
        if raised and raised[1] in _ATOMS:
            factor, dimension = self._atom(raised[1])
            return factor ** int(raised[2]), tuple(e * int(raised[2]) for e in dimension)
        if token not in _ATOMS:
            raise self.error(self._unknown(token))
        factor, exponents = _ATOMS[token]
        return factor, tuple(Fraction(exponents.get(base, 0)) for base in BASES)

    def _unknown(self, token: str) -> str:
        if not token or token in "*/^()":
            return "a unit is missing" + (f" before '{token}'" if token else " at its end")
        if said := self._said_otherwise():
            return said
        meant = _HINTS.get(token) or _HINTS.get(token.casefold()) or self._nearest(token)
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
