"""A run of the attitude filter as data, the contents of report.json."""

from __future__ import annotations

from typing import Any

import numpy as np

from pyimu.attitude.outcome import NIS_BOUNDS, Outcome
from pyimu.attitude.report.words import ALIGNED, claimed_inclination, error_sizes, nis_inside, notes
from pyimu.files import plain


def contents(a: Outcome) -> dict[str, Any]:
    """The contents of report.json, in SI.

    ``name``, ``rows``, ``duration`` [s], ``sample_period`` [s], ``part`` (null without one),
    ``filter``, its name, ``smoothed``, whether each row is estimated by all rows, ``left_in``,
    ``notes``; ``rest``: the ``duration`` [s] of the rest at the start, or null;
    ``last``: {``time``, ``q``, ``euler``, ``gyro_bias``, ``std``, ``heading_std``};
    ``quasi_static`` and ``at_rest``: their shares of the samples; ``nis``: {``updates``, ``mean``,
    ``inside``, the share within ``bounds``}; ``magnetometer``: {``used``, the median ``strength``
    [T] of its samples, the ``calibration`` that was undone, {``bias`` [T], ``matrix``}, null
    without one, the ``world`` field by the World Magnetic Model in rad and T, null without a place,
    ``disturbed``: the share of the samples with a disturbed field, null where it is not used};
    ``status``: [{``bit``, ``text``, ``samples``, ``first`` and ``last`` [s]}];
    ``error``: {``rows``, ``assumed``, ``inclination``, ``total`` and ``heading``: {``rms``,
    ``p95``, ``unit``}}, of the inclination what the standard deviations have ``claimed``, too, null
    without a reference; ``quality`` as in the report of ``pyimu close``;
    ``parameters`` with which the filter's unit gives the same. The estimates are in
    attitude.parquet.
    """
    nis, calibration = a.nis[a.updates], a.magnetometer.calibration
    return plain(
        {
            "name": a.name,
            "rows": len(a.time),
            "duration": a.duration,
            "sample_period": a.recording.sample_period,
            "part": a.part or None,
            "filter": a.method,
            "smoothed": a.smoothed,
            "left_in": a.left_in,
            "notes": notes(a),
            "rest": a.rest.duration if a.rest is not None and a.rest.seen else None,
            "last": _last(a),
            "quasi_static": np.mean(a.quasi_static),
            "at_rest": np.mean(a.at_rest),
            "nis": {
                "updates": len(nis),
                "mean": nis.mean() if len(nis) else None,
                "inside": nis_inside(a),
                "bounds": NIS_BOUNDS,
            },
            "magnetometer": {
                "used": a.magnetometer.used,
                "strength": a.magnetometer.strength,
                "calibration": calibration and vars(calibration),
                "world": a.magnetometer.world and vars(a.magnetometer.world),
                "disturbed": a.disturbed if a.magnetometer.used else None,
            },
            "status": [vars(event) | {"text": event.text} for event in a.events],
            "error": None if a.error is None else _error(a),
            "quality": [f.as_dict() for f in a.findings],
            "parameters": a.parameters,
        }
    )


def _last(a: Outcome) -> dict[str, Any]:
    return {
        "time": a.time[-1],
        "q": a.q[-1],
        "euler": a.euler[-1],
        "gyro_bias": a.gyro_bias[-1],
        "std": a.std[-1],
        "heading_std": a.heading_std[-1],
    }


def _error(a: Outcome) -> dict[str, Any]:
    sizes = {
        name: {"rms": rms, "p95": most, "unit": "rad"}
        for name, (rms, most) in error_sizes(a.error).items()
    }
    sizes["inclination"]["claimed"] = claimed_inclination(a)
    return {"rows": len(a.error.time), "assumed": ALIGNED} | sizes
