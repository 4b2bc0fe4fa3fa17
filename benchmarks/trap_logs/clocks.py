"""Traps of the clocks: sensor and reference do not show the same time."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from trap_logs.log import Log, Scene, beside, new_scene


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


def stamps_in_bursts(rng) -> Log:
    """A bus hands over 4 to 10 samples at once; each is stamped when it is read. The reference is
    in a file of its own.
    """
    scene = new_scene(rng)
    size = int(rng.integers(4, 11))
    burst = np.arange(len(scene.time)) // size
    wait = (2e-3 + 1e-3 * rng.exponential(size=burst[-1] + 1))[burst]
    within = (np.arange(len(scene.time)) % size) * rng.uniform(0.1e-3, 0.4e-3)
    stamps = scene.h * (burst * size + size - 1) + np.minimum(wait, 0.9 * size * scene.h) + within
    stamps = np.maximum.accumulate(stamps) + 1e-9 * np.arange(len(stamps))
    return beside(scene, scene.sensed() | {"time": stamps}, "bursts", late=True)


def clock_set_anew(rng) -> Log:
    """The clock of the reference, or of the log, is set 20 to 150 ms ahead once."""
    scene = new_scene(rng)
    size, at = rng.uniform(0.02, 0.15), scene.time[-1] * rng.uniform(0.3, 0.6)
    sensed, figures = scene.sensed(), {"span": size}
    if rng.random() < 0.5:
        return beside(scene, sensed, "slips", lambda t: t + size * (t > at), figures=figures)
    sensed["time"] = sensed["time"] + size * (sensed["time"] > at)
    return beside(scene, sensed, "slips", figures=figures)


def clock_slewed(rng) -> Log:
    """A daemon takes an offset of 5 to 20 ms out of the reference's clock at 500 ppm."""
    scene = new_scene(rng)
    size, at = rng.uniform(0.005, 0.02), scene.time[-1] * rng.uniform(0.2, 0.4)
    size *= float(rng.choice([-1.0, 1.0]))

    def stamped(t):
        return t + np.sign(size) * np.clip(500e-6 * (t - at), 0.0, abs(size))

    return beside(scene, scene.sensed(), "wanders", stamped, figures={"span": abs(size)})


def nominal_stamps(rng) -> Log:
    """Rows are counted at 100 Hz, and the sensor's oscillator runs 0.5 to 2 % faster or slower."""
    scene = new_scene(rng)
    pace = rng.uniform(0.005, 0.02) * float(rng.choice([-1.0, 1.0]))
    span = min(1.0, 1.0 / (1.0 + pace))
    inside = replace(scene, time=scene.time[: int(len(scene.time) * span)])
    sensed = replace(inside, time=inside.time * (1 + pace)).sensed() | {"time": inside.time}
    return beside(scene, sensed, "skew", figures={"skew": pace})


def rows_lost_uncounted(rng) -> Log:
    """Rows are counted, and one in 300 is lost before."""
    scene = new_scene(rng)
    return _uncounted(scene, rng.random(len(scene.time)) >= 1 / 300, "wanders")


def block_lost_uncounted(rng) -> Log:
    """Rows are counted, and 20 to 60 of them were lost at once."""
    scene = new_scene(rng)
    first = int(len(scene.time) * rng.uniform(0.3, 0.6))
    kept = np.ones(len(scene.time), dtype=bool)
    kept[first : first + int(rng.integers(20, 61))] = False
    return _uncounted(scene, kept, "slips")


def _uncounted(scene: Scene, kept: np.ndarray, cause: str) -> Log:
    sensed = {name: values[kept] for name, values in scene.sensed().items()}
    sensed["time"] = scene.time[: len(sensed["time"])]
    lost = float(np.sum(~kept)) * scene.h
    return beside(scene, sensed, cause, figures={"span": lost})


def leap_seconds(rng) -> Log:
    """The log counts in UTC, the reference in the time of GPS, which is 18 s ahead."""
    scene = new_scene(rng, duration=float(rng.uniform(90, 150)))
    return beside(scene, scene.sensed(), "clock", lambda t: t + 18.0, figures={"late": -18.0})


def reference_stamps_rounded(rng) -> Log:
    """The stamps of the reference have two decimals."""
    scene = new_scene(rng)
    return beside(scene, scene.sensed(), "nothing", lambda t: np.round(t, 2), hz=(55, 75))


TRAPS = (
    stamps_in_bursts,
    clock_set_anew,
    clock_slewed,
    nominal_stamps,
    rows_lost_uncounted,
    block_lost_uncounted,
    leap_seconds,
    reference_stamps_rounded,
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
