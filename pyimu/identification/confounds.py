"""What no log tells an effect from, said of a sensor that was looked at in certain logs."""

from __future__ import annotations

from collections.abc import Iterable

from pyimu.identification.fit.trial import Trial
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.effect import Effect
from pyimu.model.sensor import Sensor
from pyimu.report.numbers import joined


def what_no_log_tells_apart(e: Effect, sensor: Sensor, trials: Iterable[Trial]) -> str:
    """The note that goes with an effect of a sensor wherever it is named; empty where it has none.

    A turn of the whole triad is in doubt only where the reference's mounting is.
    """
    if e.mounting and not any(t.free_rotation for t in trials):
        return ""
    if e.delay is not None:
        return _of_delay(e, sensor)
    if e.confound is None:
        return ""
    return f"no log can tell it from {e.confound.of}; {e.confound.apart} would"


def _of_delay(e: Effect, sensor: Sensor) -> str:
    """Of a family that is known by its delay alone."""
    delay = float(e.delay(**{n: float(v) for n, v in sensor.values[e.name].items()}))
    names = [other.name for other in CATALOGUE.values() if other.family == e.family]
    apart = f"; {e.confound.apart} would tell the clock" if e.confound else ""
    return (
        f"{joined(names)} are one class: an effective delay of {delay * 1e3:.2f} ms of the "
        "sensor against the reference; the sensor's bandwidth, its sampling and the reference's "
        f"clock cannot be told apart{apart}"
    )
