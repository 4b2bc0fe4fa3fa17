"""The terms of which a formula is made, and what each of them is worth over the rows of a log.

A term is written once, as an expression of casadi in the names of ``SYMBOLS``: its columns, and the
file that a user gets, are both made of that.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations_with_replacement

import numpy as np

from pyimu.identification.fit.sample_noise import white_noise
from pyimu.identification.fit.trial import Trial, known_to_all
from pyimu.identification.formula.levels import SHARES, Levels
from pyimu.model.arguments import AXES
from pyimu.model.kinds import KINDS
from pyimu.model.signals import COLUMNS, SIGNALS, START

SYMBOLS = {
    "rate": ("w", r"\omega"),
    "specific_force": ("f", "f"),
    "temperature": ("T", "T"),
    "supply": ("V", "V"),
    "mag": ("B", "B"),
    "time": ("t", "t"),
    "angular_acceleration": ("dw", r"\dot\omega"),
    "jerk": ("df", r"\dot f"),
    "temperature_rate": ("dT", r"\dot T"),
    "turned": ("angle", r"\vartheta"),
    "attitude": ("q", r"\psi"),
}
"""Of each signal that a term may hold: its name in the code of an effect, and in a formula. The
sensor's own signal is ``x`` in the code."""

SAID = {
    "rate": "rate",
    "specific_force": "specific force",
    "mag": "magnetic field",
    "angular_acceleration": "angular acceleration",
    "temperature_rate": "temperature rate",
    "turned": "angle turned about",
}

HELPERS = '''\
def following(v):
    """Of each axis the one that follows it."""
    return ca.vertcat(v[1], v[2], v[0])


def preceding(v):
    """Of each axis the one that precedes it."""
    return ca.vertcat(v[2], v[0], v[1])


def heading(q):
    """Counter-clockwise from east, of an attitude from body to east-north-up."""
    return ca.atan2(2 * (q[0] * q[3] + q[1] * q[2]), 1 - 2 * (q[2] ** 2 + q[3] ** 2))
'''

MOVES = 2.0**0.5
"""Times its own noise that a signal must spread: at least half of its power is then a signal."""

HARMONICS = 4
"""Highest harmonic of an angle that is tried."""

SLOPES = ("angular_acceleration", "jerk")

NAMED = frozenset({"angular_acceleration", "temperature_rate", "time"})
"""Signals of which a multiple alone is an effect of the catalogue. So is one of the rate of the
sensor's own signal: a delay, or a clock."""


@dataclass(frozen=True)
class Term:
    """A term as it adds to all axes: ``code`` has an expression for each of its columns, of one
    number for all axes or of three.

    ``unit`` is that of a column with ``{y}`` for the sensor's own; ``signals`` are those that it
    holds, ``inputs`` their components; ``size`` counts what a reader must take in. ``switch``
    is the number that switches at the ``level``, where there is one; ``angle`` is the
    code of the one whose sine and cosine the columns are.
    """

    text: str
    latex: tuple[str, ...]
    code: tuple[str, ...]
    unit: tuple[str, ...]
    signals: frozenset[str]
    size: int
    inputs: tuple[str, ...] = ()
    switch: Factor | None = None
    level: float = 0.0
    angle: str = ""
    factors: tuple[Factor, ...] = ()

    @property
    def each(self) -> bool:
        """Whether it is another number for each axis."""
        return any(f.each for f in self.factors)

    @property
    def origin(self) -> float | None:
        """The origin from which its surrounding is counted, where it has one."""
        return next((f.origin for f in self.factors if f.origin is not None), None)

    def along(self, own_unit: str) -> tuple[str, str, str]:
        """What the term is drawn against: its name, code and SI unit."""
        if self.angle:
            name = self.text.removeprefix("sin and cos of ").rpartition(" * ")[2]
            return name, self.angle, "rad"
        if self.switch is not None:
            return self.switch.text, self.switch.code, self.switch.unit.replace("{y}", own_unit)
        unit = " * ".join(f"({u})" for u in self.unit).replace("{y}", own_unit)
        return self.text, self.code[0], unit

    def in_text(self, number: int) -> str:
        """One of its columns in plain mathematics."""
        if self.angle:
            return f"{('sin', 'cos')[number]}({self.text.removeprefix('sin and cos of ')})"
        return self.text

    def coefficient_unit(self) -> str:
        """Unit of its coefficients."""
        left = list(self.unit)
        top = "{y}"
        if "{y}" in left:
            left.remove("{y}")
            top = "1"
        return top + "".join(f"/({u})" for u in left)


@dataclass(frozen=True)
class Factor:
    """One number, or one of each axis, of which terms are products."""

    text: str
    latex: str
    code: str
    unit: str
    signal: str
    names: tuple[str, ...] = ()
    each: bool = False
    origin: float | None = None


# What moves


