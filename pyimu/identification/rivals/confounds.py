"""What no log tells an effect from, said of a sensor that was looked at in certain logs."""

from __future__ import annotations

from collections.abc import Collection, Iterable

from pyimu.identification.fit.trial import Trial
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.effect import Effect
from pyimu.model.sensor import Sensor
from pyimu.report.numbers import joined


def what_no_log_tells_apart(
    e: Effect, sensor: Sensor, trials: Iterable[Trial], alternatives: Collection[str] | None = None
) -> str:
    """The note that goes with an effect of a sensor wherever it is named, if it has one."""
    trials = list(trials)
    own = _own_confound(e, sensor, trials, alternatives)
    return "; ".join(filter(None, (own, _of_places(e, trials), _of_heading(e, trials))))


def _of_heading(e: Effect, trials: Iterable[Trial]) -> str:
    """Of the scale of a gyro beside headings alone, which wheels may have counted."""
    if e.name != "scale_factor" or {t.reference for t in trials} != {"heading"}:
        return ""
    return (
        "a heading that was counted from wheels has the error of their track width as a scale of "
        "its own; turns by whole revolutions, back to a mark, would tell"
    )


def _of_places(e: Effect, trials: Iterable[Trial]) -> str:
    """Of a gain beside a force that was made of positions or velocities."""
    places = [t.place for t in trials if t.place is not None and t.place.gravity_std > 0.0]
    if e.stage != "gain" or e.mounting or not places:
        return ""
    fitted = ", which were fitted beside it," if all(p.scale_std for p in places) else ""
    return (
        f"positions of another size{fitted or ','} as a single camera's odometry has them by some "
        "percent, show much the same of a body that keeps level; its six faces at rest would tell"
    )


def _own_confound(
    e: Effect, sensor: Sensor, trials: Iterable[Trial], alternatives: Collection[str] | None
) -> str:
    """What the effect itself is not told from.

    A turn of the whole triad is in doubt only where the reference's mounting is, and another form
    of a delay where it is among the ``alternatives``, if these are known.
    """
    if e.mounting and not any(t.free_rotation for t in trials):
        return ""
    if e.delay is not None:
        hidden = any(t.clock is not None and t.clock.apart for t in trials)
        return _beside_clock(e, sensor) if hidden else _of_delay(e, sensor, alternatives)
    if e.confound is None:
        return ""
    return f"no log can tell it from {e.confound.of}; {e.confound.apart} would"


def _beside_clock(e: Effect, sensor: Sensor) -> str:
    """Of a lag that was found beside clocks that were fitted with it."""
    return (
        f"it is told by how it damps what is quick; its delay, {_delay_of(e, sensor)}, is one with "
        "the reference's clock, which was fitted beside it; samples that were filtered without "
        "delay, or a reference that is turned ahead of its time, would show the same, and so would "
        "one that says what the body was told to do, or is taken before a gear that gives"
    )


def _delay_of(e: Effect, sensor: Sensor) -> str:
    return f"{sensor.delay(e.name) * 1e3:.2f} ms"


def _of_delay(e: Effect, sensor: Sensor, alternatives: Collection[str] | None) -> str:
    """Of a family that is known by its delay alone, but for forms that the data tell."""
    family = [other.name for other in CATALOGUE.values() if other.family == e.family]
    some = [n for n in family if alternatives is None or n in alternatives or n == e.name]
    apart = f"; {e.confound.apart} would tell the clock" if e.confound else ""
    late = f"an effective delay of {_delay_of(e, sensor)} of the sensor against the reference"
    if len(some) == 1:
        return f"{late}, of which the reference's clock may hold a part{apart}"
    return (
        f"{joined(some)} are one class: {late}; the sensor's bandwidth, its sampling and the "
        f"reference's clock cannot be told apart{apart}"
    )
