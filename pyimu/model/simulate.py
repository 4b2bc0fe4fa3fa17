"""Simulation of a known motion, as arrays or as a recording, through the C of the part's FMU.

The inputs go through in pieces that stay in the processor's cache, so that nothing is made of the
length of the log but the measurements. Sample 1 of the noise belongs to the first row, as in an
FMU that is started one sample period before it.
"""

from __future__ import annotations

import os
from functools import lru_cache

import numpy as np

from pyimu.errors import UserError
from pyimu.model.kinds import MAGNETOMETER
from pyimu.model.measure import measure
from pyimu.model.part import Part
from pyimu.model.part_file import part as find_part
from pyimu.model.sensor import Sensor
from pyimu.model.signals import SIGNALS, inputs_for
from pyimu.model.truth import measured_recording
from pyimu.recording.recording import Recording
from pyimu.units import did_you_mean


def simulate(
    part: Part | str | os.PathLike,
    rate: np.ndarray,
    specific_force: np.ndarray,
    temperature: np.ndarray | float = 25.0,
    *,
    seed: int | None = 0,
    sample_period: float | None = None,
    **others: np.ndarray | float,
) -> tuple[np.ndarray, np.ndarray]:
    """Measured rate [rad/s] and specific force [m/s^2], each (n, 3), of a part that moves as given.

    The inputs are in rad/s, m/s^2 and degC.

    The part may be a name or a file (see ``pyimu.part``). ``others`` are inputs by their names in
    ``SIGNALS`` that the part's effects need: ``supply`` (n,) V, ``mag`` (n, 3) T and so on; one
    that they do not need is ignored. Any input but the rate may be a constant.

    Row k draws the noise that the FMU draws for its sample k + 1 under the same seed, under 0 where
    the instance is called as its model is; ``seed=None`` is noise off. A row that is NaN gives NaN;
    the sensors' memories hold their last values through it. Raises UserError for an input that is
    unknown, missing, no number or of a wrong shape, and for a part, a seed or a sample period that
    is none.
    """
    part = find_part(part)
    given = {"rate": rate, "specific_force": specific_force, "temperature": temperature, **others}
    names = inputs_for(part.signals)
    for name in others:
        if name not in SIGNALS or SIGNALS[name].derived:
            known = [n for n, s in SIGNALS.items() if not s.derived]
            raise UserError(
                f"unknown input '{name}'{did_you_mean(name, known)}; known are {', '.join(known)}"
            )
    missing = [name for name in names if name not in given]
    if missing:
        raise UserError(
            f"part {part.name} has effects of {', '.join(missing)}: give them as arguments of "
            "these names"
        )
    h = part.sample_period if sample_period is None else sample_period
    arrays = {name: _numbers(name, given[name]) for name in names}
    if arrays["rate"].ndim != 2:
        raise UserError(f"rate has shape {arrays['rate'].shape}, expected (n, 3)")
    y = measure(part.block, arrays, len(arrays["rate"]), {}, seed, h, ("gyro", "accel"))
    return y["gyro"], y["accel"]


def _numbers(name: str, values: np.ndarray | float) -> np.ndarray:
    """An input as an array of its own number type.

    Raises UserError for what is not an array of real numbers.
    """
    try:
        array = np.asarray(values)
    except ValueError:
        raise UserError(f"{name}: its rows are of unequal length") from None
    if array.dtype.kind not in "fiub":
        raise UserError(
            f"{name} must be an array of real numbers, not {array.dtype} as in {str(values)[:40]!r}"
        )
    return array


def simulate_recording(
    model: Part | Sensor, recording: Recording, *, seed: int | None = 0
) -> Recording:
    """The recording as ``model`` would have measured it.

    ``gyro`` and ``accel`` are replaced (by a ``Sensor`` only its own), all else is kept.

    The truth comes from the recording: the rate from ``ref_rate``, else differentiated from
    ``ref_q`` as ``reference_rate`` says; the specific force from ``ref_force``; both are those of a
    part at rest where there is no reference at all: no rate, and the mean of ``accel`` or, without
    one, level. What enters only the errors of the other sensor may be the measured ``gyro`` or
    ``accel``. The temperature is 25 degC where none was recorded. ``supply``, ``mag``, ``ref_q``,
    ``latitude`` and ``ref_velocity`` are taken where an effect needs them.

    The sample period is the recording's (a part's own where the two agree), and the sensor runs on
    where rows are missing: through a gap, of at most an hour, and empty cells its inputs go
    straight from neighbour to neighbour, and its noise and time go on. Rows without the truth that
    a sensor measures become NaN, and a finding ``unknown_truth`` counts them. The noise is that of
    ``simulate``; ``seed=None`` is noise off.

    Raises UserError for a truth that the recording lacks and the model needs, naming the column.
    """
    if isinstance(model, Sensor) and model.kind == MAGNETOMETER:
        raise UserError("a magnetometer is not simulated: only gyro and accelerometer are")
    if isinstance(model, Part):
        return model.simulate(recording, seed=seed)
    return measured_recording(_alone(model).block, (model,), recording, None, seed)


@lru_cache(maxsize=16)
def _alone(sensor: Sensor) -> Part:
    return Part(sensor.kind, 1.0, **{sensor.kind: sensor})