def usable(trials: tuple[Trial, ...]) -> dict[str, tuple[int, ...]]:
    """The components of the known signals that move in the logs by more than their own noise."""
    known = known_to_all(trials)
    found = {}
    for name in SYMBOLS:
        if name not in known:
            continue
        if name in ("turned", "attitude", "time"):
            found[name] = tuple(range(SIGNALS[name].size))
            continue
        values = [t.u[:, COLUMNS[name]] for t in trials]
        together = np.concatenate(values)
        own = np.sqrt(
            np.mean(
                [
                    np.square(np.nan_to_num(white_noise(t, v)))
                    for t, v in zip(trials, values, strict=True)
                ],
                axis=0,
            )
        )
        spread, mean = together.std(axis=0), np.abs(together.mean(axis=0))
        moves = spread > np.maximum(MOVES * own, 1e-9 * (1 + mean))
        found[name] = tuple(map(int, np.flatnonzero(moves)))
    if "rate" in found and not found["rate"]:
        found.pop("turned", None)
        found.pop("attitude", None)
    return {n: at for n, at in found.items() if at}


def _origins(trials: tuple[Trial, ...], name: str) -> list[float]:
    """The origins from which a surrounding is counted: that of the catalogue, and the mean."""
    values = np.concatenate([t.u[:, COLUMNS[name]] for t in trials])
    start, mean = float(START[COLUMNS[name]][0]), float(values.mean())
    return [start, rounded(mean, float(values.std()))]


def rounded(value: float, spread: float) -> float:
    """A number to a hundredth of a spread, or a little finer."""
    return round(value, 3 - int(np.ceil(np.log10(max(spread, 1e-12)))))


def _single(name: str, component: int, own: str) -> Factor:
    symbol, latex = SYMBOLS[name]
    code = "x" if name == own else symbol
    unit = "{y}" if name == own else SIGNALS[name].unit
    if SIGNALS[name].size == 1:
        return Factor(name.replace("_", " "), latex, code, unit, name, (name,))
    said = SAID.get(name, name.replace("_", " "))
    axis = AXES[component]
    return Factor(
        f"{said} {axis}", f"{latex}_{axis}", f"{code}[{component}]", unit, name, (f"{name}_{axis}",)
    )


def _each(name: str, own: str) -> list[Factor]:
    """A signal of three axes, as each axis meets it: its own, the following, the preceding."""
    symbol, latex = SYMBOLS[name]
    code = "x" if name == own else symbol
    unit, said = "{y}" if name == own else SIGNALS[name].unit, SAID.get(name, name)
    said_of = (
        (f"own {said}", f"{latex}_i", code),
        (f"following axis' {said}", f"{latex}_{{i+1}}", f"following({code})"),
        (f"preceding axis' {said}", f"{latex}_{{i-1}}", f"preceding({code})"),
    )
    return [Factor(text, shown, of, unit, name, each=True) for text, shown, of in said_of]


def _surroundings(trials: tuple[Trial, ...], moving: Mapping) -> list[Factor]:
    names = [n for n in ("temperature", "supply") if n in moving]
    return [_counted(n, origin) for n in names for origin in _origins(trials, n)]


def _counted(name: str, origin: float) -> Factor:
    """A surrounding as it is counted from an origin."""
    symbol, latex = SYMBOLS[name]
    unit, shown = ("K", "degC") if name == "temperature" else (SIGNALS[name].unit, "V")
    text, code = f"({name} - {origin:g} {shown})", f"({symbol} - {origin!r})"
    set_ = f"({latex} - {origin:g})"
    return Factor(text, set_, code, unit, name, (name,), origin=origin)


def at_origin(term: Term, origin: float) -> Term:
    """The same term with its surrounding counted from another origin."""
    moved = (f if f.origin is None else _counted(f.signal, origin) for f in term.factors)
    return _product(tuple(moved))


# The library


def library(kind: str, trials: tuple[Trial, ...]) -> list[Term]:
    """All terms that the logs of a sensor of this ``kind`` can be tried against."""
    moving, own = usable(trials), KINDS[kind].own
    vectors = [n for n in ("rate", "specific_force", "mag") if n in moving]
    numbers = [_single(n, i, own) for n in vectors for i in moving[n]]
    warm = _surroundings(trials, moving)
    slopes = [
        _single(n, i, own)
        for n in ("angular_acceleration", "jerk", "temperature_rate", "time")
        for i in moving.get(n, ())
    ]
    each = {n: _each(n, own) for n in vectors if len(moving[n]) > 1}
    terms = [_product(p) for p in combinations_with_replacement(numbers, 2)]
    terms += [_product((a, b)) for a in warm for b in numbers]
    terms += [_product((a, a)) for a in warm] + [_product((a, a, a)) for a in warm]
    terms += [_product((a, a, b)) for a in numbers for b in numbers]
    terms += [_product((a, b)) for i, a in enumerate(slopes) for b in numbers]
    named = NAMED | {KINDS[kind].own_rate}
    terms += [_product((a,)) for a in slopes if a.signal not in named]
    for name, three in each.items():
        terms += [_product(p) for p in combinations_with_replacement(three, 2)]
        terms += [_product((a, b)) for a in warm for b in three]
        terms += [_product((a, *p)) for a in warm for p in combinations_with_replacement(three, 2)]
        others = [f for n, fs in each.items() if n > name for f in fs]
        terms += [_product((a, b)) for a in three for b in others]
        terms += [_absolute(f) for f in three]
    terms += [_absolute(f) for f in numbers]
    terms += _harmonics(moving)
    terms += _switches(trials, moving, own)
    return list({t.text: t for t in terms}.values())


