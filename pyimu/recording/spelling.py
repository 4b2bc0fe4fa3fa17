"""Units as the headers of foreign logs spell them, in the spelling of ``pyimu.units``."""

from __future__ import annotations

import re

from pyimu import units

WORDS = {
    "s": "s",
    "ms": "ms",
    "us": "us",
    "ns": "ns",
    "sec": "s",
    "secs": "s",
    "second": "s",
    "seconds": "s",
    "msec": "ms",
    "milliseconds": "ms",
    "millis": "ms",
    "usec": "us",
    "µs": "us",
    "μs": "us",
    "microseconds": "us",
    "micros": "us",
    "nsec": "ns",
    "nanoseconds": "ns",
    "nanos": "ns",
    "hz": "Hz",
    "°": "deg",
    "º": "deg",
    "degree": "deg",
    "degrees": "deg",
    "radian": "rad",
    "radians": "rad",
    "mdeg": "mdeg",
    "dps": "deg/s",
    "mdps": "mdps",
    "d/s": "deg/s",
    "gs": "g",
    "gees": "g",
    "°c": "degC",
    "celsius": "degC",
    "degc": "degC",
    "°f": "degF",
    "fahrenheit": "degF",
    "degf": "degF",
    "kelvin": "K",
    "µt": "uT",
    "μt": "uT",
    "ʯt": "uT",
    "ut": "uT",
    "nt": "nT",
    "microtesla": "uT",
    "microteslas": "uT",
    "tesla": "T",
    "gauss": "gauss",
    "volts": "V",
    "meters": "m",
    "metres": "m",
}
"""Words for units, in lower case."""

PAIRED = {"(": ")", "[": "]", "{": "}"}
"""Brackets in which headers have units."""

_POWERS = str.maketrans({"²": "^2", "³": "^3", "·": "*", "−": "-", "⁻": "-", "¹": "1"})


def unit_of(text: str) -> str | None:
    """The unit that a header means by ``text``, None where it is none.

    Products that blanks make (``m s^-2``), powers without a sign (``m/s2``), words
    (``deg per s``) and letters outside of ASCII are understood.
    """
    text = text.strip().translate(_POWERS)
    text = WORDS.get(text, text) if "/" in text else text
    if not text or len(text) > 40 or text in ("count", "counts"):  # names of counters end so
        return None
    tried = [_spelled(text), text] if " " in text else [text, _spelled(text)]
    for spelling in tried:
        if spelling:
            try:
                unit = units.parse(spelling)
                return unit.plain if unit.plain in units.DEGREES else unit.text
            except units.UnitError:
                continue
    return None


def bare(text: str) -> str:
    """A unit without the brackets around all of it: ``m/(s^2)`` keeps its own."""
    text = text.strip()
    while text[:1] in PAIRED and text.endswith(PAIRED[text[0]]):
        inner = text[1:-1]
        if any(c in inner for c in (text[0], text[-1])):
            break
        text = inner.strip()
    return text


def _spelled(text: str) -> str:
    """``text`` in words and signs of ``pyimu.units``."""
    text = re.sub(r"\bper\b|_per_", "/", text, flags=re.I)
    text = re.sub(r"\bsquared\b", "^2", text, flags=re.I)
    parts = re.split(r"(\s*[/*]\s*|\s+)", text)
    spelled = []
    for part in parts:
        if not part.strip():
            spelled.append("*" if part and spelled and spelled[-1][-1:] not in "/*" else "")
        elif part.strip() in "/*":
            spelled.append(part.strip())
        else:
            spelled.append(_atom(part.strip("_")))
    return _divided("".join(spelled).strip("*"))


def _atom(word: str) -> str:
    """A word with its power."""
    match = re.fullmatch(r"([^\W\d]+|°C?|º)\^?(-?\d)?", word)
    if match is None:
        return word
    known = WORDS.get(match[1].casefold(), match[1])
    return known if not match[2] else f"{known}^{match[2]}"


def _divided(text: str) -> str:
    """``rad*s^-1`` as ``rad/s``."""
    text = re.sub(r"\*([A-Za-z]+)\^-1(?!\d)", r"/\1", text)
    return re.sub(r"\*([A-Za-z]+)\^-(\d)", r"/\1^\2", text)
