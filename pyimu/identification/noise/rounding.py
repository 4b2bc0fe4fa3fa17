"""Rounding of the output, which shows in the raw samples: they lie on the multiples of a step."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.trial import Trial, counted
from pyimu.identification.fit.whiten import LEAST_VARIANCE, RandomWalk
from pyimu.identification.found.entries import Added
from pyimu.identification.noise.cells import Cells
from pyimu.identification.noise.rows import rows_of
from pyimu.identification.noise.spectrum import Bands, bands
from pyimu.identification.search.ceiling import has_samples
from pyimu.identification.search.choice import SET_WIDTH
from pyimu.identification.search.investigation import Investigation
from pyimu.identification.search.screen import PENALTY
from pyimu.model.catalogue import CATALOGUE, INCREMENTS, read_off
from pyimu.model.effect import Effect
from pyimu.model.kinds import KINDS
from pyimu.model.sensor import Sensor
from pyimu.recording.quality.resolution import comb_step, is_written
from pyimu.units import parse

SHARE = 0.03
"""Share of the white variance from which on rounding is part of the noise (a step of 0.6 sigma):
twice by which white noise must differ from its declared variance before it is said."""

WRITTEN_IN = {"rad/s": ("rad/s", "deg/s", "deg/h"), "m/s^2": ("m/s^2", "g")}
"""Units that files hold rates and forces in, up to powers of ten. A step that is one digit of such
a number, and does nothing, is the file's."""

ON_A_COMB = "every raw sample lies on a comb of these steps"
ALIKE = "so fine beside the noise it does not show whether samples or their integral are rounded"

HIDDEN = "in the noise of a reference that was differentiated, samples show no edge and no step"


@dataclass(frozen=True)
class Rounding:
    """Effects that round the output, ``added``, and whether they are ``relevant`` to its noise."""

    added: tuple[Added, ...] = ()
    relevant: bool = False

    def of_increments(self, sensor: Sensor) -> Sensor:
        """A sensor with the step to which its integral is rounded, where that was found."""
        for a in (a for a in self.added if a.effect == INCREMENTS[0]):
            sensor = sensor.with_values(a.effect, **{n: v for n, (v, _, _) in a.parameters.items()})
        return sensor


def is_coarse(sensor: Sensor, fit: Fit) -> bool:
    """Whether the step to which a sensor is declared to round is part of the noise that a fit
    shows.
    """
    found = sensor.reading("step")
    if found is None:
        return False
    step = np.broadcast_to(sensor.values[found[0]][found[1]], 3)
    white = {i: n.r for i, n in fit.seen.items() if isinstance(n, RandomWalk)}
    return len(white) < len(fit.seen) or any(
        step[i] ** 2 / 12 > SHARE * r for i, r in white.items()
    )


def is_read(e: Effect) -> bool:
    """Whether an effect is looked for in the raw samples."""
    return e.name == INCREMENTS[0] or any(p.reads for p in e.parameters.values())


def shows_samples(inv: Investigation) -> bool:
    """Whether rows are samples whose noise is the sensor's own."""
    walks = all(isinstance(n, RandomWalk) for n in inv.after.seen.values())
    return walks and has_samples(inv.after.trials)


def rounding(kind: str, inv: Investigation) -> Rounding:
    """Rounding as an added effect, where the raw samples show its steps.

    Against a differentiated reference these vanish in its noise, and stay a finding about the raw
    samples.
    """
    sensor, noise = inv.after.sensor, inv.after.seen
    plain, summed = read_off(CATALOGUE.values(), "step"), INCREMENTS
    if not shows_samples(inv) or any(name in sensor.values for name, _ in (plain, summed)):
        return Rounding()
    white = np.array([np.sqrt(noise[i].r) if i in noise else np.nan for i in range(3)])
    steps = _steps(inv.after.trials, white)
    if not steps:
        return Rounding()
    q = np.array([steps.get(i, 0.0) for i in range(3)])
    ahead = _of_increments(inv, steps)
    (effect, parameter), other = (plain, summed) if ahead < SET_WIDTH else (summed, plain)
    size = q if effect == plain[0] else q * inv.after.trials[0].h
    unit = CATALOGUE[effect].parameters[parameter].unit
    alike = abs(ahead) < SET_WIDTH
    added = Added(
        sensor=kind,
        effect=effect,
        alternatives=(other[0],) if alike else (),
        parameters={parameter: (size, np.zeros(3), sensor.unit(unit))},
        gain=_comb_gain(inv.after.trials, steps),
        gate=PENALTY * len(steps),
        note=ON_A_COMB + ("; " + ALIKE if alike else ""),
    )
    return Rounding((added,), any(_counts(q, white[i]) for i, q in steps.items()))


def _steps(trials: tuple[Trial, ...], white: np.ndarray) -> dict[int, float]:
    """Steps q by axis on which every raw sample lies, less those that do nothing beside white noise
    of standard deviation (3,) and with which files write numbers.
    """
    found = {}
    for i in (i for i in range(3) if np.isfinite(white[i])):
        columns = [values for t in trials if len(values := counted(t, i))]
        steps = [comb_step(values) for values in columns]
        if steps and all(s is not None for s in steps):
            q, largest = float(np.median(steps)), max(float(np.abs(v).max()) for v in columns)
            if _counts(q, white[i]) or not is_written(q, largest, _units(trials[0])):
                found[i] = q
    return found


def _counts(q: float, white: float) -> bool:
    return q**2 / 12 > SHARE * white**2


def _units(trial: Trial) -> list[float]:
    """Of the samples and of their integrals over a sample period."""
    sizes = [parse(text).factor for text in WRITTEN_IN[KINDS[trial.kind].unit]]
    return [*sizes, *(size / trial.h for size in sizes)]


def _comb_gain(trials: tuple[Trial, ...], steps: Mapping[int, float]) -> float:
    """Log-likelihood [nat] by which samples that lie on a comb of step q speak for it, against
    samples that lie anywhere.

    A sample within m of the nearest multiple has density 1/(2 m) there instead of 1/q: ln(q / 2 m)
    each.
    """
    total = 0.0
    for i, q in steps.items():
        values = np.concatenate([counted(t, i) for t in trials])
        offsets = (values - values[0]) / q
        miss = max(float(np.abs(offsets - np.round(offsets)).max()) * q, 1e-6 * q)
        total += len(values) * float(np.log(q / (2 * miss)))
    return total


def _of_increments(inv: Investigation, steps: Mapping[int, float]) -> float:
    """Log-likelihood [nat] by which the residual's spectrum speaks for rounded increments against
    rounded samples: the error of those is a difference of white noise, of these it is white.

    White noise and random walk beside either are as suits it best.
    """
    total = 0.0
    for i, logs in rows_of(inv.after, ()).items():
        made = bands(logs) if i in steps else None
        if made is not None:
            q, h = steps[i], made.h
            summed = made.density(0, 0, (), q * h / np.sqrt(12))
            plain = made.density(q**2 * h / 12, 0, (), 0)
            total += _likelihood(made, summed) - _likelihood(made, plain)
    return total


def _likelihood(made: Bands, rounded: np.ndarray) -> float:
    """Of the cells with an error that ``rounded`` (c,) beside the noise that suits best."""
    free = np.array([made.density(1, 0, (), 0), made.density(0, 1, (), 0)])
    none = np.zeros(2)
    return Cells(made.count, made.squares, rounded + LEAST_VARIANCE, free, none).fit()[1]
