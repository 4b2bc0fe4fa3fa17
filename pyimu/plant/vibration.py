"""Coherent vibration of a body that drives: lines in rate and force, off at standstill.

A line is a small rotation of the body and a small displacement of it, whose derivatives are the
lines in rate and force: attitude, position, rate and force stay those of one motion.
"""

from __future__ import annotations

import math

import casadi as ca

from pyimu.symbolic.linear import reciprocal

CREEP = 1e-3
"""m/s; speed of the wheels at which the motors' lines have half their amplitude."""


def wheel_speeds(speed, turn_rate, track) -> tuple:
    """Speed m/s of the wheels of the left and of the right side, ``track`` m apart.

    In the middle of each side; the steered wheels before and behind go round a little faster.
    """
    return speed - turn_rate * track / 2, speed + turn_rate * track / 2


def running(left, right):
    """How far the motors run, 0 at standstill and 1 at speed: w^2 / (w^2 + ``CREEP``^2).

    w^2 is the mean of the squared speeds of both sides.
    """
    square = (left * left + right * right) / 2
    return square / (square + CREEP * CREEP)


def motor_line(time, frequency, on, rate, force) -> tuple:
    """Rotation (3,) rad and displacement (3,) m by the motors, in body axes.

    ``rate`` rad/s and ``force`` m/s^2 (3,) are the amplitudes of the lines at ``frequency`` Hz,
    where the motors run (``on`` = 1).
    """
    omega = 2 * math.pi * frequency
    angle, period = omega * time, reciprocal(omega)
    return on * rate * period * ca.sin(angle), -on * force * (period * period) * ca.cos(angle)


def wheel_line(distances, spacing, speed, rate, force) -> tuple:
    """Rotation (3,) rad and displacement (3,) m by the treads of the wheels, in body axes.

    ``distances`` m are those gone by the wheels of both sides, ``spacing`` m is between two treads:
    the frequency is the speed over it. ``rate`` rad/s and ``force`` m/s^2 (3,) are the amplitudes
    where all wheels go at ``speed`` m/s; they rise with the speed and its square.
    """
    number = 2 * math.pi / spacing
    wave = sum((ca.sin(number * d) for d in distances), 0) / len(distances)
    period = reciprocal(number * speed)
    return rate * period * wave, -force * (period * period) * wave
