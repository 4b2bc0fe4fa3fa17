"""Errors in variables: what the noise of a derived reference does to coefficients."""

from __future__ import annotations

import numpy as np
from scipy.signal import lfilter

from pyimu.identification.fit.columns import band_segments, band_time, in_band, reference_input
from pyimu.identification.fit.fit import Fit, stepped
from pyimu.identification.fit.keys import coefficient_of
from pyimu.identification.fit.normal import normal_equations, solve
from pyimu.identification.fit.response import after_dynamics, memoryless
from pyimu.identification.fit.trial import rest_noise
from pyimu.identification.fit.whiten import AR_ORDER, Autoregressive, RandomWalk
from pyimu.model.catalogue import WALK, WHITE
from pyimu.model.sensor import Sensor

WINDOW = 64
"""Rows of the windows in which the quiet is looked for."""

DRAWN = 512
"""Windows that are drawn to see how quiet chance makes a quarter of them."""


def without_attenuation(fitted: Fit) -> Fit:
    """Take out the bias that noise of a derived reference puts into coefficients (errors in
    variables).

    With an error e on the input, residual and regressor hold -e and (d column/dx) e: their product
    has a mean, which pulls a scale factor down. In whitened rows the residual has unit variance,
    so the sum of the products is the number of rows times the mean of d column/dx times the
    reference's share of that variance (Fuller 1987, section 1.2).
    """
    if all(t.band_hz is None for t in fitted.trials):
        return fitted
    normal = normal_equations(fitted.linearise(), fitted.noise)
    pull = np.zeros(len(normal.keys))
    rest = after_dynamics(fitted.sensor)
    response = memoryless(rest.chain)
    shares = _reference_shares(fitted)
    for t in fitted.trials:
        slope = response.mean_slope(reference_input(t, fitted.states[t.name]), rest.p, t.h)
        rows = len(band_time(t))
        for e, (axis, slot) in enumerate(zip(response.axis, response.slot, strict=True)):
            key = coefficient_of(rest.slots[slot])
            if key in normal.position and int(axis) in t.axes:
                pull[normal.position[key]] += rows * slope[e] * shares[int(axis)]
    return stepped(fitted, normal.keys, solve(normal.gram, pull)).with_noise()


def own_noise(fitted: Fit) -> dict[int, RandomWalk]:
    """The sensor's own noise at the sample rate: as declared, else its white part as its quiet rows
    show it.
    """
    h = fitted.trials[0].h
    white, walk = (_declared(fitted.sensor, *name) for name in (WHITE, WALK))
    if white.any():
        std = white / np.sqrt(h)
    else:
        std = np.mean([rest_noise(t) for t in fitted.trials], axis=0)
    return {i: RandomWalk(float(std[i] ** 2), float(walk[i] ** 2)) for i in fitted.noise}


def _declared(sensor: Sensor, effect: str, parameter: str) -> np.ndarray:
    """A coefficient (3,) of the model, zero where it lacks the effect."""
    return sensor.values[effect][parameter] if effect in sensor.values else np.zeros(3)


def floor_noise(fit: Fit) -> dict[int, RandomWalk]:
    """Noise at the sample rate for the floor: as fitted, or the sensor's own where the reference is
    derived.
    """
    return (
        dict(fit.noise)
        if all(isinstance(n, RandomWalk) for n in fit.noise.values())
        else own_noise(fit)
    )


def reference_variance(fit: Fit) -> np.ndarray:
    """Variance (3,) in a row of the band that a derived reference adds to the sensor's own noise.

    It is read off the quietest quarter of the fitted windows, and is by as much more than these
    show as noise of one level would be.
    """
    noise = np.zeros(3)
    if all(t.band_hz is None for t in fit.trials):
        return noise
    own, residuals = own_noise(fit), fit.residuals()
    for i in own:
        windows = np.concatenate([_windows(one.residual[:, i], one.segments) for one in residuals])
        if not len(windows):
            continue
        share = np.mean([np.sum(np.square(t.band.weights)) for t in fit.trials])
        noise[i] = max(0.0, _quiet(windows) / _lowness(fit.noise[i]) - own[i].r * share)
    return noise


def _quiet(windows: np.ndarray) -> float:
    """Mean variance of the quietest quarter of windows (k, ``WINDOW``)."""
    return float(np.mean(np.sort(windows.var(axis=1))[: max(1, len(windows) // 4)]))


def _lowness(noise: RandomWalk | Autoregressive, seed: int = 1) -> float:
    """What the quietest quarter of windows shows of the variance where noise of one spectrum, that
    which was fitted, has one level.
    """
    coefficients = noise.coefficients if isinstance(noise, Autoregressive) else ()
    drawn = np.random.default_rng(seed).standard_normal(DRAWN * WINDOW)
    like = lfilter([1.0], np.concatenate([[1.0], -np.array(coefficients)]), drawn)
    settled = like[AR_ORDER * WINDOW :].reshape(-1, WINDOW)
    return _quiet(settled) / float(np.mean(settled.var(axis=1)))


def _windows(values: np.ndarray, segments: list[tuple[int, int]]) -> np.ndarray:
    """Whole windows (k, ``WINDOW``) of values (n,), none of which reaches over a gap."""
    parts = [values[a : a + (b - a) // WINDOW * WINDOW].reshape(-1, WINDOW) for a, b in segments]
    return np.concatenate(parts) if parts else np.zeros((0, WINDOW))


def simulated(
    noise: dict[int, RandomWalk], time: np.ndarray, rng: np.random.Generator
) -> np.ndarray:
    """White noise and random walk (n, 3) at the sample rate."""
    out = np.zeros((len(time), 3))
    steps = np.sqrt(np.maximum(np.diff(time, prepend=time[:1]), 0.0))
    for i, n in noise.items():
        out[:, i] = np.sqrt(n.r) * rng.standard_normal(len(time)) + np.cumsum(
            np.sqrt(n.k2) * steps * rng.standard_normal(len(time))
        )
    return out


def _reference_shares(fitted: Fit, seed: int = 1) -> dict[int, float]:
    """Share of each axis's whitened residual that is not the sensor's own noise: one less what that
    noise, simulated, leaves.
    """
    t = max(fitted.trials, key=lambda t: t.count)
    seen = in_band(t, simulated(own_noise(fitted), t.time, np.random.default_rng(seed)))
    return {
        i: max(
            0.0,
            1.0 - float(np.mean(n.whiten(seen[:, i : i + 1], band_time(t), band_segments(t)) ** 2)),
        )
        for i, n in fitted.noise.items()
    }
