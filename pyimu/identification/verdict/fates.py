"""What became of each candidate above the gate, and why."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import Any

from pyimu.files import plain
from pyimu.identification.found.entries import Added
from pyimu.identification.noise.rounding import is_read, shows_samples
from pyimu.identification.search.candidates import equivalent
from pyimu.identification.search.choice import LEAST_SHARE, MOST_REFINED, SET_WIDTH
from pyimu.identification.search.forward import MOST_EFFECTS
from pyimu.identification.search.investigation import Investigation, Step
from pyimu.identification.verdict.unasked import why_unasked
from pyimu.model.sensor import candidates
from pyimu.report.numbers import joined, number

TAKEN_BACK, TURNED_BACK = "makes the attitude worse", "makes the heading worse"
"""How the reason begins for which an effect is taken back after the search has ended."""

NOT_LOOKED_FOR = "not looked for"
"""The outcome for an effect of which nothing was asked."""


@dataclass(frozen=True)
class Fate:
    """One candidate, and what became of it.

    ``gain`` [nat] is that of the first look, ``last`` that of the last one, ``fitted`` that of the
    candidate alone beside the model before, fitted in full: the first look takes slopes at the
    identity and the noise as it was, and only ranks. Few are fitted in full; None for the others.

    ``outcome`` is "added", "changed" (a declared value set free), "alternative", "explained",
    "refused", "dropped", "not taken up" or "not looked for"; ``by`` are the effects that stand for
    it.
    """

    sensor: str
    effect: str
    gain: float | None
    last: float | None
    outcome: str
    reason: str
    by: tuple[str, ...] = ()
    fitted: float | None = None

    def as_dict(self) -> dict[str, Any]:
        return plain(asdict(self))


def fates(kind: str, inv: Investigation, added: Iterable[Added], noise: str) -> list[Fate]:
    """One entry for each candidate that passed the gate at either look or was decided on.

    The largest gain comes first; beside a reference of another body there are none. ``noise`` is
    why kinds of noise were not told apart, if they were not.
    """
    if inv.unfit:
        return []
    first, last = ({c.effect: c for c in s.candidates} for s in (inv.first, inv.last))
    names = [c.effect for s in (inv.first, inv.last) for c in s.above()]
    names += [s.effect for s in inv.steps] + [r.effect for r in inv.refused]
    out = [_fate(kind, inv, n, first.get(n), last.get(n)) for n in dict.fromkeys(names)]
    out += [
        Fate(kind, a.effect, a.gain, None, "added", f"{a.note}; gain {number(a.gain)} nat")
        for a in added
        if a.effect not in names
    ]
    out += [
        Fate(kind, other, None, None, "alternative", _as_good(a.effect), (a.effect,))
        for a in added
        for other in a.alternatives
        if a.effect not in names and other not in names
    ]
    out = sorted(out, key=lambda f: -max(f.gain or 0.0, f.last or 0.0))
    return out + _not_looked_for(kind, inv, {f.effect for f in out}, noise)


def _not_looked_for(kind: str, inv: Investigation, told: set[str], noise: str) -> list[Fate]:
    """One entry for each effect that the model lacks and that nothing was asked of."""
    looked = told | {c.effect for c in inv.first.candidates} | set(inv.before.sensor.values)
    out = []
    for e in candidates(kind, looked):
        if e.per_power_on or equivalent(e.name) & set(inv.before.sensor.values):
            continue
        reason = why_unasked(kind, inv, e, noise)
        if reason and not (is_read(e) and shows_samples(inv)):
            out.append(Fate(kind, e.name, None, None, NOT_LOOKED_FOR, reason))
    return out


def _fate(kind: str, inv: Investigation, name: str, first: Any, last: Any) -> Fate:
    gains = tuple(None if c is None else c.gain for c in (first, last))
    outcome, reason, by = _outcome(inv, name, *gains)
    alike = set() if first is None else set(first.inseparable_from)
    alike &= {s.effect for s in inv.steps} - set(by if outcome == "alternative" else ())
    if alike and outcome != "added":
        reason += f"; in these logs it looks like {joined(sorted(alike))} (correlation above 98 %)"
    return Fate(kind, name, *gains, outcome, reason, by, _fitted(inv).get(name))


def _fitted(inv: Investigation) -> dict[str, float]:
    """Gains [nat] of the candidates fitted in full for the first step."""
    return dict(inv.steps[0].fitted) if inv.steps else {}


def _outcome(
    inv: Investigation, name: str, first: float | None, last: float | None
) -> tuple[str, str, tuple[str, ...]]:
    step = next((s for s in inv.steps if s.effect == name), None)
    if step is not None:
        gain = f"{number(step.gain)} nat, gate {number(step.gate)} nat"
        if step.declared:
            return "changed", f"the declared value is set free: {gain}", ()
        order = f"number {inv.steps.index(step) + 1}: " if len(inv.steps) > 1 else ""
        return "added", f"{order}{gain}, and held-out data do not speak against it", ()
    refused = next((r for r in inv.refused if r.effect == name), None)
    if refused is not None:
        return "refused", f"{refused.reason} (fitted in full {number(refused.gain)} nat)", ()
    of = [s for s in inv.steps if s.effect in equivalent(name)]
    if of:
        return _as_another_form(name, of)
    close = [s.effect for s in inv.steps if name in s.alternatives]
    if close:
        return "alternative", _as_good(joined(close)), tuple(close)
    return _by_the_steps(inv, name, first, last)


def _as_good(other: str) -> str:
    return f"explains as much as {other}, to within {SET_WIDTH:g} nat"


def _as_another_form(name: str, of: list[Step]) -> tuple[str, str, tuple[str, ...]]:
    """What became of an effect of whose family there is a step: the data may tell the forms apart
    or not.
    """
    names = [s.effect for s in of]
    if any(name in s.alternatives for s in of):
        return "alternative", f"one class with {joined(names)}, not told apart", tuple(names)
    clear = f"the data speak for {joined(names)} by more than {SET_WIDTH:g} nat"
    return "explained", f"another form of the same error: {clear}", tuple(names)


def _by_the_steps(
    inv: Investigation, name: str, first: float | None, last: float | None
) -> tuple[str, str, tuple[str, ...]]:
    steps = tuple(s.effect for s in inv.steps)
    if last is None:
        return "dropped", f"no longer needed beside {joined(steps)}", steps
    if last <= inv.last.gate:
        fell = f"its gain fell from {number(first)} to {number(last)} nat"
        once = f"{joined(steps)} {_was(steps)} in" if steps else "what is left was taken for noise"
        return "explained", f"{fell} once {once}{_overtaken(inv, name, first)}", steps
    return "not taken up", _why_left(inv, name), ()


def _overtaken(inv: Investigation, name: str, first: float | None) -> str:
    """What a candidate that led at the first look explains once it is fitted in full."""
    fitted = _fitted(inv)
    if name not in fitted or first is None:
        return ""
    chosen = inv.steps[0].effect
    looked = next((c.gain for c in inv.first.candidates if c.effect == chosen), None)
    if looked is None or first <= looked:
        return ""
    alone = f"{number(fitted[name])} nat" if fitted[name] > 0.0 else "nothing"
    return f"; alone and fitted in full it explains {alone}, {chosen} {number(fitted[chosen])} nat"


def _was(names: tuple[str, ...]) -> str:
    return "was" if len(names) == 1 else "were"


def _why_left(inv: Investigation, name: str) -> str:
    """Why a candidate that still passes the gate at the last look was not added."""
    if len(inv.steps) >= MOST_EFFECTS:
        return f"{MOST_EFFECTS} effects were added already"
    refused = {r.effect for r in inv.refused}
    back = [r.effect for r in inv.refused if r.reason.startswith((TAKEN_BACK, TURNED_BACK))]
    if back:
        return f"not looked for again after {joined(back)} was taken back"
    options = [c for c in inv.last.above() if c.effect not in refused]
    best = [c for c in options[:MOST_REFINED] if c.gain > LEAST_SHARE * options[0].gain]
    if name in [c.effect for c in best]:
        return "fitted in full, beside all else, it gains less than the gate"
    return f"weaker than {joined([c.effect for c in best])}, which fitted in full gain nothing"
