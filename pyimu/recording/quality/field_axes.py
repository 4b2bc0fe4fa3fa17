"""Whether the magnetic field turns in the body as the gyro says: a magnetometer's axes."""

from __future__ import annotations

import numpy as np

from pyimu.errors import Finding
from pyimu.recording.readings import READINGS, changed, likely, named
from pyimu.recording.recording import Recording, filled
from pyimu.recording.turning import carried, scatter, turning_spans

MOST_NAMED = 4
"""Readings that are named where the log does not tell them apart."""


def field_findings(recording: Recording) -> tuple[Finding, ...]:
    """A finding ``mag_axes`` where the field turns as the gyro says in other axes alone.

    Its ``axes`` are the readings that fit. Each comes with its opposite, as the field upside down
    turns alike; of a body that stays level those that differ in z fit, too.
    """
    if recording.mag is None or recording.gyro is None:
        return ()
    turns, field = turning_spans(recording, filled(recording.time, recording.mag))
    if not len(turns):
        return ()
    costs = np.array([*map(changed, READINGS)])
    fits = likely(_scatters(turns, field), scatter(field), costs)
    if not fits or fits[0] == 0:
        return ()
    axes = "; or ".join(named(READINGS[i]) for i in fits[:MOST_NAMED])
    return (Finding("mag_axes", "mag", len(recording), {"axes": axes}),)


def _scatters(turns: np.ndarray, field: np.ndarray) -> np.ndarray:
    """Variance (48, m) of the field (m, k, 3), in axes by each of ``READINGS``, carried along.

    A constant b in the body, as iron on board makes, is taken off, the one of the least sum of the
    variances. With A the mean of the attitudes R in a span and M that of R m, its variance is
    E|m - b|^2 - |M - A b|^2, so that b solves sum(1 - A^T A) b = sum(E m - A^T M).
    """
    m, k, _ = turns.shape
    # R times e_i m_j for every i and j, from which R S m follows for every S, and R itself.
    each = np.einsum("ia,mkj->kmaij", np.eye(3), field).reshape(k, m, 3, 9)
    unit = np.broadcast_to(np.eye(3), (k, m, 3, 3))
    steps = np.concatenate([each, unit], axis=3)
    _, sums = carried(turns.transpose(1, 0, 2), steps, np.full(m, k))
    mean = np.einsum("maij,cij->cma", sums[:, :, :9].reshape(m, 3, 3, 3) / k, READINGS)
    attitude = sums[:, :, 9:] / k
    own = np.einsum("cij,mj->cmi", READINGS, field.mean(axis=1))
    left = np.sum(np.eye(3) - attitude.transpose(0, 2, 1) @ attitude, axis=0)
    right = np.sum(own - np.einsum("mia,cmi->cma", attitude, mean), axis=1)
    constant = right @ np.linalg.pinv(left, rcond=1e-6, hermitian=True)
    size = np.mean(np.sum(field**2, axis=2), axis=1)
    square = (
        size - 2 * np.einsum("cmi,ci->cm", own, constant) + np.sum(constant**2, axis=1)[:, None]
    )
    carried_mean = mean - np.einsum("mij,cj->cmi", attitude, constant)
    return square - np.sum(carried_mean**2, axis=2)
