"""What the numbers together say: the verdict of a closed loop, and why."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from pyimu.identification.clocks import taken_out
from pyimu.identification.fates import NOT_LOOKED_FOR, Fate
from pyimu.identification.fit.columns import in_band, residual
from pyimu.identification.fit.score import held_state
from pyimu.identification.fit.trial import Trial
from pyimu.identification.found import Added, Errors
from pyimu.identification.reference.clock import mistaken, moves
from pyimu.identification.search.forward import AS_NOISE, Investigation, Refused
from pyimu.model.catalogue import CATALOGUE
from pyimu.recording.reference.band import COHERENCE, LEAST_BAND
from pyimu.report.numbers import joined, number

FAR = 3.0
"""Ratio of the held-out error to its floor from which on more than noise is left."""

UNFIT = 0.5
"""Share of the sensor's moving power below which a reference does not belong to the sensor."""

SHORT = 500
"""Fitted rows below which finding nothing says nothing."""

FEW = 3
"""Effects, and reasons, of which each is named in a remark; of more their number is said."""

WORSE = 1.02
"""Ratio of the attitude errors after and before from which on the model is worse for attitude."""

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

Found = dict[str, Investigation]


@dataclass(frozen=True)
class Verdict:
    """One of ``VERDICTS``, the reason for it, and what must be said beside it."""

    word: str
    reason: str
    remarks: tuple[str, ...] = ()


@dataclass(frozen=True)
class Evidence:
    """What a verdict goes by.

    ``fates`` says what became of the candidates, ``unexamined`` of each sensor of the logs that was
    not looked at why not, ``lost`` of which logs the attitude is lost; ``heading`` is the error
    before and after, ``formulas`` by name how a formula is said.
    """

    added: list[Added]
    changed: list
    unexplained: tuple
    drift: dict
    found: Found
    errors: dict[str, Errors]
    attitude: tuple[float, float] | None
    refused: list[tuple[str, Refused]]
    unexamined: dict[str, str]
    lost: tuple[str, ...] = ()
    heading: tuple[float, float] | None = None
    formulas: Mapping[str, str] = field(default_factory=dict)
    fates: tuple[Fate, ...] = ()


def verdict(e: Evidence) -> Verdict:
    """The verdict, with what must be said beside it."""
    found = _verdict(e)
    clocks = taken_out(e.found, e.heading) if found.word != "reference_unfit" else ""
    beside = (*_growing_attitude(e.attitude), *e.lost, *e.unexamined.values())
    return replace(found, remarks=(*filter(None, [clocks]), *found.remarks, *beside))


def _verdict(e: Evidence) -> Verdict:
    another = unfit(e.found)
    if another:
        return Verdict("reference_unfit", another)
    left = _left(e.errors)
    if e.added and all(a.effect in e.formulas for a in e.added):
        said = joined([f"{a.sensor}: {e.formulas[a.effect]}" for a in e.added])
        why = f"no effect of the catalogue describes it, a formula does: {said}"
        return Verdict("unexplained", why, (left,) if left else ())
    if e.added:
        names = ", ".join(f"{a.sensor} {a.effect}" for a in e.added)
        return Verdict("partly", names, (left,)) if left else Verdict("named", names)
    shapes = [u for u in e.unexplained if u.shape]
    if shapes:
        u = shapes[0]
        return Verdict("unexplained", f"{u.sensor} {u.axis} shows {u.shape}")
    refused = [r for r in e.refused if r[1].reason != AS_NOISE]
    if refused:
        kind, most = max(refused, key=lambda r: r[1].gain)
        gain = f"{kind} {most.effect} explains the fitted rows ({most.gain:.0f} nat)"
        return Verdict("not_confirmed", f"{gain}, but {most.reason}")
    if e.unexplained:
        u = e.unexplained[0]
        does = f"depends on {' x '.join(u.depends_on)}"
        return Verdict("unexplained", f"{u.sensor} {u.axis} {does}")
    if e.drift:
        return Verdict("drift", "more random walk than declared: an input that nobody logged")
    return _nothing_found(e, left)


