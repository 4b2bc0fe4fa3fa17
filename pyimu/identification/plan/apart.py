"""Which experiment would tell an effect that was found from one that could stand in for it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.plan.choice import LONGEST
from pyimu.identification.plan.information import Information, information
from pyimu.identification.plan.motions import Limits, Motion, library
from pyimu.identification.plan.noise import noise_at
from pyimu.identification.plan.scene import step_of, trial
from pyimu.identification.search.candidates import has_columns, scanned
from pyimu.model.catalogue import CATALOGUE

APART = 8.0
"""Standard errors by which two effects are to be told apart."""


@dataclass(frozen=True)
class Separation:
    """A motion that leaves so many standard errors of an effect, whatever the other one is, when it
    is done so many ``times``.
    """

    motion: Motion
    times: int
    distance: float

    @property
    def duration(self) -> float:
        return self.times * self.motion.duration


def quick(limits: Limits) -> tuple[Motion, ...]:
    """The motions of the library that a report has the time to try: no moves in a chamber."""
    return tuple(m for m in library(limits) if (m.still or not m.warm) and not m.supply)


def separation(fit: Fit, effect: str, others: Sequence[str]) -> Separation | None:
    """The shortest that tells a fitted effect from others; None where nothing does."""
    kind = fit.sensor.kind
    others = [n for n in others if _looked_at(n, kind)]
    if not others or not _looked_at(effect, kind):
        return None
    found = [
        s for m in quick(Limits.of(fit.sensor)) if (s := _of(fit, effect, others, m)) is not None
    ]
    return min(found, key=lambda s: s.duration, default=None)


def _looked_at(name: str, kind: str) -> bool:
    return has_columns(CATALOGUE[name], kind) and not scanned(CATALOGUE[name])


def _of(fit: Fit, effect: str, others: Sequence[str], motion: Motion) -> Separation | None:
    signals = frozenset().union(*(CATALOGUE[n].signals(fit.sensor.kind) for n in (effect, *others)))
    free = [k for k in fit.free if isinstance(k, Coefficient)]
    beside = {effect, *others, *(k.effect for k in free)}
    h = step_of([motion], effects=beside)
    noise = noise_at(fit, motion.frequency, h)
    one = trial([motion], fit.sensor, Limits.of(fit.sensor), h, signals)
    if not signals <= one.known:
        return None
    one = replace(one, axes=tuple(sorted(noise)))
    told = information(fit.sensor, one, noise, [effect, *others], free)
    distance = min(apart(told, fit, effect, other) for other in others)
    if not distance > 0.0:
        return None
    times = int(np.ceil((APART / distance) ** 2))
    if times * motion.duration > LONGEST:
        return None
    return Separation(motion, times, distance * np.sqrt(times))


def apart(told: Information, fit: Fit, effect: str, other: str) -> float:
    """Size in standard errors of what another effect cannot stand in for of a fitted one, all that
    the model leaves free beside it.
    """
    own = [k for k in told.keys if k.effect == effect]
    rest = [k for k in told.keys if k.effect == other or (k in fit.free and k not in own)]
    gram = told.on([*own, *rest]).gram
    n = len(own)
    values = np.array([fit.sensor.values[effect][k.parameter][k.index] for k in own])
    whole = gram @ np.concatenate([values, np.zeros(len(rest))])
    gone = _projected(gram[n:, n:], whole[n:])
    left = float(values @ whole[:n]) - gone
    return float(np.sqrt(left)) if left > 1e-9 * float(values @ whole[:n]) else 0.0


def _projected(gram: np.ndarray, score: np.ndarray) -> float:
    """The power of a score in the directions that a Gram matrix shows."""
    scale = np.sqrt(np.maximum(np.diag(gram), 1e-300))
    inverse = np.linalg.pinv(gram / np.outer(scale, scale), rcond=1e-9, hermitian=True)
    return float((score / scale) @ inverse @ (score / scale))
