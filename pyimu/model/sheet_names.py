"""What data sheets call the effects of the catalogue, for messages."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

SHEET_NAMES: Mapping[str, str] = MappingProxyType(
    dict.fromkeys(
        ("velocity_random_walk", "noise_density", "rate_noise_density", "white_noise"),
        "angle_random_walk",
    )
    | {"acceleration_random_walk": "rate_random_walk"}
    | dict.fromkeys(("bias", "offset", "zero_rate_offset", "zero_g_offset"), "turn_on_bias")
    | dict.fromkeys(("repeatability", "bias_repeatability"), "turn_on_bias")
    | dict.fromkeys(("bias_stability", "in_run_bias_stability"), "bias_instability")
    | dict.fromkeys(("sensitivity_error", "sensitivity_tolerance"), "scale_factor")
    | {"nonlinearity": "scale_factor_nonlinearity"}
    | dict.fromkeys(("cross_axis_sensitivity", "alignment", "orthogonality"), "misalignment")
    | dict.fromkeys(("temperature_bias", "bias_temperature_sensitivity"), "thermal_bias")
    | dict.fromkeys(("range", "full_scale", "measurement_range"), "saturation")
    | dict.fromkeys(("resolution", "sensitivity"), "quantization")
    | {"bandwidth": "lag"}
    | dict.fromkeys(("latency", "delay", "group_delay"), "time_delay")
)
"""A row of a data sheet and the effect that its figure belongs to."""
