"""The two figures that estimators know of a sensor: white noise N and the bias's random walk K."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from pyimu.errors import UserError
from pyimu.model.part import Part
from pyimu.model.typical import magnitudes
from pyimu.shaping import flicker_floor

NAMES = {"gyro": "gyro", "accel": "accelerometer"}

WALKS = (("rate_random_walk", "K"), ("gauss_markov", "q"), ("second_gauss_markov", "q"))
"""Coefficients that a bias wanders by at first, as a random walk does."""


@dataclass(frozen=True)
class Densities:
    """White noise ``N`` (3,) and the bias's random walk ``K`` (3,) of a sensor, in SI.

    Both are roots of two-sided densities: N in rad/s/sqrt(Hz) or m/s^2/sqrt(Hz), K in those per
    second. ``said`` says where K is from.
    """

    kind: str
    N: np.ndarray
    K: np.ndarray
    said: str

    @property
    def worst(self) -> tuple[float, float]:
        """N and K of the axis where each is largest, for files with one figure for all axes."""
        return float(np.max(self.N)), float(np.max(self.K))


def present(part: Part) -> dict[str, Densities]:
    """White noise and random walk of each sensor, by kind, that has white noise in ``part``.

    Raises UserError, as ``densities`` does, where none has.
    """
    kinds = [kind for kind in NAMES if _has_white_noise(part, kind)]
    return {kind: densities(part, kind) for kind in kinds or NAMES}


def lacking(part: Part, kind: str, needed_by: str) -> UserError:
    """That ``part`` has no white noise of a sensor, by whom it is needed, and how to get it."""
    return UserError(
        f"part {part.name} has no white noise of the {NAMES[kind]} "
        f"({kind}.angle_random_walk.N), which {needed_by} needs; "
        "pyimu characterize finds it in a log at rest"
    )


def _has_white_noise(part: Part, kind: str) -> bool:
    N = part.sensor(kind).values.get("angle_random_walk", {}).get("N", np.zeros(3))
    return bool(np.all(N > 0)) and (kind, "angle_random_walk", "N") not in part.estimate


def densities(part: Part, kind: str) -> Densities:
    """White noise and random walk of a sensor of ``part``.

    Where the part has no random walk, K is the one that beside N has the part's bias instability B
    as the lowest Allan deviation: sqrt(2 N K / sqrt(3)) is the floor of white noise and random walk
    (their variances N^2 / t and K^2 t / 3 at t = sqrt(3) N / K), 0.664 B that of the flicker (IEEE
    Std 952). A part without B has the typical one of a consumer part. Raises UserError for a part
    without white noise.
    """
    values = part.sensor(kind).values
    if not _has_white_noise(part, kind):
        raise lacking(part, kind, "every estimator")
    N = values["angle_random_walk"]["N"]
    found = [values[effect][name] for effect, name in WALKS if effect in values]
    K = np.sqrt(np.sum(np.square(found), axis=0)) if found else np.zeros(3)
    if np.all(K > 0):
        return Densities(kind, N, K, "the part's random walk")
    B, said = _instability(part, kind)
    from_floor = math.sqrt(3) / 2 * np.square(flicker_floor(1.0) * B) / N
    return Densities(kind, N, np.where(K > 0, K, from_floor), said)


def _instability(part: Part, kind: str) -> tuple[np.ndarray, str]:
    B = part.sensor(kind).values.get("bias_instability", {}).get("B", np.zeros(3))
    if np.any(B > 0):
        return np.where(
            B > 0, B, np.max(B)
        ), "from the bias instability, so that N and K share its floor"
    typical = magnitudes("bias_instability", kind)["consumer"]
    text = f"{typical.value:g} {typical.unit}"
    return np.full(
        3, typical.si
    ), f"not in the part: from a consumer part's bias instability, {text}"
