"""What was found judged by the attitude that a filter makes of it: what makes that worse is taken
back.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from pyimu.attitude.error import LOST, AttitudeError
from pyimu.identification.errors.heading_error import FAR, with_better_heading
from pyimu.identification.errors.held_out import WINDOW, attitudes, worlds
from pyimu.identification.fit.errors_in_variables import equations
from pyimu.identification.fit.fit import Fit, with_prior
from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.fit.score import tally
from pyimu.identification.fit.trial import Trial
from pyimu.identification.model.model_of import Found, Model, model_of
from pyimu.identification.search.confirm import evidence
from pyimu.identification.search.investigation import Investigation
from pyimu.identification.search.screen import fitted_dispersion
from pyimu.identification.search.taken_back import less_of_baseline, without
from pyimu.identification.verdict.fates import TAKEN_BACK
from pyimu.identification.verdict.verdict import WORSE
from pyimu.model.catalogue import WALK
from pyimu.model.part import Part
from pyimu.numerics.laws import norm, t
from pyimu.recording.recording import Recording

CALIBRATION = ("scale_factor", "misalignment")
"""Effects of the baseline that turn the gyro's rate into that of the body."""

LEAST_WINDOWS, CHANCE = 3, 0.05
"""Windows from which on it is asked whether an error has grown by chance, and how rarely chance may
do as much."""


def settled(
    start: Part, declared: Part | None, found: Found, logs: list[Recording]
) -> tuple[Found, Model, tuple[float, float] | None, tuple[str, ...]]:
    """What was found less the effects that make the filter's attitude, or the heading, worse.

    Gives the model that it makes, too, the attitude's error before and after, and what is to be
    said: of each log in which both are lost, so that they are not compared, and of each reference
    whose world is not level.
    """
    if "gyro" in found:
        found = found | {"gyro": with_better_heading(found["gyro"])}
    model, inv = model_of(start, declared, found), found.get("gyro")
    logs, leaning = _levelled(inv, logs)
    while True:
        old, new = (_as_filed(p, declared) for p in (model.before, model.after))
        before, after = attitudes(old, inv, logs, before=True), attitudes(new, inv, logs)
        lost = [n for n in before if before[n].is_lost and after[n].is_lost]
        said = leaning + tuple(_lost(n, before[n], after[n]) for n in lost)
        kept = [n for n in before if n not in lost]
        if not kept:
            return found, model, None, said
        was, now = (_pooled(e, kept) for e in (before, after))
        worse = now > WORSE * was and not _by_chance(before, after, kept)
        worst = _worst(new, inv, logs, kept, now) if worse else None
        # Scale factors that are left out may make all the difference.
        bare = _less_calibration(start, declared, found, logs, kept, after)
        left = now if bare is None else bare.error
        if worst is None or left <= WORSE * was:
            if bare is None:
                return found, model, (was, now), said
            return bare.found, bare.model, (was, left), (*said, bare.said)
        name, error = worst
        degrees = [f"{np.degrees(v):.2f}" for v in (error, now)]
        reason = f"{TAKEN_BACK}, {degrees[0]} to {degrees[1]} deg"
        found = found | {"gyro": without(inv, name, reason)}
        model, inv = model_of(start, declared, found), found["gyro"]


def _levelled(
    inv: Investigation | None, logs: list[Recording]
) -> tuple[list[Recording], tuple[str, ...]]:
    """The logs with references whose worlds are level, and what is to be said of those that were
    not.
    """
    of = worlds(inv, logs)
    level = [of[r.name].levelled(r) if r.name in of else r for r in logs]
    return level, tuple(
        f"the world of ref_q in {name} is not level: {world.said}; it was turned to compare the "
        "attitude, and no other number depends on it"
        for name, world in of.items()
    )


@dataclass(frozen=True)
class _Bare:
    """What is found without some of the baseline, the model and the attitude's error [rad] that
    this makes, and what is to be said.
    """

    found: Found
    model: Model
    error: float
    said: str


def _less_calibration(
    start: Part,
    declared: Part | None,
    found: Found,
    logs: list[Recording],
    kept: list[str],
    after: dict[str, AttitudeError],
) -> _Bare | None:
    """What is found without the gyro's scale factor and axes, where these make the attitude
    ``after`` worse, by more than chance, and its rate shows nothing of them; None elsewhere.

    They are the baseline's, which nobody declared, and what a gyro that is not quite linear shows
    at the speed of the fitted logs: at another one they may be further off than none. Most of an
    attitude's error may be acceleration that its filter takes for gravity, though, which tells
    nothing of a gyro: what held-out rates bear out stays.
    """
    inv = found.get("gyro")
    names = [n for n in CALIBRATION if declared is None and inv and n in inv.after.sensor.values]
    if not names:
        return None
    less = less_of_baseline(inv, names)
    found = found | {"gyro": less}
    model, now = model_of(start, declared, found), _pooled(after, kept)
    errors = attitudes(_as_filed(model.after, declared), less, logs)
    error = _pooled(errors, kept)
    grows = WORSE * error < now and _chance(errors, after, kept) <= CHANCE
    if not grows or rate_bears_out(less.after, inv.after, inv.held):
        return None
    degrees = [f"{np.degrees(v):.2f}" for v in (now, error)]
    said = (
        f"the gyro's {' and '.join(n.replace('_', ' ') for n in names)} are left out of the model: "
        f"the attitude is better without them, {degrees[0]} to {degrees[1]} deg, and held-out "
        "rates do not speak for them"
    )
    return _Bare(found, model, error, said)


