"""Numbers in the units people use: deg/s, deg/h, mg, ppm and ms.

They have three or four figures, with a standard error beside them.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from pyimu.units import UnitError, convert

MISSING = "–"

SHOWN: dict[str, tuple[tuple[str, float], ...]] = {
    "rad/s": (("deg/s", 0.01), ("deg/h", 0.0)),
    "rad/s^2": (("deg/s^2", 1.0), ("deg/h/s", 0.1), ("deg/h/h", 0.0)),
    "rad": (("deg", 0.01), ("arcsec", 0.0)),
    "m/s^2": (("g", 1.0), ("mg", 0.01), ("ug", 0.0)),
    "T": (("uT", 0.1), ("nT", 0.0)),
    "T*s/sqrt(s)": (("nT/sqrt(Hz)", 0.0),),
    "m/s^3": (("mg/s", 0.01), ("ug/s", 0.0)),
    "s": (("s", 1.0), ("ms", 0.01), ("us", 0.0)),
    "1": (("%", 1.0), ("ppm", 0.0)),
    "rad/sqrt(s)": (("deg/sqrt(h)", 0.0),),
    "rad/s/sqrt(s)": (("deg/h/sqrt(h)", 0.0),),
    "m/s/sqrt(s)": (("ug/sqrt(Hz)", 0.0),),
    "m/s^2/sqrt(s)": (("ug/sqrt(s)", 0.0),),
    "rad/s/(m/s^2)": (("deg/s/g", 1.0), ("deg/h/g", 0.0)),
    "rad/s/(m/s^2)^2": (("deg/s/g^2", 1.0), ("deg/h/g^2", 0.0)),
    "rad/s/(rad/s^2)": (("s", 1.0), ("ms", 0.01), ("us", 0.0)),
    "m/s^2/(rad/s^2)": (("mg/(rad/s^2)", 0.01), ("ug/(rad/s^2)", 0.0)),
    "m/s^2/(rad/s)^2": (("mg/(rad/s)^2", 0.01), ("ug/(rad/s)^2", 0.0)),
    "1/(m/s^2)": (("%/g", 1.0), ("ppm/g", 0.0)),
    "1/K": (("%/K", 1.0), ("ppm/K", 0.0)),
    "s/rad": (("ppm/(deg/s)", 0.0),),
    "rad/s/K": (("deg/s/K", 0.1), ("deg/h/K", 0.0)),
    "rad/s/K^2": (("deg/s/K^2", 0.1), ("deg/h/K^2", 0.0)),
    "m/s^2/K": (("mg/K", 0.01), ("ug/K", 0.0)),
    "m/s^2/K^2": (("mg/K^2", 0.1), ("ug/K^2", 0.0)),
    "rad/s/K^3": (("deg/s/K^3", 0.1), ("deg/h/K^3", 0.0)),
    "m/s^2/K^3": (("mg/K^3", 0.1), ("ug/K^3", 0.0)),
    "rad/s*s/K": (("deg/s/(K/min)", 0.1), ("deg/h/(K/min)", 0.0)),
    "m/s^2*s/K": (("mg/(K/min)", 0.01), ("ug/(K/min)", 0.0)),
    "rad/K": (("deg/K", 0.01), ("arcsec/K", 0.0)),
    "1/(rad/s)": (("%/(deg/s)", 1.0), ("ppm/(deg/s)", 0.0)),
    "1/(rad/s)^2": (("ppm/(deg/s)^2", 0.0),),
    "1/(m/s^2)^2": (("%/g^2", 1.0), ("ppm/g^2", 0.0)),
    "m/s^2/(m/s^2)^2": (("mg/g^2", 0.01), ("ug/g^2", 0.0)),
    "rad/s/s": (("deg/s^2", 1.0), ("deg/h/s", 0.1), ("deg/h/h", 0.0)),
    "m/s^2/s": (("mg/s", 0.01), ("ug/s", 0.0)),
    "1/s": (("%/h", 1.0), ("ppm/h", 0.0)),
    "rad/s/V": (("deg/s/V", 0.01), ("deg/h/V", 0.0)),
    "m/s^2/V": (("g/V", 1.0), ("mg/V", 0.01), ("ug/V", 0.0)),
    "rad/s/T": (("deg/s/gauss", 1.0), ("deg/h/gauss", 0.0)),
    "m/s^2/T": (("mg/gauss", 0.01), ("ug/gauss", 0.0)),
}
"""SI unit -> the units people use, largest first, each with the smallest number that is still said
in it."""

SAID = {"frequency": "Hz", "ratio": "1"}
"""The unit of what is said otherwise than others in its SI unit are: nobody calls a natural
frequency degrees a second, nor a damping ratio percent."""

SCRIPTS = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")


def told_apart(si: str, said: str) -> str:
    """An SI unit that ``unit_for`` and all else here take, of what is ``said`` otherwise than
    others in it: ``said`` is a key of ``SAID``, or empty.
    """
    return f"{si} ({said})" if said else si


def _apart(si: str) -> tuple[str, str]:
    said = next((word for word in SAID if si.endswith(f" ({word})")), "")
    return si.removesuffix(f" ({said})"), said


def unit_for(values: object, si: str) -> str:
    """The unit in which people would say the largest of ``values`` (SI).

    It is the SI unit itself where the table has none.
    """
    plain, said = _apart(si)
    if said:
        return SAID[said]
    largest = np.max(np.nan_to_num(np.abs(_finite_or_nan(values))), initial=0.0)
    for unit, least in SHOWN.get(plain, ()):
        if largest == 0.0 or convert(largest, plain, unit) >= least:
            return unit
    return plain


def in_unit(values: object, si: str, unit: str) -> np.ndarray:
    """``values`` (SI) as numbers of ``unit``."""
    array = _finite_or_nan(values)
    plain, _ = _apart(si)
    if (plain, unit) == ("rad/s", "Hz"):
        return array / (2 * math.pi)
    try:
        return np.asarray(convert(array, plain, unit))
    except UnitError:
        return array


def _finite_or_nan(values: object) -> np.ndarray:
    array = np.asarray(np.nan if values is None else values, dtype=float)
    return np.where(np.isfinite(array), array, np.nan)


def pretty(unit: str) -> str:
    """A unit in print: powers raised, roots with their sign, nothing for the pure number."""
    unit, _ = _apart(unit)
    if unit in ("1", ""):
        return ""
    text = f"µ{unit[1:]}" if unit.startswith(("ug", "us", "uT")) else unit
    for power in ("^2", "^3"):
        text = text.replace(power, power[1:].translate(SCRIPTS))
    return (
        text.replace("sqrt(h)", "√h")
        .replace("sqrt(s)", "√s")
        .replace("sqrt(Hz)", "√Hz")
        .replace("degC", "°C")
    )


def number(value: object, digits: int = 3) -> str:
    """A number with so many figures, without exponent where that stays readable."""
    if value is None or not math.isfinite(value):
        return MISSING
    if value == 0.0:
        return "0"
    rounded = float(f"{value:.{digits - 1}e}")
    size = math.floor(math.log10(abs(rounded)))
    if not -4 <= size < 6:
        mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
        return f"{mantissa}×10{str(int(exponent)).translate(SCRIPTS)}"
    return f"{rounded:.{max(0, digits - 1 - size)}f}"


def quantity(value: object, si: str, digits: int = 3) -> str:
    """A value (SI) as people say it, unit included; a dash where there is none."""
    if value is None or not math.isfinite(value):
        return MISSING
    unit = unit_for(value, si)
    return f"{number(float(in_unit(value, si, unit)), digits)} {pretty(unit)}".rstrip()


def counted(count: int, noun: str) -> str:
    """``1 stop``, ``2 stops``."""
    return f"{count:,} {noun}{'' if count == 1 else 's'}"


def si_quantity(value: object, si: str, digits: int = 3) -> str:
    """The same in SI."""
    return f"{number(None if value is None else float(value), digits)} {pretty(si)}".rstrip()


def with_error(value: float, std: float) -> str:
    """``value`` and its standard error, rounded to two figures of the error.

    The value stands alone where there is no error.
    """
    if not math.isfinite(std) or std <= 0.0:
        return number(value, 4)
    size = math.floor(math.log10(max(abs(value), std)))
    if not -3 <= size < 6:
        return (
            f"({with_error(value / 10.0**size, std / 10.0**size)})×10{str(size).translate(SCRIPTS)}"
        )
    places = 1 - math.floor(math.log10(std))
    return f"{round(value, places):.{max(0, places)}f} ± {round(std, places):.{max(0, places)}f}"


def with_limits(value: float, low: float, high: float) -> str:
    """``1.02 (0.98 to 1.06)``, to two figures of the interval's width; the value stands alone
    where there is no interval.
    """
    if not (math.isfinite(low) and math.isfinite(high) and high > low):
        return number(value, 4)
    size = math.floor(math.log10(max(abs(low), abs(high))))
    if not -3 <= size < 6:
        scaled = (v / 10.0**size for v in (value, low, high))
        return f"{with_limits(*scaled)} ×10{str(size).translate(SCRIPTS)}"
    places = max(0, 1 - math.floor(math.log10(high - low)))
    value, low, high = (round(v, places) + 0.0 for v in (value, low, high))
    return f"{value:.{places}f} ({low:.{places}f} to {high:.{places}f})"


def joined(parts: Sequence[str]) -> str:
    """a, b and c."""
    return (
        parts[0] if len(parts) == 1 else f"{', '.join(parts[:-1])} and {parts[-1]}" if parts else ""
    )
