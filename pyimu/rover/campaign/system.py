"""The units of a campaign, compiled once in a process: sensor, low-pass and attitude filter."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from pyimu.attitude.alignment import BIAS_STD, TILT_STD, YAW_STD
from pyimu.attitude.columns import rate_noise, wandering
from pyimu.attitude.filter.tolerances import bias_std, of_motion, start_values
from pyimu.attitude.filter.ukf import attitude_ukf
from pyimu.attitude.filter.variables import UNKNOWN_LATITUDE
from pyimu.attitude.stuck import LEAST
from pyimu.block.block import Block
from pyimu.block.parameters import with_values
from pyimu.errors import UserError
from pyimu.model.part import Part
from pyimu.plant.bodies import BODIES
from pyimu.plant.low_pass import low_pass
from pyimu.plant.rover_variables import LATITUDE
from pyimu.rover.campaign.draws import RISE, START, WARMING
from pyimu.rover.campaign.faults import SATURATING
from pyimu.rover.campaign.settings import Settings
from pyimu.rover.campaign.specimen import white_noise

SENSED = ("rate", "specific_force", "temperature")
"""What a part may measure and depend on in a campaign."""

WARMER = float(np.hypot(np.mean(START) + np.mean(RISE) / 2 - 25.0, np.ptp(START) / 12**0.5))
"""K; root mean square of a drive's temperature against 25 degC, at which a part's tolerances hold
beside their change per kelvin. A sol's is about the same."""

WALK = float(RISE[1] / 3**0.5 * (1 - np.exp(-1)) / np.mean(WARMING) ** 0.5)
"""K/sqrt(s); of a random walk that has warmed up as much after the mean time constant."""

RANGE = "gyro_error.saturation.limit"


@dataclass(frozen=True)
class System:
    """The blocks of a campaign: the ``sensor``, the ``low_pass`` behind it, and the ``filter``.

    ``part`` is what the filter knows, and ``nominal`` the sensor that is so; ``low_pass`` is None
    where there is none. Of a specimen the filter assumes beside it what ``pyimu.attitude.run`` does
    of a real sensor: a wander that the part is silent of, and scale factors that are not right.
    """

    settings: Settings
    part: Part
    sensor: Block
    nominal: Block
    low_pass: Block | None
    filter: Block

    def specimen(self, seed: int) -> Part:
        """The part that a run has."""
        return self.part.specimen(seed) if self.settings.draws_specimens else self.part.nominal

    @property
    def knows_rotation(self) -> bool:
        """Whether the filter knows the rate of the ground, which is that of the Earth or none."""
        return self.settings.on == "Earth"

    @property
    def start_std(self) -> np.ndarray:
        """Standard deviations (6,) before the first sample: attitude rad, bias rad/s.

        Those of an alignment at rest, and of a gyro that was not seen at rest what the part's
        tolerance says.
        """
        of_specimens = bias_std(self.part, WARMER) if self.settings.draws_specimens else 0.0
        return np.array(
            [TILT_STD, TILT_STD, YAW_STD, *np.full(3, np.hypot(BIAS_STD, of_specimens))]
        )

    def parameters(self, q0: np.ndarray, limit: np.ndarray | None) -> np.ndarray:
        """The filter's, with which it starts; ``limit`` (3,) rad/s is the gyro's range."""
        values = {
            "latitude": LATITUDE if self.knows_rotation else UNKNOWN_LATITUDE,
            "gravity": BODIES[self.settings.on].gravity,
            "rest_time": 0.0,
            "stuck_time": self.stuck_time,
            "q0": q0,
            "std0": self.start_std,
        }
        if self.settings.draws_specimens:
            values |= self.of_specimens
        return with_values(self.filter, values | self.of_range(limit))

    @property
    def of_specimens(self) -> dict[str, float]:
        """The filter's settings for specimens: what they do to rates in motion and to gravity."""
        values = start_values(self.part, WARMER)
        turning = float(np.hypot(rate_noise(self.part), values.get("rate_noise", 0.0)))
        known = {n: v for n, v in values.items() if "std0" not in n}
        return known | {"rate_noise": turning} | of_motion(turning)

    @property
    def constant_tilt(self) -> float:
        """Variance in rad^2 of a tilt by the accelerometer's constant error, as ``std`` has it."""
        std = self.of_specimens.get("accel_bias_std", 0.0) if self.settings.draws_specimens else 0.0
        return (std / BODIES[self.settings.on].gravity) ** 2

    def of_range(self, limit: np.ndarray | None) -> dict[str, np.ndarray]:
        """The parameter of sensor and filter that says the gyro's range, where it is too small."""
        return {} if limit is None else {RANGE: limit}

    @property
    def stuck_time(self) -> float:
        """s of equal samples that mean a stuck sensor; 0, never, where one has no white noise."""
        return LEAST if white_noise(self.part.gyro) and white_noise(self.part.accel) else 0.0


@lru_cache(maxsize=4)
def system_of(settings: Settings) -> System:
    """The units of a campaign.

    Raises UserError for a part that depends on what a campaign does not have.
    """
    part = replace(settings.part, sample_rate=settings.sensor_rate)
    if SATURATING in settings.faults:
        part = part.with_sensor(part.gyro.with_values("saturation"))
    sensor = part.nominal.block
    needed = dict.fromkeys(v.name.partition("[")[0] for v in sensor.inputs)
    missing = [name for name in needed if name not in SENSED]
    if missing:
        raise UserError(
            f"part {part.name} has effects of {', '.join(missing)}, which a campaign's drives do "
            "not have: leave these effects out of the part"
        )
    known = replace(part, sample_rate=settings.sensor_rate / settings.every)
    if settings.draws_specimens:
        known = wandering(known, WALK)
    behind = low_pass(1 / settings.sensor_rate) if settings.low_pass else None
    return System(settings, part, sensor, part.block, behind, attitude_ukf(known))
