"""The page ``docs/effects.md``: the catalogue of effects, written from the definitions."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from pages import DOCS, row, write_changed

from pyimu.model.arguments import Parameter
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.effect import Effect
from pyimu.model.kinds import STAGES
from pyimu.model.signals import EVERY_SAMPLE, LONGEST_HOLD
from pyimu.model.typical import CLASSES, Magnitude, documents, magnitudes

HEAD = """# The catalogue of effects

Written by `make generate` from the definitions in `pyimu/model/effects`; do not edit.

Each effect maps an input x to an output y; the effects of a sensor act one after another, by
stage: {stages}.
Every effect is the identity at its start values. w are independent standard normals, one a sample,
h is the sample period in seconds, f specific force, T temperature. In a unit, `{{y}}` stands for
the unit of the sensor's output (rad/s or m/s^2) and `{{Y}}` for that of its integral (rad or m/s).
The numbers in brackets give the shape; a parameter without one is a single number.

An effect that {every_sample} follows from the difference of successive inputs,
which is zero while they are held: a master of the co-simulation unit makes steps of one sample
then, or takes the block form. The rate of the temperature, which a master may refresh as seldom as
once in {longest:g} s, follows from its last two different values.

"Invertible" says what compensation makes of an effect: its input again ("yes", of a noise effect
with its noise zero), marks on the samples that say nothing of it ("no, marked"), or neither, so
that what the effect did stays in ("no, left in"); of a delay, a lag and a clock the attitude filter
undoes it by the samples' times. An input that is NaN gives NaN; a memory keeps what it held.

"""

SIZES = """## How large they are

One realistic size of each effect in a tactical and in a consumer MEMS part, not a specification of
any. In brackets the document (below) and the place in it, or "no source" and the reasoning of a
guess.

"""

COLUMNS = ("name", "term", "stage", "sensors", "equation", "parameters", "invertible", "source")


def documentation() -> str:
    """The page's text: a table with one row per effect, in the order in which they act."""
    effects = CATALOGUE.in_order(CATALOGUE.values())
    lines = [row(COLUMNS), row("---" for _ in COLUMNS), *(row(_cells(e)) for e in effects)]
    return (
        HEAD.format(stages=", ".join(STAGES), every_sample=EVERY_SAMPLE, longest=LONGEST_HOLD)
        + "\n".join(lines)
        + "\n\n"
        + _sizes(effects)
    )


def _sizes(effects: Iterable[Effect]) -> str:
    """How large each effect is in a tactical and in a consumer part, and which document says so."""
    lines = [
        row(("name", "sensor", "coefficient", *CLASSES)),
        row("---" for _ in range(3 + len(CLASSES))),
    ]
    for e in effects:
        for kind in e.sensors:
            found = magnitudes(e.name, kind)
            figures = [_size(found[c]) for c in CLASSES]
            lines.append(row((f"`{e.name}`", kind, f"`{found[CLASSES[0]].parameter}`", *figures)))
    keys = [f"- {key}: {text}" for key, text in documents().items()]
    return SIZES + "\n".join(lines) + "\n\nDocuments:\n\n" + "\n".join(keys) + "\n"


def _size(m: Magnitude) -> str:
    """A figure with what it goes with: "2.68 deg/h/sqrt(h) with tau = 1000 s (its source)"."""
    beside = ", ".join(f"{name} = {_figure(*figure)}" for name, figure in m.beside.items())
    return _figure(m.value, m.unit) + (f" with {beside}" if beside else "") + f" ({m.source})"


def _figure(value: float, unit: str) -> str:
    return f"{value:g} {unit if unit != '1' else ''}".strip()


def _cells(e: Effect) -> tuple[str, ...]:
    parameters = "; ".join(_parameter(name, q) for name, q in e.parameters.items())
    term = f"{e.term}; {EVERY_SAMPLE}" if e.differences else e.term
    return (
        f"`{e.name}`",
        term,
        e.stage,
        ", ".join(e.triads),
        f"${e.equation}$",
        parameters,
        _invertible(e),
        e.source,
    )


def _parameter(name: str, q: Parameter) -> str:
    shape = f" ({' x '.join(map(str, q.shape))})" if q.shape else ""
    start = f", start {q.start:.6g}" if q.start else ""
    return f"`{name}`{shape} [`{q.unit}`]: {q.description}{start}"


def _invertible(e: Effect) -> str:
    if e.invertible:
        return "yes, with its noise zero" if e.stochastic else "yes"
    return "no, left in" if e.left_in else "no, marked"


def write(folder: Path | str) -> list[Path]:
    """Write ``effects.md`` to a folder; gives its path, or nothing where that is what it held."""
    page = Path(folder) / "effects.md"
    return [page] if write_changed(page, documentation()) else []


if __name__ == "__main__":
    for path in write(DOCS):
        print(path)
