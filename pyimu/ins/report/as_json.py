"""A navigated recording as data, the contents of report.json."""

from __future__ import annotations

from typing import Any

import numpy as np

from pyimu.files import plain
from pyimu.ins.outcome import Outcome
from pyimu.ins.report.words import notes
from pyimu.ins.track import PositionError, Track


def contents(a: Outcome) -> dict[str, Any]:
    """The contents of report.json, in SI.

    ``name``, ``rows``, ``duration`` [s], ``sample_period`` [s], ``part`` (null without one),
    ``zupt``, ``nhc``, ``heading0`` [rad] and ``heading_from``, ``gains``, how many scale factors
    and misalignments were estimated, ``notes``; ``rests``: {``share`` of the samples, ``stops``
    after the start, ``longest_leg`` [s] without one, ``at_start`` [s]}; ``methods``: by name
    {``position`` and ``velocity`` at the end, ``position_std``, ``error``: {``end``, ``rms``,
    ``most``, ``up`` [m], ``yaw`` [rad] at the end, ``length`` [m] of the reference}, null without a
    reference};
    ``nis``: {``first_zupt``, those of each stop, ``first_zupt_mean``, ``zaru_mean``, ``nhc_mean``,
    ``position_mean``, ``velocity_mean``, those of what the log measured};
    ``findings``; ``parameters`` with which the filter's unit gives the same.
    """
    first = a.first_zupts
    return plain(
        {
            "name": a.name,
            "rows": len(a.time),
            "duration": a.duration,
            "sample_period": a.recording.sample_period,
            "part": a.part or None,
            "zupt": a.zupt,
            "nhc": a.nhc,
            "heading0": a.heading0,
            "heading_from": a.heading_from,
            "gains": a.gains,
            "notes": notes(a),
            "rests": {
                "share": a.still.mean(),
                "stops": len(a.later_stops),
                "longest_leg": a.longest_leg,
                "at_start": a.rest.duration if a.rest is not None and a.rest.seen else None,
            },
            "methods": {
                name: _track(track) | {"error": _error(a.errors.get(name))}
                for name, track in a.tracks.items()
            },
            "nis": {
                "first_zupt": first,
                "first_zupt_mean": first.mean() if len(first) else None,
                "zaru_mean": a.mean_nis("zaru_nis"),
                "nhc_mean": a.mean_nis("nhc_nis"),
                "position_mean": a.mean_nis("position_nis"),
                "velocity_mean": a.mean_nis("velocity_nis"),
            },
            "findings": [f.as_dict() for f in a.findings],
            "parameters": a.settings,
        }
    )


def _track(track: Track) -> dict[str, Any]:
    std = track.position_std
    return {
        "position": track.position[-1],
        "velocity": track.velocity[-1],
        "position_std": None if std is None else std[-1],
    }


def _error(error: PositionError | None) -> dict[str, Any] | None:
    if error is None:
        return None
    return {
        "end": error.end,
        "rms": error.rms,
        "most": error.most,
        "up": error.up[-1] if np.isfinite(error.up[-1]) else None,
        "yaw": error.yaw if np.isfinite(error.yaw) else None,
        "length": error.length,
    }
