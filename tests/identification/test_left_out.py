"""Elements of an effect that were left out: the one that explains most, and what they leave unsure
of the others.
"""

import numpy as np
from loop_cases import inputs, noise, trial
from scipy.stats import binom, norm

from pyimu.identification.fit.fit import begin
from pyimu.identification.fit.keys import Coefficient, coefficients_of
from pyimu.identification.fit.maximum_likelihood import fit
from pyimu.identification.search.left_out import LeftOut, with_left_out
from pyimu.model.sensor import Sensor

H, ROWS, R = 0.04, 1500, 1e-4
LOGS = 80
NEAR = 0.1
"""How far the rate about z is from that about y, over both: what the one shows the other hides."""


def fitted(seed: int, m: np.ndarray, left_out: tuple[int, int] = (0, 2)):
    """Misalignment of all elements but one, of a log that turns about y and z almost alike."""
    rng, time = np.random.default_rng(seed), H * np.arange(ROWS)
    u = inputs(np.random.default_rng(5), time)
    u[:, 2] = u[:, 1] + NEAR * u[:, 2]
    y = u[:, :3] @ (np.eye(3) + m).T + noise(rng, time, R, 0.0)
    sensor = Sensor("gyro", {}).with_values("misalignment")
    free = coefficients_of(sensor, "misalignment") - {element(left_out)}
    return fit(begin(sensor, free, [trial(time, y, u)]))


def element(index: tuple[int, int]) -> Coefficient:
    return Coefficient("misalignment", "m", index)


def small(size: float) -> np.ndarray:
    m = np.zeros((3, 3))
    m[0, 2] = size
    return m


def test_the_largest_element_that_was_left_out_is_found():
    model = fitted(1, small(0.05))
    keys, gain, spread = LeftOut.of(model, ["misalignment"]).largest()
    assert keys == {element((0, 2))} and gain > 10.0 and spread >= 1.0
    assert LeftOut.of(model, ["misalignment"]).largest(keys)[0] != keys


def test_intervals_hold_although_an_element_was_left_out():
    """It is there in half of the logs, too small to be seen: what stands for it is off by it."""
    size = np.where(np.arange(LOGS) % 2, 0.01, 0.0)
    models = [fitted(100 + n, small(s)) for n, s in enumerate(size)]
    least = binom.ppf(1e-4, LOGS, 0.95)
    assert inside(models) < least <= inside(with_left_out(m, ["misalignment"]) for m in models)


def test_what_no_element_moves_stays_as_it_was():
    model = fitted(3, np.full((3, 3), 0.02) - 0.02 * np.eye(3))
    wider = with_left_out(model, ["misalignment"])
    for key in coefficients_of(model.sensor, "misalignment") - {element((0, 2))}:
        # The elements of an axis that tells y from z by a tenth say little of each other.
        ratio = wider.std[key] / model.std[key]
        assert ratio > 10 if key == element((0, 1)) else ratio < 1.01


def test_an_element_that_may_be_noise_may_be_zero():
    """In a row of which another element is plain, one of two standard errors is often noise."""
    m, key = np.zeros((3, 3)), element((1, 2))
    m[1, 0] = 0.01
    plain = fitted(2, m)
    for z, zero in ((2.2, True), (20.0, False)):
        m[key.index] = z * plain.std[key] - value(plain, key)
        model = fitted(2, m)
        std = with_left_out(model, ["misalignment"]).std[key]
        assert value(model, key) > 0.9 * z * plain.std[key]
        assert bool(value(model, key) <= norm.ppf(0.975) * std * 1.005) is zero


def value(model, key: Coefficient) -> float:
    return float(model.sensor.values["misalignment"]["m"][key.index])


def inside(models) -> int:
    """How many intervals of the element that is like the one left out hold the truth, none."""
    key = element((0, 1))
    errors = (value(m, key) / m.std[key] for m in models)
    return int(np.sum(np.abs(list(errors)) <= norm.ppf(0.975)))


def test_an_element_that_the_rows_show_beyond_doubt_leaves_an_interval():
    """However many nat speak for it: it may have been refused for another reason."""
    model = fitted(2, small(2.0))
    wider = with_left_out(model, ["misalignment"])
    assert all(np.isfinite(v) and v >= model.std[k] for k, v in wider.std.items() if k in model.std)
    assert wider.std[element((0, 1))] > 10 * model.std[element((0, 1))]