def simple(kind: str, trials: tuple[Trial, ...]) -> list[Term]:
    """Numbers that move, their sizes, and harmonics of angles: what a residual may follow by a
    share that is no constant.
    """
    moving, own = usable(trials), KINDS[kind].own
    vectors = [n for n in ("rate", "specific_force", "mag", *SLOPES) if n in moving]
    numbers = [_single(n, i, own) for n in vectors for i in moving[n]]
    return [*(_product((f,)) for f in numbers), *map(_absolute, numbers), *_harmonics(moving)]


def _product(factors: tuple[Factor, ...]) -> Term:
    powers = {f: factors.count(f) for f in factors}
    raised = [(f, f"^{n}" if n > 1 else "", f" ** {n}" if n > 1 else "") for f, n in powers.items()]
    return Term(
        " * ".join(f.text + up for f, up, _ in raised),
        (r"\,".join(f.latex + up for f, up, _ in raised),),
        (" * ".join(f.code + code for f, _, code in raised),),
        tuple(f.unit for f in factors),
        frozenset(f.signal for f in factors),
        len(factors),
        tuple(dict.fromkeys(n for f in factors for n in f.names or (f.signal,))),
        factors=factors,
    )


def _absolute(f: Factor) -> Term:
    return Term(
        f"|{f.text}|",
        (rf"|{f.latex}|",),
        (f"ca.fabs({f.code})",),
        (f.unit,),
        frozenset({f.signal}),
        2,
        f.names or (f.signal,),
        factors=(f,),
    )


def _harmonics(moving: Mapping[str, tuple[int, ...]]) -> list[Term]:
    angles = []
    if "turned" in moving:
        symbol, latex = SYMBOLS["turned"]
        for i in moving.get("rate", ()):
            axis = AXES[i]
            text, of = f"angle turned about {axis}", (f"turned_{axis}",)
            angles.append((text, f"{latex}_{axis}", f"{symbol}[{i}]", "turned", of))
        text = "angle turned about the own axis"
        angles.append((text, f"{latex}_i", symbol, "turned", ("turned",)))
    if "attitude" in moving:
        angles.append(("heading", SYMBOLS["attitude"][1], "heading(q)", "attitude", ("heading",)))
    return [
        Term(
            f"sin and cos of {n if n > 1 else ''}{' * ' if n > 1 else ''}{text}",
            tuple(rf"\{g}({n if n > 1 else ''}{latex})" for g in ("sin", "cos")),
            tuple(f"ca.{g}({n} * {code})" for g in ("sin", "cos")),
            (),
            frozenset({signal}),
            1 + n,
            inputs,
            angle=code,
            factors=(Factor(text, latex, code, "rad", signal, each=inputs == ("turned",)),),
        )
        for text, latex, code, signal, inputs in angles
        for n in range(1, HARMONICS + 1)
    ]


def _switches(trials, moving, own: str) -> list[Term]:
    """A step at each of some levels of each number that moves, of its slope (not at zero, where it
    would follow the noise of a reference at rest), and of the size of a vector.
    """
    out = []
    for name in (n for n in ("rate", "specific_force", *SLOPES) if n in moving):
        values = np.concatenate([t.u[a:b, COLUMNS[name]] for t in trials for a, b in t.segments])
        shares = SHARES[::2] if name in SLOPES else SHARES
        for i in moving[name]:
            f = _single(name, i, own)
            out += [switch(f, level) for level in Levels.of(values[:, i]).at(shares)]
        if len(moving[name]) > 1 and name not in SLOPES:
            f = _size_of(name, own)
            sizes = np.linalg.norm(values, axis=1)
            out += [switch(f, level) for level in Levels.of(sizes).at(SHARES)]
    return out


def _size_of(name: str, own: str) -> Factor:
    symbol, latex = SYMBOLS[name]
    code = "x" if name == own else symbol
    unit = "{y}" if name == own else SIGNALS[name].unit
    said = "angular rate" if name == "rate" else "specific force"
    return Factor(f"size of the {said}", rf"\|{latex}\|", f"ca.norm_2({code})", unit, name)


def switch(f: Factor, level: float) -> Term:
    """1 where a number is above a level, and 0 below."""
    level = float(f"{level:.4g}")
    unit = SIGNALS[f.signal].unit
    return Term(
        f"[{f.text} > {level:g} {unit}]",
        (rf"[{f.latex} > {level:g}]",),
        (f"ca.if_else({f.code} > {level!r}, 1, 0)",),
        (),
        frozenset({f.signal}),
        2,
        f.names or (f.signal,),
        f,
        level,
        factors=(f,),
    )
