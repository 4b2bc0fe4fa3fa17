"""Whether logs can tell anything of a sensor: a reference that belongs to it, effects that they
would show, rows enough.
"""

from __future__ import annotations

import numpy as np

from pyimu.identification.fit.columns import in_band, residual
from pyimu.identification.fit.score import held_state
from pyimu.identification.fit.trial import Trial
from pyimu.identification.model.model_of import Found
from pyimu.identification.reference.belongs import too_little
from pyimu.identification.reference.clock import moves
from pyimu.identification.search.investigation import Investigation
from pyimu.model.catalogue import CATALOGUE


def unfit(found: Found) -> str:
    """Why a reference does not belong to its sensor; nothing where all do."""
    for inv in found.values():
        held = (t for t in inv.held if t.clock and moves(t))
        said = (too_little(t, _explained(inv, t)) for t in held)
        reason = inv.unfit or next(filter(None, said), "")
        if reason:
            return reason
    return ""


def _explained(inv: Investigation, trial: Trial) -> float:
    """Share of the sensor's power in the band, on held-out rows, that the model accounts for."""
    state, rest = held_state(inv.after, trial)
    axes = list(rest.axes)
    y = in_band(rest, rest.y[:, axes])
    left = in_band(rest, residual(inv.after.sensor, rest, state))[:, axes]
    power = float(np.sum((y - y.mean(axis=0)) ** 2)) if len(y) else 0.0
    return 1.0 - float(np.sum(left**2)) / power if power > 0.0 else 1.0


def shows_anything(found: Found) -> bool:
    """Whether some effect would be visible that time alone does not drive.

    Those show in any log, and say nothing about the effects that people ask for.
    """
    return any(
        np.isfinite(c.smallest_visible) and "time" not in CATALOGUE[c.effect].signals(kind)
        for kind, inv in found.items()
        for c in inv.first.candidates
    )


def rows_fitted(found: Found) -> int:
    """The rows that were there to fit, of the sensor that has most."""
    return max(sum(t.count for t in inv.after.trials) for inv in found.values())
