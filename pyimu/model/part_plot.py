"""A part's noise over cluster time. ``part`` is a ``Part``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pyimu.display import notebook
from pyimu.errors import UserError
from pyimu.model.deviations import flicker_floor, law_deviation
from pyimu.model.law import Law
from pyimu.model.sensor import Sensor
from pyimu.units import STANDARD_GRAVITY, convert

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PEOPLE = {"gyro": "deg/h", "accel": "mg"}
"""Units in which people read an Allan deviation."""

LONGEST = 1e5
"""s; the longest cluster time that is drawn."""

POINTS = 80

MARKED = {
    ("angle_random_walk", "N"): (1.0, lambda N: N),
    ("rate_random_walk", "K"): (3.0, lambda K: K),
    ("bias_instability", "B"): (None, flicker_floor),
}
"""Where data sheets' figures lie: at a cluster time [s], or along all of it, and how high."""


def plot(part: Any) -> Figure:
    """The Allan deviation of the part's noise at rest, level, a panel a sensor, in deg/h and mg.

    Thick, all of its noise, an axis a line where they differ; thin, each of its effects, of the
    worst axis; marked, the figures of the data sheet as printed: N at 1 s, K at 3 s, and the floor
    0.664 B. Coefficients that are left to the data are left out. Raises UserError for a part
    without noise.
    """
    from matplotlib.figure import Figure

    noises = {s.kind: _noises(part, s) for s in (part.gyro, part.accel)}
    noises = {kind: each for kind, each in noises.items() if each}
    if not noises:
        raise UserError(f"part {part.name}: declares no noise, there is nothing to draw")
    figure = Figure(figsize=(8.0, 0.8 + 3.2 * len(noises)), layout="constrained")
    panels = figure.subplots(len(noises), 1, squeeze=False)[:, 0]
    for panel, (kind, each) in zip(panels, noises.items(), strict=True):
        _panel(panel, part, part.sensor(kind), each)
    panels[-1].set_xlabel("cluster time [s]")
    figure.suptitle(f"{part.name}: Allan deviation")
    return notebook.shown(figure)


def _noises(part: Any, sensor: Sensor) -> dict[str, np.ndarray]:
    """Allan deviations (3, n) of each noise of a sensor whose size is declared."""
    found = {}
    for e in sensor.effects:
        if e.law is not None and not any(k[:2] == (sensor.kind, e.name) for k in part.estimate):
            deviations = _deviations(sensor, e.name, e.law, part.sample_period)
            if np.any(deviations):
                found[e.name] = deviations
    return found


def _tau(h: float) -> np.ndarray:
    return np.geomspace(h, max(LONGEST, 10 * h), POINTS)


def _deviations(sensor: Sensor, effect: str, law: Law, h: float) -> np.ndarray:
    """Allan deviations (3, n) of one effect, those of axes that are alike computed once."""
    known: dict[tuple, np.ndarray] = {}
    rows = []
    for axis in range(3):
        own = sensor.of_axis(effect, axis)
        rests = STANDARD_GRAVITY if sensor.kind == "accel" and axis == 2 else 0.0
        x = rests if law.needs("x") else 0.0
        key = (*own.values(), x)
        if key not in known:
            known[key] = law_deviation(law, own, _tau(h), h, x)
        rows.append(known[key])
    return np.array(rows)


def _panel(panel: Axes, part: Any, sensor: Sensor, each: dict[str, np.ndarray]) -> None:
    unit, tau, si = PEOPLE[sensor.kind], _tau(part.sample_period), sensor.output.unit
    whole = np.sqrt(sum(d**2 for d in each.values()))
    for name, deviation in each.items():
        panel.plot(tau, convert(deviation.max(axis=0), si, unit), lw=0.9, label=name)
    alike = bool(np.allclose(whole, whole[0]))
    for axis, deviation in zip("xyz", whole[:1] if alike else whole, strict=False):
        label = "all" if alike else f"all, {axis}"
        panel.plot(tau, convert(deviation, si, unit), lw=2.0, alpha=0.7, label=label)
    _marks(panel, part, sensor, unit)
    seen = convert(whole, si, unit)
    panel.set(xscale="log", yscale="log", ylabel=f"{sensor.kind} [{unit}]")
    panel.set_ylim(seen.min() / 5, seen.max() * 2)
    panel.grid(alpha=0.25)
    panel.legend(fontsize="small", frameon=False)


def _marks(panel: Axes, part: Any, sensor: Sensor, unit: str) -> None:
    """The figures of the data sheet, as printed."""
    for (effect, name), (tau, height) in MARKED.items():
        key = (sensor.kind, effect, name)
        value = sensor.values.get(effect, {}).get(name)
        if value is None or key in part.estimate or not np.any(value):
            continue
        at = convert(float(height(np.max(value))), sensor.output.unit, unit)
        label = f"{name}: {part.notes.get(key, {}).get('quoted') or 'as declared'}"
        if tau is None:
            panel.axhline(at, color="0.4", lw=0.9, ls="--", label=label)
        else:
            panel.plot([tau], [at], "o", color="0.2", label=label)