def rate_bears_out(less: Fit, more: Fit, held: Sequence[Trial]) -> bool:
    """Whether held-out rates speak for the coefficients that one model has more than another one,
    or their integral over seconds is the nearer to the reference's angle.

    Held-out rows are another draw than those that were fitted: were the smaller model the true one,
    their likelihood ratio would have the mean 1, and be beyond 1/p with a chance of p at most
    (Markov's inequality).
    """
    normal = with_prior(equations(more), more)
    keys = sorted(k for k in more.free - less.free if isinstance(k, Coefficient))
    gained = evidence(less, more, held).gained.sum() / fitted_dispersion(normal, keys)
    if gained > -np.log(CHANCE):
        return True
    trials = [t for t in held if t.reduction is None]
    angles = (sum(tally(f, t).angle_squares.sum() for t in trials) for f in (less, more))
    return bool(next(angles) > next(angles))


def _as_filed(part: Part, declared: Part | None) -> Part:
    """The part with its gyro's walk as ``as_part`` will have it: left out where nobody declared one
    and the logs do not show it.
    """
    if declared is not None or WALK[0] not in part.gyro.values or part.gyro.acts(WALK[0]):
        return part
    return _part_without(part, WALK[0])


def _worst(
    part: Part, inv: Investigation, logs: list[Recording], kept: list[str], now: float
) -> tuple[str, float] | None:
    """The added effect without which the attitude is best, and its error then.

    None where it is then hardly better than ``now``.
    """
    errors = {
        name: _pooled(attitudes(_part_without(part, name), inv, logs), kept)
        for name in inv.removable
    }
    worst = min(errors, key=errors.get, default=None)
    return (worst, errors[worst]) if worst and WORSE * errors[worst] < now else None


def _part_without(part: Part, effect: str) -> Part:
    return part.with_sensor(part.gyro.without(effect))


def _pooled(errors: dict[str, AttitudeError], names: list[str]) -> float:
    """RMS error [rad] over the rows of some logs."""
    return float(np.sqrt(np.mean(np.concatenate([errors[n].total for n in names]) ** 2)))


def _by_chance(
    before: dict[str, AttitudeError], after: dict[str, AttitudeError], names: list[str]
) -> bool:
    """Whether the error grew by no more than it differs from window to window, where a few windows
    cannot tell, and not far; or by a change that meets the error that is left by chance, short of
    an attitude that is lost.
    """
    was, now = (_pooled(e, names) for e in (before, after))
    as_windows = now < FAR * was and _chance(before, after, names) > CHANCE
    return as_windows or (now < LOST and _meets(before, after, names) > CHANCE)


def _meets(
    before: dict[str, AttitudeError], after: dict[str, AttitudeError], names: list[str]
) -> float:
    """How often a change of the tilt would go as much the way of the error that is left, if the two
    had nothing to do with each other.

    An accelerometer's constant error tilts all of a log one way. What is right of a gyro changes
    the tilt any way: where it did away with a part of that by chance, the error grows, in each
    window alike. So a log tells one direction, uniform over the circle, whose cosine has a mean
    square of a half.
    """
    cosines = []
    for n in names:
        was, now = before[n].at(after[n].time), after[n].at(before[n].time)
        change = now.tilt - was.tilt
        size = np.linalg.norm(change) * np.linalg.norm(now.tilt)
        cosines.append(float(np.sum(change * now.tilt) / size) if size else 1.0)
    if len(cosines) == 1:
        return float(np.arccos(min(cosines[0], 1.0)) / np.pi)
    return float(norm.sf(sum(cosines) * np.sqrt(2.0 / len(cosines))))


def _chance(
    before: dict[str, AttitudeError], after: dict[str, AttitudeError], names: list[str]
) -> float:
    """How often chance would make an error grow by as much (Student's test of the mean squares of
    its windows in pairs); NaN of a few windows, and where none changed.

    What undoes a delay or a lag knows no truth of a log's last rows: those count that both have.
    """
    grown = np.concatenate(
        [
            after[n].at(before[n].time).powers(WINDOW) - before[n].at(after[n].time).powers(WINDOW)
            for n in names
        ]
    )
    if len(grown) < LEAST_WINDOWS or not np.any(grown):
        return float("nan")
    error = np.std(grown, ddof=1) / np.sqrt(len(grown))
    return float(t.sf(np.mean(grown) / error, len(grown) - 1))


def _lost(name: str, before: AttitudeError, after: AttitudeError) -> str:
    degrees = [f"{np.degrees(e.rms):.0f}" for e in (before, after)]
    return (
        f"the filter loses the attitude of {name}, before ({degrees[0]} deg) and after "
        f"({degrees[1]} deg): not compared"
    )
