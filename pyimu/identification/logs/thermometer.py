"""What a model that follows temperature shows of the thermometers beside it."""

from __future__ import annotations

import numpy as np

from pyimu.errors import Finding
from pyimu.identification.fit.clock import WIDE
from pyimu.identification.fit.keys import LogLag
from pyimu.identification.search.investigation import Investigation


def late_thermometers(inv: Investigation) -> list[Finding]:
    """The logs whose thermometer follows the sensor's temperature late, by more than chance.

    A sensor that answers to the rate of its temperature, on all axes in proportion to its thermal
    bias, looks the same; the thermometer is the commoner.
    """
    found = []
    for t in inv.after.trials:
        late, std = inv.after.states[t.name].lag, inv.after.std.get(LogLag(t.name), np.inf)
        if abs(late) > WIDE * std:
            detail = {"recording": t.name, "late": float(late), "late_std": float(std)}
            found.append(Finding("thermometer_late", "temperature", 1, detail))
    return found
