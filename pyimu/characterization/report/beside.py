"""What was measured beside what a data sheet says."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from pyimu.characterization.noise.coefficients import Coefficient
from pyimu.characterization.outcome import SAMPLE, SI, Channel, Outcome
from pyimu.characterization.report.coefficients import (
    SAMPLE_UNIT,
    TERM_NAMES,
    UNITS,
    floor_cell,
    value_or_bound,
)
from pyimu.model.part import AXES, Part
from pyimu.model.tolerance import Tolerance
from pyimu.report.findings import SENSORS
from pyimu.report.lines import in_columns
from pyimu.report.numbers import MISSING, in_unit, number, pretty
from pyimu.report.page import Table, prose
from pyimu.shaping import flicker_floor

NOISES = {"N": ("angle_random_walk", "N"), "K": ("rate_random_walk", "K")}
"""The coefficients that data sheets print as such, and where a part has them."""


NO_BOUNDS = (False, False, False)


@dataclass(frozen=True)
class Compared:
    """One figure: what it is called, its unit, the data sheet's and the measured ones (x, y, z).

    ``times`` are the measured over the data sheet's, None where one of them is missing or none;
    ``bounds`` say which of the measured ones are upper bounds.
    """

    name: str
    unit: str
    sheet: str
    measured: tuple[str, ...]
    times: tuple[float | None, ...]
    bounds: tuple[bool, ...] = NO_BOUNDS

    @property
    def verdict(self) -> str:
        """The ratios of the axes, as ``0.97 to 1.3 times``; a dash where there is none."""
        found = [t for t in self.times if t is not None and np.isfinite(t)]
        if not found:
            return MISSING
        ends = list(dict.fromkeys(number(t, 2) for t in (min(found), max(found))))
        return f"{' to '.join(ends)} times"


def compared(c: Outcome, part: Part) -> dict[str, list[Compared]]:
    """The figures of each sensor that both the data sheet (``part``) and the logs have."""
    return {kind: [*_noise(c, part, kind), *_others(c, part, kind)] for kind in c.kinds}


def beside_lines(c: Outcome) -> list[str]:
    """The comparison for a terminal; empty without a data sheet."""
    if c.part_given is None:
        return []
    if c.no_part:
        return ["", f"not set beside {c.part_given.name}: {c.no_part}"]
    lines = ["", f"beside {c.part_given.name} ({c.part_given.description or 'no description'}):"]
    for kind, found in compared(c, c.part_given).items():
        head = (SENSORS[kind], "", "data sheet", *AXES, "measured over it")
        rows = [(f"  {v.name}", v.unit, v.sheet, *v.measured, v.verdict) for v in found]
        lines += in_columns([head, *rows]) if found else [f"{SENSORS[kind]}: no figure in common"]
    return lines


def beside_tables(c: Outcome) -> list[tuple[str, Table]]:
    """The comparison for the page, a table a sensor; empty without a data sheet or a part."""
    if c.part_given is None or c.no_part:
        return []
    tables = []
    for kind, found in compared(c, c.part_given).items():
        table = Table(("figure", "data sheet", *AXES, "measured over it"))
        for v in found:
            name = prose(f"{v.name} [{pretty(v.unit)}]")
            table.rows.append((name, v.sheet, *v.measured, v.verdict))
        tables.append((SENSORS[kind], table))
    return tables


def beside_entry(c: Outcome) -> dict[str, Any] | None:
    """The comparison for report.json; None without a data sheet or a part."""
    if c.part_given is None or c.no_part:
        return None
    sensors = {
        kind: [
            {
                "name": v.name,
                "unit": v.unit,
                "data_sheet": v.sheet,
                "measured": v.measured,
                "times": v.times,
                "upper_bound": v.bounds,
            }
            for v in found
        ]
        for kind, found in compared(c, c.part_given).items()
    }
    return {"part": c.part_given.name, **sensors}


def _noise(c: Outcome, part: Part, kind: str) -> Iterator[Compared]:
    values = part.sensor(kind).values
    for term, (effect, parameter) in NOISES.items():
        sheet = values.get(effect, {}).get(parameter)
        found = [c.coefficients.get((f"{kind}_{axis}", term)) for axis in AXES]
        if sheet is not None and np.any(sheet) and any(s is not None for s in found):
            si, unit = SI[kind][term], UNITS[kind][term]
            factor, name = 1.0, TERM_NAMES[kind][term]
            if (kind, term) == ("accel", "N"):  # data sheets of accelerometers print the density
                factor, name = np.sqrt(2), "noise density, one-sided"
            cells = [
                MISSING if s is None else value_or_bound(s.mean, si, unit, factor) for s in found
            ]
            times = [_ratio(s.mean, v) if s else None for s, v in zip(found, sheet, strict=True)]
            bounds = tuple(s is not None and not s.mean.needed for s in found)
            yield _row(name, unit, factor * in_unit(sheet, si, unit), cells, times, bounds)
    B = values.get("bias_instability", {}).get("B")
    floors = c.floors(kind)
    if B is not None and np.any(B) and any(floors):
        unit, printed = UNITS[kind]["B"], flicker_floor(1.0) * B
        bounds = tuple(any(f.bound for f in own) for own in floors)
        lowest = [
            np.mean([f.deviation for f in own]) if own and not bound else np.nan
            for own, bound in zip(floors, bounds, strict=True)
        ]
        yield _row(
            "lowest Allan deviation (bias stability)",
            unit,
            in_unit(printed, SAMPLE[kind], unit),
            [floor_cell(own, kind) for own in floors],
            [float(a / b) if b else None for a, b in zip(lowest, printed, strict=True)],
            bounds,
        )


def _ratio(c: Coefficient, sheet: float) -> float | None:
    return c.value / sheet if c.needed and sheet else None


def _others(c: Outcome, part: Part, kind: str) -> Iterator[Compared]:
    """The step of the samples, and of the gyro bias and its drift with temperature."""
    unit = SAMPLE_UNIT[kind]
    q = part.sensor(kind).values.get("quantization", {}).get("q")
    steps = {
        f.column[-1]: f.detail["step"]
        for f in c.findings
        if f.kind == "quantization_step" and f.column.startswith(kind)
    }
    if q is not None and np.any(q) and steps:
        cells = [_in(steps[a], kind, unit) if a in steps else MISSING for a in AXES]
        times = [steps[a] / v if a in steps and v else None for a, v in zip(AXES, q, strict=True)]
        yield _row("resolution", unit, in_unit(q, SAMPLE[kind], unit), cells, times)
    tolerances = {t.key[1]: t for t in part.tolerances if t.key[0] == kind}
    bias = tolerances.get("turn_on_bias")
    if kind == "gyro" and bias is not None:
        means = [_mean([ch.mean for ch in c.channel(f"gyro_{axis}")]) for axis in AXES]
        yield _within("bias, the Earth's rate in it", unit, SAMPLE[kind], bias, means)
    drift = tolerances.get("thermal_bias")
    if drift is not None:
        slopes = [
            _mean(
                [
                    ch.thermal.coefficients["kT"].value
                    for ch in c.channel(f"{kind}_{axis}")
                    if _drifts(ch)
                ]
            )
            for axis in AXES
        ]
        if any(np.isfinite(v) for v in slopes):
            si = f"{SAMPLE[kind]}/K"
            in_file = {"gyro": "deg/s/K", "accel": "mg/K"}[kind]
            yield _within("bias over temperature", in_file, si, drift, slopes)


def _drifts(ch: Channel) -> bool:
    return ch.thermal is not None and ch.thermal.order >= 1


def _mean(values: list[float]) -> float:
    return float(np.mean(values)) if values else np.nan


def _within(name: str, unit: str, si: str, t: Tolerance, values: list[float]) -> Compared:
    """Measured values beside the tolerance of the production that they are of."""
    sizes = (
        np.broadcast_to(np.asarray(t.sizes), 3) if len(t.sizes) in (1, 3) else np.full(3, np.nan)
    )
    return Compared(
        name,
        unit,
        t.size(3).replace("+-", "±"),
        tuple(number(float(v)) for v in in_unit(values, si, unit)),
        tuple(abs(v) / s if s else None for v, s in zip(values, sizes, strict=True)),
    )


def _row(
    name: str,
    unit: str,
    sheet: np.ndarray,
    cells: Sequence[str],
    times: Sequence[float | None],
    bounds: tuple[bool, ...] = NO_BOUNDS,
) -> Compared:
    texts = list(dict.fromkeys(number(float(v)) for v in sheet))
    said = texts[0] if len(texts) == 1 else ", ".join(number(float(v)) for v in sheet)
    return Compared(name, unit, said, tuple(cells), tuple(times), bounds)


def _in(value: float, kind: str, unit: str) -> str:
    return number(float(in_unit(value, SAMPLE[kind], unit)))
