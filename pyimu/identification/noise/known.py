"""What is known of the noise of each axis before anything is looked for."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from pyimu.identification.fit.whiten import LEAST_VARIANCE, RandomWalk
from pyimu.identification.noise.cells import Cells
from pyimu.identification.noise.choose import Axis, State
from pyimu.identification.noise.laws import Kind, declared
from pyimu.identification.noise.motion import motion_cells
from pyimu.identification.noise.rows import Rows
from pyimu.identification.noise.spectrum import Bands, bands
from pyimu.model.catalogue import WALK, WHITE
from pyimu.model.sensor import Sensor

LEFT = 1 - 1e-6
"""Share of a noise that is left to the data by which it may fall."""


def state_of(
    sensor: Sensor,
    logs: dict[int, list[Rows]],
    fitted: dict[int, RandomWalk],
    kinds: Sequence[Kind],
    free: frozenset[str],
    added: np.ndarray,
) -> State:
    """The axes of a sensor under the noise that it declares, or as ``fitted`` where it is ``free``,
    with a variance ``added`` (3,) that is known from elsewhere.
    """
    made = {i: bands(rows) for i, rows in logs.items()}
    return State(
        {
            i: _axis(sensor, i, logs[i], b, fitted[i], kinds, free, float(added[i]))
            for i, b in made.items()
            if b is not None and i in fitted
        }
    )


def _axis(
    sensor: Sensor,
    i: int,
    logs: Sequence[Rows],
    b: Bands,
    fitted: RandomWalk,
    kinds: Sequence[Kind],
    free: frozenset[str],
    added: float,
) -> Axis:
    own = max(fitted.r - added, LEAST_VARIANCE)
    start = {WHITE[0]: np.sqrt(own * b.h), WALK[0]: np.sqrt(fitted.k2)}
    base, columns, least, had = np.full(len(b.count), LEAST_VARIANCE), [], [], {}
    for kind in (k for k in kinds if not k.follows):
        size, form = declared(kind, sensor, i)
        loose = kind.name in free or (kind.name == WHITE[0] and not size)
        size = start.get(kind.name, size) if loose else size
        had[kind.name] = size
        form = form if size and not loose else kind.forms[0]
        base = base + (kind.in_bands(b, form, size) if size else 0.0)
        if loose and kind.name in start:
            columns.append(kind.in_bands(b, form))
            least.append(-LEFT * size**2)
    base = base + b.turn * added
    cells = Cells(
        b.count,
        b.squares,
        base,
        np.array(columns).reshape(-1, len(base)),
        np.array(least, dtype=float),
    )
    following = [k for k in kinds if k.follows]
    moving = motion_cells(logs, fitted, following)
    motion, seen = moving if moving is not None else (None, np.zeros((0, 0)))
    order = {k.name: declared(k, sensor, i)[0] for k in following}
    return Axis(b, cells, motion, seen, {**order, **had})
