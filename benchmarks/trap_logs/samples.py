"""Traps of the samples: stamps that scatter, rows that are lost, samples that are wrong."""

from __future__ import annotations

import numpy as np

from trap_logs.log import Log, new_scene


def _jittered(rng, share: float) -> Log:
    """Stamps that scatter about the instants of the samples by ``share`` of the period; half of the
    references are looked up at the stamps, the others at the instants.
    """
    scene = new_scene(rng)
    late = np.clip(share * rng.standard_normal(len(scene.time)), -0.45, 0.45) * scene.h
    stamps = scene.time + late
    at = stamps if rng.random() < 0.5 else scene.time
    columns = scene.sensed() | {"ref_q": scene.attitude_at(at), "time": stamps}
    return scene.log(columns, "jitter", figures={"rms": share * scene.h})


def jitter_5_percent(rng) -> Log:
    return _jittered(rng, 0.05)


def jitter_20_percent(rng) -> Log:
    return _jittered(rng, 0.2)


def dropped_rows(rng) -> Log:
    """One row in a hundred is lost, each by itself."""
    scene = new_scene(rng)
    kept = rng.random(len(scene.time)) >= 0.01
    columns = scene.sensed() | {"ref_q": scene.attitude()}
    lost = {name: values[kept] for name, values in columns.items()}
    return scene.log(lost, "gaps", figures={"count": float(np.sum(~kept))})


def outliers(rng) -> Log:
    """One sample in 200 of each axis is a spike."""
    scene = new_scene(rng)
    columns = scene.sensed() | {"ref_q": scene.attitude()}
    hit = rng.random(columns["gyro"].shape) < 0.005
    size = rng.uniform(3, 30, hit.shape) * rng.choice([-1, 1], hit.shape)
    columns["gyro"] = columns["gyro"] + hit * size
    return scene.log(columns, "spikes", figures={"count": float(hit.sum())})


TRAPS = (jitter_5_percent, jitter_20_percent, dropped_rows, outliers)
