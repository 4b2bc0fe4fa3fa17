"""The unit ``LowPass``: the second-order Butterworth filter between a sensor and what uses it."""

from __future__ import annotations

import math

import casadi as ca

from pyimu.block.block import Block
from pyimu.block.plain import plain_function
from pyimu.block.variables import IMU, Limits, Variable, array, in_terminal
from pyimu.symbolic.missing import is_finite
from pyimu.units import STANDARD_GRAVITY

CUTOFF = 10.0
"""Hz; Hidalgo 2012, section 6.1: "low-pass filtered at 10 Hz"."""

CHANNELS = 6

FILTERED = "filtered"
"""What the outputs are called before the names of the inputs, and their terminal."""

REMEMBERED = 4 * CHANNELS
"""Numbers of state: the last two inputs and outputs of every channel."""


def low_pass(sample_period: float, cutoff: float = CUTOFF) -> Block:
    """The block of a low-pass for six channels, gyro and accelerometer, with a ``cutoff`` in Hz.

    It is the filter of an on-board computer, which has samples only: the bilinear transform of the
    Butterworth filter, prewarped, so that the gain at ``cutoff`` is 1/sqrt(2) whatever the sample
    period and 0 at half the sample rate (Oppenheim and Schafer 2010, section 7.2.2). It is what
    ``scipy.signal.butter(2, cutoff, fs=...)`` and the like design. The catalogue's effect ``lag``
    is the low-pass of an analogue read-out, with poles and delay of that.

    Its first sample finds it settled. A sample that is no number is answered by none, and the
    filter goes on as if the last one had been held. A ``cutoff`` of 0 lets everything pass.
    """
    u, h = ca.SX.sym("u", CHANNELS), ca.SX.sym("h")
    begun, cutoff_, memory = (
        ca.SX.sym("begun", CHANNELS),
        ca.SX.sym("cutoff"),
        ca.SX.sym("memory", REMEMBERED),
    )
    y, kept = _filtered(u, begun, ca.reshape(memory, CHANNELS, 4), cutoff_, h)
    step = plain_function(
        "step",
        [ca.vertcat(begun, memory), u, cutoff_, ca.SX(0, 1), h],
        [kept, y],
        ["s", "u", "p", "w", "h"],
        ["s_next", "y"],
    )
    initial = plain_function(
        "initial",
        [u, cutoff_],
        [ca.SX(ca.DM.zeros(CHANNELS + REMEMBERED)), u],
        ["u", "p"],
        ["s", "y"],
    )
    return Block(
        name="LowPass",
        description="Second-order Butterworth low-pass of gyro and accelerometer",
        step=step,
        initial=initial,
        inputs=in_terminal(IMU, *_triads()),
        parameters=(
            Variable("cutoff", "Hz", "frequency of half the power; 0: none", cutoff, minimum=0.0),
        ),
        outputs=in_terminal(FILTERED, *_triads(FILTERED), prefix=f"{FILTERED}_"),
        noise=(),
        sample_period=sample_period,
        limits=_limits(),
    )


def _triads(filtered: str = "") -> tuple[Variable, ...]:
    """The channels; of the outputs, which need names of their own, ``filtered``."""
    prefix, more = (f"{filtered}_", f", {filtered}") if filtered else ("", "")
    return (
        *array(f"{prefix}gyro", "rad/s", f"measured rate against inertial space, body axes{more}"),
        *array(
            f"{prefix}accel",
            "m/s^2",
            f"measured specific force, body axes{more}",
            (0.0, 0.0, STANDARD_GRAVITY),
        ),
    )


def coefficients(angle) -> tuple[tuple, tuple]:
    """(b0, b1, b2), (a1, a2) of the filter whose cutoff is ``angle`` rad a sample."""
    k = ca.tan(angle / 2)
    scale = 1 / (1 + math.sqrt(2) * k + k * k)
    b0 = k * k * scale
    return (b0, 2 * b0, b0), (2 * (k * k - 1) * scale, (1 - math.sqrt(2) * k + k * k) * scale)


def _filtered(u, begun, memory, cutoff, h) -> tuple:
    """The outputs, and what is remembered."""
    b, a = coefficients(2 * math.pi * cutoff * h)
    number = is_finite(u)
    first = ca.if_else(begun, 0, number)
    x1, x2, y1, y2 = (ca.if_else(first, u, memory[:, i]) for i in range(4))
    felt = ca.if_else(number, u, x1)
    passed = b[0] * felt + b[1] * x1 + b[2] * x2 - a[0] * y1 - a[1] * y2
    answer = ca.if_else(cutoff > 0, passed, felt)
    started = ca.fmax(begun, number)
    return ca.if_else(number, answer, u), ca.vertcat(started, felt, x1, answer, y1)


def _limits() -> Limits:
    p, h = ca.SX.sym("p"), ca.SX.sym("h")
    broken = plain_function("limits", [p, h], [ca.densify(2 * p * h >= 1)], ["p", "h"], ["broken"])
    return Limits(("cutoff must be below half the sample rate",), broken)
