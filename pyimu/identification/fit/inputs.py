"""What went into a sensor in a log: the reference, as what belongs to the log has it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.identification.fit.clock import ClockChange
from pyimu.identification.fit.interpolated import delayed
from pyimu.identification.fit.keys import LogBias, LogClock, LogKey, LogLag, LogPlace
from pyimu.identification.fit.place import NOWHERE, UNKNOWN
from pyimu.identification.fit.trial import Trial
from pyimu.model.kinds import KINDS, OWN
from pyimu.model.signals import COLUMNS

TEMPERATURE, ITS_RATE = COLUMNS["temperature"], COLUMNS["temperature_rate"]


@dataclass(frozen=True)
class LogState:
    """What belongs to a log and not to the part: bias (3,) at power-on, mounting rotation (3, 3)
    of the reference, ``lag`` s of its thermometer behind the sensor's temperature, what its clock
    still lacks, None where that is not to be found, and the ``place`` (8,) of its reference force.
    """

    bias: np.ndarray = field(default_factory=lambda: np.zeros(3))
    rotation: np.ndarray = field(default_factory=lambda: np.eye(3))
    lag: float = 0.0
    clock: ClockChange | None = None
    place: np.ndarray = field(default_factory=lambda: NOWHERE)

    def moved(self, key: LogKey, change: float) -> LogState:
        """The state with the coefficient of one of its columns changed."""
        if isinstance(key, LogClock):
            return replace(self, clock=self.clock.moved(key.order, change))
        if isinstance(key, LogLag):
            return replace(self, lag=self.lag + change)
        if isinstance(key, LogPlace):
            return replace(self, place=self.place + change * np.eye(UNKNOWN)[key.number])
        unit = np.eye(3)[key.axis]
        if isinstance(key, LogBias):
            return replace(self, bias=self.bias + change * unit)
        return replace(
            self, rotation=Rotation.from_rotvec(change * unit).as_matrix() @ self.rotation
        )


class Inputs:
    """Inputs (n, N_INPUT) as one column after another, read like the array that they would make:
    what changes some of them leaves the others where they are.
    """

    def __init__(self, u: np.ndarray) -> None:
        self.T = list(u.T)

    def __len__(self) -> int:
        return len(self.T[0])

    def __getitem__(self, at) -> np.ndarray:
        rows, columns = at if isinstance(at, tuple) else (at, slice(None))
        if isinstance(columns, slice):
            return np.array([c[rows] for c in self.T[columns]]).T
        return self.T[columns][rows]

    def __setitem__(self, at: tuple[slice, slice], values: np.ndarray) -> None:
        """Put columns (n, k) in the place of others."""
        self.T[at[1]] = list(np.ascontiguousarray(values.T))

    def __array__(self, dtype=None, copy=None) -> np.ndarray:
        return np.array(self.T, dtype=dtype).T


def copied(u: np.ndarray) -> np.ndarray:
    """Inputs (n, N_INPUT) that may be written to, column by column like ``u``: signals that are
    zero, as most unknown ones are, take no memory until something is put there.
    """
    out = np.zeros(u.shape[::-1]).T
    for k, column in enumerate(u.T):
        if column.any():
            out[:, k] = column
    return out


def reference_input(trial: Trial, state: LogState) -> Inputs:
    """Inputs (n, N_INPUT) with the reference turned into the sensor's axes, on the sensor's clock.

    What the clock still lacks is short against the motion: its first order is enough, unless it was
    measured without a lag of the sensor. A thermometer that is a first-order lag shows T - lag
    dT/dt.
    """
    u, own, rate = Inputs(trial.u), OWN[trial.kind], own_rate(trial.kind)
    if np.any(state.place):
        _put_in_place(u, trial, state.place)
    if state.clock is not None:
        late = state.clock.at(trial.time)
        if trial.clock is not None and trial.clock.apart:
            for at in (own, rate):
                u[:, at] = delayed(trial.u[:, at], late / trial.h)
        else:
            u[:, own] = u[:, own] - late[:, None] * u[:, rate]
    # What is turned is turned by the sensor's own axes, whichever the reference has.
    turned = (COLUMNS["turned"],) if trial.kind == "gyro" else ()
    for at in () if np.array_equal(state.rotation, np.eye(3)) else (own, rate, *turned):
        u[:, at] = u[:, at] @ state.rotation.T
    if state.lag:
        u[:, TEMPERATURE] = u[:, TEMPERATURE] + state.lag * u[:, ITS_RATE]
    return u


def _put_in_place(u: Inputs, trial: Trial, place: np.ndarray) -> None:
    """Move the reference force and its rate to where they act."""
    here = trial.place
    for at, more in ((OWN[trial.kind], here.forces), (own_rate(trial.kind), here.slopes)):
        u[:, at] = u[:, at] + np.tensordot(place, more, 1).T


def before(trial: Trial, state: LogState) -> np.ndarray | None:
    """Inputs (m, N_INPUT) of the log before the trial's first row, from which what is remembered
    of other signals than the sensor's own follows; None where there are none.
    """
    if trial.earlier is None or not state.lag:
        return trial.earlier
    u = np.array(trial.earlier)
    u[:, TEMPERATURE] += state.lag * u[:, ITS_RATE]
    return u


def own_rate(kind: str) -> slice:
    return COLUMNS[KINDS[kind].own_rate]
