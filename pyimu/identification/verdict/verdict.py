"""What the numbers together say: the verdict of a closed loop, and why."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from pyimu.identification.fit.score import WINDOW
from pyimu.identification.formula.constancy import REST
from pyimu.identification.found.entries import Added, Changed, Errors
from pyimu.identification.search.investigation import AS_NOISE, AS_ROUNDING, Refused
from pyimu.identification.search.judge import OF_REFERENCE
from pyimu.identification.search.leftover import Unexplained
from pyimu.identification.search.rounded import OF_DIGITS
from pyimu.identification.verdict.fates import NOT_LOOKED_FOR, Fate
from pyimu.model.catalogue import CATALOGUE, WALK, WHITE
from pyimu.numerics.laws import chi2
from pyimu.report.numbers import joined, number

FAR = 3.0
"""Ratio of the held-out error to its floor from which on more than noise is left."""

CHANCE = 0.01
"""Probability with which one of the axes and logs of a result may lie beyond their limit by chance:
what a random walk adds to a mean is one draw for each of them."""

SHORT = 500
"""Fitted rows below which finding nothing says nothing."""

FEW = 3
"""Effects, and reasons, of which each is named in a remark; of more their number is said."""

WORSE = 1.02
"""Ratio of the attitude errors after and before from which on the model is worse for attitude."""

NO_EFFECT = (AS_NOISE, AS_ROUNDING, OF_DIGITS, OF_REFERENCE)
"""Reasons to refuse an effect that say what made it look like one."""

FORCE = frozenset({"specific_force", "vibration", "jerk"})
"""What an accelerometer feels, and an effect of a gyro may follow."""

VERDICTS = (
    "reference_unfit",
    "named",
    "partly",
    "not_confirmed",
    "unexplained",
    "drift",
    "clean",
    "undecidable",
)


@dataclass(frozen=True)
class Verdict:
    """One of ``VERDICTS``, the reason for it, and what must be said beside it."""

    word: str
    reason: str
    remarks: tuple[str, ...] = ()


@dataclass(frozen=True)
class Evidence:
    """What a verdict goes by.

    ``unfit`` says why a reference does not belong to its sensor; ``examined`` are the sensors that
    were looked at, ``unexamined`` says of each other sensor of the logs why not; ``shows`` is
    whether the logs would show any effect that more than time drives, ``rows`` how many were
    fitted. ``errors`` are those of a sensor in all logs, ``by_log`` in each, ``band_hz`` the band
    in which they are. ``fates`` says what became of the candidates, ``beside`` is the verdict on
    the magnetometer where there is something to say, ``lost`` of which logs the attitude is lost;
    ``ranges`` which samples lie beyond a declared range, ``clocks`` what was taken out of the
    references, ``formulas`` by name how a formula is said,
    ``unshown`` which coefficients the positions at rest do not show, ``dead`` which axes show one
    value all the time; ``rounded`` is whether the rounding of a reference looks like an error of
    the sensor.
    """

    examined: tuple[str, ...]
    unexamined: Mapping[str, str]
    unfit: str
    shows: bool
    rows: int
    added: tuple[Added, ...] = ()
    changed: tuple[Changed, ...] = ()
    unexplained: tuple[Unexplained, ...] = ()
    drift: Mapping[str, Mapping[int, float]] = field(default_factory=dict)
    refused: tuple[tuple[str, Refused], ...] = ()
    fates: tuple[Fate, ...] = ()
    errors: Mapping[str, Errors] = field(default_factory=dict)
    by_log: Mapping[str, Mapping[str, Errors]] = field(default_factory=dict)
    band_hz: Mapping[str, float | None] = field(default_factory=dict)
    beside: Verdict | None = None
    attitude: tuple[float, float] | None = None
    lost: tuple[str, ...] = ()
    ranges: tuple[str, ...] = ()
    clocks: tuple[str, ...] = ()
    formulas: Mapping[str, str] = field(default_factory=dict)
    unshown: tuple[str, ...] = ()
    dead: tuple[str, ...] = ()
    rounded: bool = False
    shaken: str = ""


def verdict(e: Evidence) -> Verdict:
    """The verdict, with what must be said beside it."""
    found = _verdict(e)
    clocks = e.clocks if found.word != "reference_unfit" else ()
    beside = (*_growing_attitude(e.attitude), *e.lost, *e.unexamined.values())
    return replace(found, remarks=(*e.ranges, *clocks, *found.remarks, *beside))


def _verdict(e: Evidence) -> Verdict:
    if e.unfit:
        return Verdict("reference_unfit", e.unfit)
    left, shapes = left_of(e), [u for u in e.unexplained if u.shape]
    if e.added and all(a.effect in e.formulas for a in e.added):
        said = joined([f"{a.sensor}: {e.formulas[a.effect]}" for a in e.added])
        why = f"no effect of the catalogue describes it, a formula does: {said}"
        return Verdict("unexplained", why, (left,) if left else ())
    if e.added:
        names = ", ".join(f"{a.sensor} {a.effect}" for a in e.added)
        if left or any(_is_much(u, e.added) for u in e.unexplained):
            return Verdict("partly", names, (left,) if left else ())
        return Verdict("named", names, tuple(filter(None, [open_of(e)])))
    if shapes:
        u = shapes[0]
        return Verdict("unexplained", f"{u.sensor} {u.axis} shows {u.shape}")
    refused = [r for r in e.refused if r[1].reason not in NO_EFFECT]
    if refused:
        kind, most = max(refused, key=lambda r: r[1].gain)
        gain = f"{kind} {most.effect} explains the fitted rows ({most.gain:.0f} nat)"
        shaken = e.shaken if kind == "gyro" and _of_force(most.effect) else ""
        return Verdict(
            "not_confirmed", "; ".join(filter(None, [f"{gain}, but {most.reason}", shaken]))
        )
    if e.unexplained:
        u = e.unexplained[0]
        does = f"depends on {' x '.join(u.depends_on)}"
        return Verdict("unexplained", f"{u.sensor} {u.axis} {does}")
    if any(e.drift.values()):
        why = "more random walk than declared, and nothing logged that it is seen to follow"
        return Verdict("drift", why, instead(e.changed))
    return _nothing_found(e, left)


def _is_much(u: Unexplained, added: Iterable[Added]) -> bool:
    """Whether what no effect accounts for has a shape, or explains as much as ``REST`` of what the
    effects of its sensor do.
    """
    if u.shape:
        return True
    known = sum(a.gain for a in added if a.sensor == u.sensor)
    return 0.5 * float(chi2.isf(u.p_value, 1)) > REST * known


def _of_force(effect: str) -> bool:
    """Whether an effect of a gyro follows what the accelerometer feels."""
    return effect in CATALOGUE and bool(CATALOGUE[effect].signals("gyro") & FORCE)


def instead(changed: Iterable[Changed]) -> tuple[str, ...]:
    """What may be missing instead of a declared value that the data contradict."""
    return tuple(
        f"instead of {_another(c)} the data allow {joined(c.alternatives)}"
        for c in changed
        if c.alternatives
    )


def _another(c: Changed) -> str:
    if c.effect == WALK[0]:
        return f"the {c.sensor}'s larger random walk"
    return f"another {c.effect} of the {c.sensor}"


def _nothing_found(e: Evidence, left: str) -> Verdict:
    if not e.shows:
        return Verdict(
            "undecidable",
            "no motion and no temperature: these logs could show little of what may be missing",
        )
    if e.rows < SHORT:
        return Verdict(
            "undecidable",
            f"fewer than {SHORT} rows were there to fit: too short to miss an effect in",
        )
    if left:
        return Verdict("unexplained", f"no effect of the catalogue accounts for it: {left}")
    if e.beside is not None and e.beside.word != "undecidable":
        return e.beside
    if still_open := open_of(e):
        at_rest = any(one.data for one in e.errors.values())
        wanted = "let it rest in more of them" if at_rest else "give a log to fit that moves so"
        wanted = "; ".join(e.unshown) or wanted
        return Verdict("undecidable", f"{still_open}: {wanted}")
    if e.unshown:
        return Verdict("undecidable", "; ".join(e.unshown))
    unjudged = [k for k in e.examined if not _is_judged(e.errors.get(k))]
    if unjudged:
        reason = f"no held-out row is left to judge the {joined(unjudged)} by"
        return Verdict(
            "undecidable", f"{reason}: give longer logs, or logs of their own to hold out"
        )
    if wanders := wandering(e):
        return Verdict("drift", wanders)
    but = " but what the rounding of the reference's numbers may hide" if e.rounded else ""
    if e.unexamined:
        seen = joined(sorted(e.examined))
        rest = f"nothing is missing of the {seen}{but}, and more was not examined"
        return Verdict("undecidable", rest)
    if e.dead:
        one = f"{joined(e.dead)} shows one value all the time, and nothing of its errors"
        return Verdict("undecidable", f"nothing is missing{but} elsewhere; {one}")
    if e.beside is not None:
        return e.beside
    corrected = "; declared values that the data contradict are listed as changed"
    said = f"nothing is missing{but}" + (corrected if e.changed else "")
    return Verdict("clean", said, (*instead(e.changed), *_not_looked_for(e.fates)))


def _not_looked_for(fates: Iterable[Fate]) -> tuple[str, ...]:
    """Which effects may be missing of each sensor all the same, and why nothing was asked of
    them.
    """
    unasked = [f for f in fates if f.outcome == NOT_LOOKED_FOR]
    return tuple(
        f"not looked for, of the {kind}: {_by_reason([f for f in unasked if f.sensor == kind])}"
        for kind in dict.fromkeys(f.sensor for f in unasked)
    )


def _by_reason(fates: list[Fate]) -> str:
    """Effects by the reason for which they were not looked for, the commonest first."""
    groups: dict[str, list[str]] = {}
    for f in fates:
        groups.setdefault(f.reason, []).append(f.effect)
    order = sorted(groups.items(), key=lambda item: -len(item[1]))
    said = [f"{_named(effects)} ({reason})" for reason, effects in order[:FEW]]
    rest = sum(len(effects) for _, effects in order[FEW:])
    more = [f"and {rest} more for reasons that the list of candidates has"] if rest else []
    return "; ".join(said + more)


def _named(effects: list[str]) -> str:
    return joined(effects) if len(effects) <= FEW else f"{len(effects)} effects"


# How much more than noise is left


def left_of(e: Evidence) -> str:
    """Of which sensors more than noise is left: how much, in which band, on which axis, and in
    which log where it is one of several; nothing where it is noise.
    """
    each = [_left(kind, e) or _noisier(kind, e.changed) for kind in e.errors]
    return joined([said for said in each if said])


def _noisier(kind: str, changed: Iterable[Changed]) -> str:
    """On which axis white noise is so much more than a part declares that it is no noise of it."""
    for c in (c for c in changed if (c.sensor, c.effect) == (kind, WHITE[0])):
        ratios = {
            i: _ratio(n, d) for i, (d, n) in enumerate(zip(c.declared, c.fitted, strict=True))
        }
        axis = max(ratios, key=lambda i: np.nan_to_num(ratios[i]))
        if FAR < ratios[axis] < np.inf:
            times = number(ratios[axis], 2)
            return f"the {kind} noise is {times} times what is declared on {'xyz'[axis]}"
    return ""


def _left(kind: str, e: Evidence, than_noise: bool = False) -> str:
    """The same of one sensor, whose errors are compared in all logs, in each, and by axis; more
    ``than_noise`` alone, or than what its coefficients were left open beside it.
    """
    whole, logs = e.errors[kind], {n: by[kind] for n, by in e.by_log.items() if kind in by}
    if than_noise:
        whole, *rest = (replace(one, unsure=None) for one in (whole, *logs.values()))
        logs = dict(zip(logs, rest, strict=True))
    axes = _by_axis(whole)
    pieces = {(name, i): r for name, one in logs.items() for i, r in _by_axis(one).items()}
    most_of_log = max(pieces, key=lambda at: pieces[at], default=None)
    limit = _limit(max(len(pieces), len(axes)))
    axis = max(axes, key=lambda i: axes[i], default=None)
    if _ratio(whole.after.total, whole.expected) > FAR:
        most = "" if axis is None else f", most on {'xyz'[axis]}"
        return _residual(kind, e) + _times(whole) + most
    if axis is not None and axes[axis] > limit:
        return _residual(kind, e) + f"{_times(whole, axis)} on {'xyz'[axis]}"
    if most_of_log is not None and pieces[most_of_log] > limit:
        name, i = most_of_log
        return _residual(kind, e) + f"{_times(logs[name], i)} on {'xyz'[i]} in {name}"
    return ""


def wandering(e: Evidence) -> str:
    """Of which sensor the residual, integrated over seconds, is far more than noise and the random
    walk of any part make of it, and on which axis; nothing where there is none.

    In its rows a slow error may be lost beside noise that a sum over them hardly shows.
    """
    for kind, whole in e.errors.items():
        logs = [("", whole), *((n, by[kind]) for n, by in e.by_log.items() if kind in by)]
        ratios = {(n, i): r for n, one in logs for i, r in _by_axis_slowly(one).items()}
        at = max(ratios, key=lambda k: ratios[k], default=None)
        if at is not None and ratios[at] > _limit(len(ratios)):
            name, axis = at
            of_log = f" in {name}" if name else ""
            times = number(ratios[at], 2)
            return (
                f"over {WINDOW:g} s the {kind} residual is {times} times what noise and the random "
                f"walk of any part make of it on {'xyz'[axis]}{of_log}, and no effect accounts for "
                "it"
            )
    return ""


def _by_axis_slowly(e: Errors) -> dict[int, float]:
    """The ratio of what is left over a window to what may be at most, of axes that have both."""
    pairs = enumerate(zip(e.after.angle_per_axis, e.expected_slow, strict=True))
    ratios = {i: _ratio(*pair) for i, pair in pairs}
    return {i: r for i, r in ratios.items() if np.isfinite(r)}


def _limit(count: int) -> float:
    """Ratio beyond which none of so many axes and logs is by chance."""
    return max(FAR, float(np.sqrt(chi2.isf(CHANCE / max(count, 1), 1))))


def _residual(kind: str, e: Evidence) -> str:
    band = f" below {number(e.band_hz[kind])} Hz" if e.band_hz.get(kind) else ""
    return f"the {kind} residual{band} is "


def open_of(e: Evidence) -> str:
    """Of which sensors more than noise is left that coefficients which nobody declared may leave,
    as the fitted rows, or too few positions, show little of them; nothing where there is none.
    """
    far = [k for k in e.errors if _left(k, e, than_noise=True) and not _left(k, e)]
    if not far:
        return ""
    said = joined([_left(k, e, than_noise=True) for k in far])
    rows = "these positions" if any(e.errors[k].data for k in far) else "the fitted rows"
    return f"{said}, which is no more than {rows} leave open of its coefficients"


def _by_axis(e: Errors) -> dict[int, float]:
    """The ratio of what is left to what is expected by axis, of those that have both."""
    expected = e.expected_per_axis
    ratios = {i: _ratio(e.after.per_axis[i], expected[i]) for i in range(3)}
    return {i: r for i, r in ratios.items() if not np.isnan(r)}


def _ratio(left: float, noise: float) -> float:
    """NaN where either is not known, or there is neither."""
    if np.isnan(left) or np.isnan(noise) or left == noise == 0.0:
        return float("nan")
    return float(left / noise) if noise > 0.0 else float("inf")


def _times(e: Errors, axis: int | None = None) -> str:
    """How many times its noise is left of a sensor, of all axes or of one."""
    left, noise = (e.after.total, e.noise) if axis is None else (e.after.per_axis, e.noise_per_axis)
    ratio = _ratio(*(v if axis is None else float(v[axis]) for v in (left, noise)))
    return (
        f"{number(ratio, 2)} times its noise" if np.isfinite(ratio) else "there without any noise"
    )


def _is_judged(e: Errors | None) -> bool:
    return e is not None and bool(np.isfinite(e.after.total)) and bool(np.isfinite(e.noise))


def _growing_attitude(attitude: tuple[float, float] | None) -> Iterator[str]:
    if attitude is not None and attitude[1] > WORSE * attitude[0]:
        before, after = np.degrees(attitude)
        yield f"attitude is worse with it: {before:.2f} to {after:.2f} deg"
