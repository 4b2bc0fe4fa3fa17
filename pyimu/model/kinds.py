"""The kinds of triads, what they measure, and the stages of their errors."""

from __future__ import annotations

from dataclasses import dataclass

from pyimu.model.signals import COLUMNS

STAGES = ("motion", "dynamics", "gain", "bias", "noise", "output")
"""The order in which effects act on a sample: the motion that reaches the element, its dynamics,
gain, bias, noise, output."""


@dataclass(frozen=True)
class SensorKind:
    """A triad: the signal that it measures, that signal's rate, its unit and its integral's.

    Of a magnetometer's signal there is no rate: none of its effects follows from one.
    """

    name: str
    own: str
    own_rate: str
    unit: str
    integral: str

    def units(self, template: str) -> str:
        """A unit of a definition, with the triad's own units put in."""
        return template.replace("{y}", self.unit).replace("{Y}", self.integral)


KINDS = {
    "gyro": SensorKind("gyro", "rate", "angular_acceleration", "rad/s", "rad"),
    "accel": SensorKind("accel", "specific_force", "jerk", "m/s^2", "m/s"),
}
"""The triads of an inertial measurement unit: those that are simulated, and that the loop looks for
effects of."""

MAGNETOMETER = "mag"
"""The triad beside them. A part knows its errors: hard iron as a bias, soft iron in scale factors
and misalignment, noise (``Effect.magnetic``); ``pyimu.attitude`` undoes them."""

TRIADS = KINDS | {MAGNETOMETER: SensorKind(MAGNETOMETER, "mag", "", "T", "T*s")}
"""All triads whose errors a part may know."""

OWN = {kind: COLUMNS[k.own] for kind, k in KINDS.items()}
"""Where a sensor's own signal stands in the input vector."""

OWN_RATE = "own_rate"
"""Name of the rate of the sensor's own signal among an effect's environment: angular acceleration
or jerk."""
