"""What a motion tells of coefficients, before anything is measured: Fisher information.

The columns are those by which ``close`` fits (``fit.columns``), whitened by the noise that the part
declares; what belongs to the log (bias, mounting, thermometer) is projected out. The inverse of
what is left is the least variance that any unbiased estimate can have (Cramer-Rao bound), and that
which least squares reaches (Gauss-Markov theorem).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from pyimu.identification.fit.columns import clipped, linearise
from pyimu.identification.fit.fit import THERMOMETER
from pyimu.identification.fit.inputs import LogState
from pyimu.identification.fit.keys import Coefficient, LogLag, coefficients_of
from pyimu.identification.fit.normal import Noise, normal_equations, variances
from pyimu.identification.fit.response import predict
from pyimu.identification.fit.trial import Trial
from pyimu.identification.search.candidates import has_columns
from pyimu.identification.search.projected import Projected
from pyimu.model.catalogue import CATALOGUE, POWER_ON
from pyimu.model.effect import Effect
from pyimu.model.sensor import Sensor

SMALL = 1e-3
"""Share of a coefficient by which it is moved for a slope."""

SHOWN = 1e-9
"""Share of a column's power that the log's own coefficients must leave for it to be shown at all:
less is rounding."""


@dataclass(frozen=True)
class Information:
    """The information ``gram`` (P, P) on the coefficients ``keys``, in their units to the -1."""

    keys: tuple[Coefficient, ...]
    gram: np.ndarray

    def __add__(self, other: Information) -> Information:
        """Of two logs, whose power-ons and mountings are their own."""
        keys = tuple(dict.fromkeys((*self.keys, *other.keys)))
        total = np.zeros((len(keys), len(keys)))
        for one in (self, other):
            at = [keys.index(k) for k in one.keys]
            total[np.ix_(at, at)] += one.gram
        return Information(keys, total)

    def times(self, number: float) -> Information:
        return Information(self.keys, number * self.gram)

    def on(self, keys: Sequence[Coefficient]) -> Information:
        """On these coefficients, the others known; what it does not have is not shown."""
        place = {k: i for i, k in enumerate(self.keys)}
        gram = np.zeros((len(keys), len(keys)))
        have = [i for i, k in enumerate(keys) if k in place]
        at = [place[keys[i]] for i in have]
        gram[np.ix_(have, have)] = self.gram[np.ix_(at, at)]
        return Information(tuple(keys), gram)

    def errors(self) -> dict[Coefficient, float]:
        """Standard error of each coefficient, all estimated together; infinite if not shown."""
        return dict(zip(self.keys, np.sqrt(variances(self.gram)).tolist(), strict=True))

    def canonical(self, one: Iterable[Coefficient], other: Iterable[Coefficient]) -> float:
        """The largest correlation of a direction of some coefficients with one of others."""
        place = {k: i for i, k in enumerate(self.keys)}
        a, b = ([place[k] for k in ks if k in place] for ks in (one, other))
        if not a or not b:
            return 0.0
        roots = [_inverse_root(self.gram[np.ix_(i, i)]) for i in (a, b)]
        cross = roots[0].T @ self.gram[np.ix_(a, b)] @ roots[1]
        return float(min(1.0, np.linalg.norm(cross, 2))) if cross.size else 0.0


def _inverse_root(gram: np.ndarray) -> np.ndarray:
    """W with W' G W = 1 in the directions that are shown."""
    scale = np.sqrt(np.maximum(np.diag(gram), 1e-300))
    values, vectors = np.linalg.eigh(gram / np.outer(scale, scale))
    keep = values > SHOWN * max(values.max(initial=0.0), 1e-300)
    return (vectors[:, keep] / np.sqrt(values[keep])) / scale[:, None]


def information(
    sensor: Sensor,
    trial: Trial,
    noise: Noise,
    effects: Iterable[str],
    free: Iterable[Coefficient] = (),
    values: Mapping[str, Mapping[str, np.ndarray]] | None = None,
) -> Information:
    """What a trial tells of ``effects``, beside the coefficients ``free`` of the model ``sensor``.

    An effect that the model lacks is looked at where it is the identity; one that shows nothing
    there (a delay, a play, a time constant) at its coefficients in ``values``.
    """
    plain, wanted, shaped = sensor, set(free), {}
    for name in effects:
        if is_shaped(CATALOGUE[name], sensor.kind) and name not in sensor.values:
            shaped[name] = (values or {}).get(name, {})
        else:
            plain = plain if name in plain.values else plain.with_values(name)
            wanted |= coefficients_of(plain, name)
    extra = [_slopes(plain.with_values(n, **v), n) for n, v in shaped.items()]
    wanted = {k for k in wanted if (k.effect, k.parameter) != POWER_ON}
    linear = linearise(plain, trial, LogState(), wanted, extra)
    return projected(linear, noise)


def projected(linear, noise: Noise) -> Information:
    """The information of a trial's columns with those of the log's own projected out."""
    normal = normal_equations([linear], noise)
    gram = np.array(normal.batch_gram)
    for i, k in enumerate(normal.keys):
        if isinstance(k, LogLag):
            gram[0, i, i] += THERMOMETER**-2.0
    wanted = [i for i, k in enumerate(normal.keys) if isinstance(k, Coefficient)]
    others = [i for i in range(len(normal.keys)) if i not in set(wanted)]
    left = Projected.of(replace(normal, batch_gram=gram), others, wanted)
    return Information(tuple(normal.keys[i] for i in wanted), left.gram)


def is_shaped(e: Effect, kind: str) -> bool:
    """Whether an effect has no slope at the identity, or one that depends on a form."""
    forms = any(p.form or p.scan for p in e.parameters.values())
    return forms or not has_columns(e, kind)


def _slopes(sensor: Sensor, effect: str):
    """Column maker: what each coefficient of an effect changes in the output, by difference."""

    def add_all(trial: Trial, u: np.ndarray, y: np.ndarray, add) -> None:
        for key in sorted(coefficients_of(sensor, effect)):
            ends = _ends(sensor, key)
            high, low = (predict(s, u, trial.segments, trial.h) for s, _ in ends)
            change = (high - low) / (ends[0][1] - ends[1][1])
            for i in range(3):
                add(key, i, change[:, i])

    return add_all


def _ends(sensor: Sensor, key: Coefficient) -> list[tuple[Sensor, float]]:
    """The sensor with a coefficient moved up and down, and its values there.

    A hard edge that moves past no sample has no slope: it is judged by its whole effect.
    """
    value = float(sensor.values[key.effect][key.parameter][key.index])
    definition = sensor.effect(key.effect).parameters[key.parameter]
    step = SMALL * (abs(value) or 1.0)
    ends = (clipped(definition, value + step), clipped(definition, value - step))
    if definition.scan and definition.scan.measure == "zone":
        ends = (value, definition.start)
    return [(_with(sensor, key, v), v) for v in ends]


def _with(sensor: Sensor, key: Coefficient, value: float) -> Sensor:
    array = np.array(sensor.values[key.effect][key.parameter])
    array[key.index] = value
    return sensor.with_values(key.effect, **{key.parameter: array})
