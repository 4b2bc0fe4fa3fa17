"""The model that investigations of a part amount to."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.most_white import most_white
from pyimu.identification.fit.sample_noise import rest_density
from pyimu.identification.logs.vibration import less_lines
from pyimu.identification.model.as_part import unexamined_left_out
from pyimu.identification.noise.named import Noise
from pyimu.identification.noise.rounding import Rounding, rounding
from pyimu.identification.search.investigation import Investigation
from pyimu.identification.search.leftover import NoiseFigure, noise_figures
from pyimu.model.catalogue import POWER_ON, WALK, WHITE
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor

Found = dict[str, Investigation]


@dataclass(frozen=True)
class Model:
    """The part before and after what was found, and the rounding among that by kind of sensor."""

    before: Part
    after: Part
    rounding: dict[str, Rounding]

    def with_noise(self, noises: dict[str, Noise]) -> Model:
        """With what was found to be random, by kind of sensor."""
        after = self.after
        for kind, noise in noises.items():
            sensor = after.sensor(kind)
            for effect, values in noise.values.items():
                sensor = sensor.with_values(effect, **values)
            after = after.with_sensor(sensor)
        return replace(self, after=after)


def model_of(start: Part, declared: Part | None, found: Found) -> Model:
    """The model that investigations ``found`` of a part amount to."""
    before = after = unexamined_left_out(start, declared, found)
    rounded = {}
    for kind, inv in found.items():
        before = before.with_sensor(_finished(start, inv.before))
        sensor, rounded[kind] = _finished(start, inv.after), rounding(kind, inv)
        for a in rounded[kind].added:
            sensor = sensor.with_values(a.effect, **{n: v for n, (v, _, _) in a.parameters.items()})
        after = after.with_sensor(sensor)
    return Model(before, after, rounded)


def _finished(start: Part, fit: Fit) -> Sensor:
    """The fitted sensor with the bias and the noise found, where they are left to the data."""
    figures = noise_figures(fit)
    if figures:
        none = NoiseFigure(0, 0, 0, 0)
        white = np.array([figures.get(i, none).N for i in range(3)])
        walk = np.array([figures.get(i, none).K for i in range(3)])
    else:
        # A differentiated reference hides the sensor's own noise; its quiet rows show the white
        # part only, and of a body without rests as much as is left beside the reference.
        rest = np.mean([rest_density(less_lines(t)) for t in fit.trials], axis=0)
        white, walk = np.fmin(np.nan_to_num(rest), np.sqrt(most_white(fit))), np.zeros(3)
    bias = np.mean([fit.states[t.name].bias for t in fit.trials], axis=0)
    sensor = fit.sensor
    for (effect, parameter), value in ((POWER_ON, bias), (WHITE, white), (WALK, walk)):
        if (sensor.kind, effect, parameter) in start.estimate:
            sensor = sensor.with_values(effect, **{parameter: value})
    return sensor
