"""Which terms of a formula stay, beside all else that is found."""

import numpy as np
from loop_cases import inputs, noise, trial

from pyimu.identification.fit.fit import begin
from pyimu.identification.fit.maximum_likelihood import fit, fit_and_normal
from pyimu.identification.formula.compose import borne, with_terms
from pyimu.identification.formula.effect import forget
from pyimu.identification.formula.terms import library
from pyimu.model.sensor import Sensor

SIGMA = 1e-3
NEEDED = 6.5
"""nat: the gate of some thousand terms."""


def test_terms_and_axes_stay_for_which_rows_speak_beside_the_others():
    """Of three terms one acts, on one axis, at 30 standard errors. Where nothing acts a coefficient
    passes its penalty in 1.4 logs of a hundred, and a term the gate in one of a hundred thousand.
    """
    rng, time = np.random.default_rng(6), np.arange(6000) * 0.01
    u = inputs(rng, time)
    acts = u[:, 0] * u[:, 5]
    size = 30 * SIGMA / np.linalg.norm(acts - acts.mean())
    y = u[:, :3] + noise(rng, time, SIGMA**2, 0.0)
    y[:, 2] += size * acts
    log = trial(time, y, u)
    terms = {t.text: t for t in library("gyro", (log,))}
    one, two, three = (
        terms[n]
        for n in ("rate x * specific force z", "rate y^3", "specific force x * specific force y")
    )
    chosen = [(one, (0, 2)), (two, (0,)), (three, (1,))]
    try:
        start = fit(begin(Sensor("gyro", {"turn_on_bias": {"b0": [0.0] * 3}}), (), [log]))
        found, normal = fit_and_normal(with_terms(start, "found_effect", chosen))
        assert borne(normal, found.sensor, "found_effect", chosen, NEEDED) == [(one, (2,))]
        assert borne(normal, found.sensor, "found_effect", chosen, 1e3) == []
    finally:
        forget()
