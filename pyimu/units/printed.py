"""Units in the signs of print, in the letters of the table."""

from __future__ import annotations

import re
from fractions import Fraction

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