def _nothing_found(e: Evidence, left: str) -> Verdict:
    if not _shows_anything(e.found):
        return Verdict(
            "undecidable",
            "no motion and no temperature: these logs could show little of what may be missing",
        )
    if max(sum(t.count for t in inv.after.trials) for inv in e.found.values()) < SHORT:
        return Verdict(
            "undecidable",
            f"fewer than {SHORT} rows were there to fit: too short to miss an effect in",
        )
    if left:
        return Verdict("unexplained", f"no effect of the catalogue accounts for it: {left}")
    if e.unexamined:
        seen = joined(sorted(e.found))
        rest = f"nothing is missing of the {seen}, and more was not examined"
        return Verdict("undecidable", rest)
    corrected = "; declared values that the data contradict are listed as changed"
    said = "nothing is missing" + (corrected if e.changed else "")
    return Verdict("clean", said, _not_looked_for(e.fates))


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


def unfit(found: Found) -> str:
    """Why a reference does not belong to its sensor; nothing where all do."""
    for kind, inv in found.items():
        for t in (t for t in inv.after.trials if t.clock is not None):
            mistake = mistaken(t)
            if mistake:
                return f"the reference of {t.name} {mistake}"
        fitted = [(t, t.clock.explained) for t in inv.after.trials if t.clock is not None]
        held = [(t, _explained(inv, t)) for t in inv.held if t.clock and moves(t)]
        for trial, share in [*fitted, *held]:
            if share < (COHERENCE if _coheres_nowhere(trial) else UNFIT):
                part = f"{max(share, 0.0):.0%} of what the {kind} shows"
                return (
                    f"the reference of {trial.name} accounts for {part}: another body, another "
                    "time, or other axes"
                )
    return ""


def _coheres_nowhere(trial: Trial) -> bool:
    """Whether sensor and reference agree in no band, so that they are compared in the least."""
    least = trial.band_hz is not None and trial.band_hz < LEAST_BAND
    return least and trial.band_limit is not None and trial.band_limit > LEAST_BAND


def _explained(inv: Investigation, trial: Trial) -> float:
    """Share of the sensor's power in the band, on held-out rows, that the model accounts for."""
    state, rest = held_state(inv.after, trial)
    axes = list(rest.axes)
    y = in_band(rest, rest.y[:, axes])
    left = in_band(rest, residual(inv.after.sensor, rest, state))[:, axes]
    power = float(np.sum((y - y.mean(axis=0)) ** 2)) if len(y) else 0.0
    return 1.0 - float(np.sum(left**2)) / power if power > 0.0 else 1.0


def _left(errors: dict[str, Errors]) -> str:
    """How much more than noise is left, and on which axis most; nothing where it is noise."""
    far = []
    for kind, e in errors.items():
        if e.floor is None or not e.after.total > FAR * e.noise:
            continue
        with np.errstate(invalid="ignore", divide="ignore"):
            axes = e.after.per_axis / e.floor.per_axis
        ratio = e.after.total / e.noise
        axis = "xyz"[int(np.nanargmax(axes))]
        far.append(f"the {kind} residual is {number(ratio, 2)} times its noise, most on {axis}")
    return joined(far)


def _growing_attitude(attitude: tuple[float, float] | None) -> list[str]:
    if attitude is None or not attitude[1] > WORSE * attitude[0]:
        return []
    before, after = np.degrees(attitude)
    return [f"attitude is worse with it: {before:.2f} to {after:.2f} deg"]


def _shows_anything(found: Found) -> bool:
    """Whether some effect would be visible that time alone does not drive.

    Those show in any log, and say nothing about the effects that people ask for.
    """
    return any(
        np.isfinite(c.smallest_visible) and "time" not in CATALOGUE[c.effect].signals(kind)
        for kind, inv in found.items()
        for c in inv.first.candidates
    )
