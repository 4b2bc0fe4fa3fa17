"""Traps of the clocks: sensor and reference do not show the same time."""

from __future__ import annotations

import numpy as np

from trap_logs.log import Log, Scene, new_scene


def _early(scene: Scene, early: float) -> Log:
    """The sensor shows the motion ``early`` s before the reference does; late where negative."""
    columns = scene.sensed(early) | {"ref_q": scene.attitude()}
    return scene.log(columns, "clock", figures={"late": -early}, late=early < 0)


def gyro_early_2_5_ms(rng) -> Log:
    return _early(new_scene(rng), 2.5e-3)


def gyro_early_12_5_ms(rng) -> Log:
    return _early(new_scene(rng), 12.5e-3)


def gyro_early_22_5_ms(rng) -> Log:
    return _early(new_scene(rng), 22.5e-3)


def reference_late_20_ms(rng) -> Log:
    scene = new_scene(rng)
    columns = scene.sensed() | {"ref_q": scene.attitude(late=0.02)}
    return scene.log(columns, "clock", figures={"late": -0.02})


def reference_early_then_late(rng) -> Log:
    """Two logs of one part: the reference 5 ms early in the one, 5 ms late in the other."""
    one = new_scene(rng)
    other = one.again()
    columns = tuple(
        s.sensed() | {"ref_q": s.attitude(late=late)} for s, late in ((one, -5e-3), (other, 5e-3))
    )
    return one.log(columns, "clock", figures={"late": 5e-3, "late_of_next": -5e-3})


def half_a_sample_ahead(rng) -> Log:
    scene = new_scene(rng)
    return _early(scene, 0.5 * scene.h)


def half_a_sample_behind(rng) -> Log:
    scene = new_scene(rng)
    return _early(scene, -0.5 * scene.h)


def half_a_sample_ahead_of_a_rate(rng) -> Log:
    """As ``half_a_sample_ahead``, against a rate that is known to a tenth of the gyro's noise."""
    scene = new_scene(rng)
    noise = 0.1 * scene.sensor.gyro.n / np.sqrt(scene.h)
    rate = scene.motion.rate(scene.time)
    seen = rate + noise * rng.standard_normal(rate.shape)
    columns = scene.sensed(0.5 * scene.h) | {"ref_rate": seen}
    return scene.log(columns, "clock", figures={"late": -0.5 * scene.h})


def offset_1_37_s(rng) -> Log:
    return _early(new_scene(rng), float(rng.choice([-1.37, 1.37])))


def _skewed(rng, skew: float) -> Log:
    """The reference's clock runs fast by ``skew``: what it stamps t happened at t (1 - skew)."""
    scene = new_scene(rng)
    skew *= float(rng.choice([-1.0, 1.0]))
    late = skew * scene.time
    columns = scene.sensed() | {"ref_q": scene.attitude(late=late)}
    return scene.log(columns, "skew", figures={"skew": skew})


def skew_50_ppm(rng) -> Log:
    return _skewed(rng, 50e-6)


def skew_500_ppm(rng) -> Log:
    return _skewed(rng, 500e-6)


def slipping_clocks(rng) -> Log:
    """Two 100 Hz clocks 1e-4 apart: each row holds the reference's latest sample, so that its delay
    runs from 0 to 10 ms and falls back.
    """
    scene = new_scene(rng, duration=float(rng.uniform(100, 140)))
    h, phase = scene.h, rng.uniform(0, 1)
    period = h * (1 + float(rng.choice([-1e-4, 1e-4])))
    start = phase * period - 2 * period
    number = np.floor((scene.time - start) / period).astype(int)
    samples = scene.attitude_at(start + period * np.arange(number.max() + 1))
    columns = scene.sensed() | {"ref_q": samples[number]}
    return scene.log(columns, "slips", figures={"span": h})


TRAPS = (
    gyro_early_2_5_ms,
    gyro_early_12_5_ms,
    gyro_early_22_5_ms,
    reference_late_20_ms,
    reference_early_then_late,
    half_a_sample_ahead,
    half_a_sample_behind,
    half_a_sample_ahead_of_a_rate,
    offset_1_37_s,
    skew_50_ppm,
    skew_500_ppm,
    slipping_clocks,
)
