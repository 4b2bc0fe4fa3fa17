"""What a characterisation found as data, the contents of report.json."""

from __future__ import annotations

from typing import Any

from pyimu.characterization.allan.moments import TERMS
from pyimu.characterization.estimate import Estimate
from pyimu.characterization.noise.coefficients import Coefficient
from pyimu.characterization.outcome import (
    SAMPLE,
    SI,
    Channel,
    Curve,
    LogResult,
    NoiseAnalysis,
    Outcome,
    SensorResult,
)
from pyimu.characterization.report.beside import beside_entry
from pyimu.characterization.report.magnetometer import magnetometer_entry
from pyimu.characterization.spectrum.bandwidth import Bandwidth
from pyimu.characterization.spectrum.lines import Line
from pyimu.characterization.temperature.fit import NAMES
from pyimu.characterization.temperature.hysteresis import Hysteresis
from pyimu.characterization.temperature.warm_up import WarmUp
from pyimu.files import plain


def contents(c: Outcome) -> dict[str, Any]:
    """The contents of report.json.

    ``level``, the probability of the intervals; ``moving``, the names of logs that do not rest,
    ``in_counts``, of those that hold raw counts in a false unit, and ``in_false_unit``, of those
    whose forces have another unit than is stated; ``logs``, a list of {``name``, ``rows``,
    ``duration`` [s], ``quality`` (as in the report of ``pyimu close``), ``sensors``,
    ``magnetometer``, null where ``magnetometer_reason`` says why, or where there is none};
    ``part``: {channel: {letter: coefficient + ``spread`` over the logs, null for one}};
    ``data_sheet``, null without one or without a part: {``part``, by sensor [{``name``, ``unit``,
    ``data_sheet``, ``measured`` (x, y, z) as printed, ``times`` the data sheet's,
    ``upper_bound``}]}.

    ``magnetometer``: {``bias``, ``matrix``, ``misalignment``, ``strength``, ``dip`` and ``delay``,
    each {``value``, ``std``, ``unit``}; ``noise``, ``along`` and ``across``: {``value``, ``unit``};
    ``covariance`` of bias and matrix; ``attitudes``}.

    ``sensors``: {``gyro`` and ``accel``: {``sample_period`` [s], ``samples``, ``segments``,
    ``gaps_closed``, ``segments_used``, ``psd``: {``frequency`` [Hz], ``density`` by channel,
    one-sided},
    ``lines_from`` and ``lines_to`` [Hz], between which lines were looked for, ``channels``}},
    and ``channels``: {``gyro_x`` ...: {``unit``, ``mean``, ``coefficients``, ``allan``:
    {``tau`` [s], ``deviation``, ``low``, ``high``, ``freedom``}, ``modified`` and ``hadamard``:
    {``tau``, ``deviation``}, ``fit``: {``shortest`` tau [s], ``model_error``, ``misfit``,
    ``freedom``, ``terms`` of the curve, their ``estimates`` and ``covariance``}, ``gauss_markov``:
    [coefficient of the standard deviation + {``correlation_time`` [s], ``correlation_time_spread``
    of its logarithm}], ``models``: those compared, the one taken first [{``terms``,
    ``correlation_times`` [s], ``log_likelihood`` and ``cost`` [nat], ``model_error``}], ``floor``:
    {``deviation``, ``tau``, ``upper_bound``: whether a longer log may show a lower one},
    ``lines``: [{``frequency``, ``frequency_std`` and ``width`` [Hz],
    ``amplitude``, ``amplitude_std``, ``unit``, ``ratio`` to the background, ``p_value``,
    ``relation``}], ``thermal`` and its ``hysteresis`` with ``kh`` and ``width`` [K] of the
    catalogue's effect, ``warm_up``, ``bandwidth`` (where the noise is down by 3 dB, the kind
    of ``low_pass`` and its ``order``, null where it was read off, and others ``alike``;
    null in a log that moves), ``reason``}}.

    A coefficient is {``value``, ``std``, ``low``, ``high``, ``unit``, ``needed``}; one that is
    not needed has the value null and the interval from 0 to its upper bound. What is not a
    number is null.
    """
    part: dict[str, dict] = {}
    for (channel, term), s in c.coefficients.items():
        entry = _coefficient(s.mean, SI[channel.partition("_")[0]][term])
        part.setdefault(channel, {})[term] = entry | {"spread": s.spread, "logs": s.logs}
    logs = [_log(v) for v in c.logs]
    return plain(
        {
            "level": c.level,
            "moving": c.moving,
            "in_counts": c.in_counts,
            "in_false_unit": tuple(c.in_false_unit),
            "logs": logs,
            "part": part,
            "data_sheet": beside_entry(c),
        }
    )


def _log(log: LogResult) -> dict[str, Any]:
    return {
        "name": log.name,
        "rows": log.rows,
        "duration": log.duration,
        "quality": [f.as_dict() for f in log.findings],
        "sensors": {k: _sensor(s) for k, s in log.sensors.items()},
        "magnetometer": log.magnetometer and magnetometer_entry(log.magnetometer),
        "magnetometer_reason": log.magnetometer_reason or None,
    }


def _sensor(s: SensorResult) -> dict[str, Any]:
    density = {c.name: s.psd.density[:, i] for i, c in enumerate(s.channels)}
    return {
        "sample_period": s.h,
        "samples": s.samples,
        "segments": s.segments,
        "gaps_closed": s.closed,
        "segments_used": s.segments_used,
        "psd": {
            "frequency": s.psd.frequency,
            "density": density if len(s.psd.frequency) else {},
            "averages": s.psd.averages,
            "sides": 1,
            "unit": f"({SAMPLE[s.kind]})^2/Hz",
        },
        "lines_from": s.searched[0],
        "lines_to": s.searched[1],
        "channels": {c.name: _channel(c) for c in s.channels},
    }


NOISE = (
    "coefficients",
    "allan",
    "modified",
    "hadamard",
    "fit",
    "gauss_markov",
    "models",
    "floor",
)
"""What a channel has only where its noise could be characterised, else null."""


def _channel(c: Channel) -> dict[str, Any]:
    unit = SAMPLE[c.kind]
    return (
        {"unit": unit, "mean": c.mean, "reason": c.reason or None}
        | dict.fromkeys(NOISE)
        | ({} if c.noise is None else _noise(c.noise, c.kind))
        | {
            "lines": [_line(v, unit) for v in c.lines],
            "thermal": _thermal(c),
            "warm_up": c.warm_up and _warm_up(c.warm_up, unit),
            "bandwidth": c.bandwidth
            and _estimate(c.bandwidth.frequency, "Hz") | _low_pass(c.bandwidth),
        }
    )


def _low_pass(b: Bandwidth) -> dict[str, Any]:
    found = b.low_pass
    return {
        "low_pass": found and found.kind,
        "order": found and found.order,
        "alike": [{"low_pass": v.kind, "order": v.order} for v in b.alike],
    }


def _noise(n: NoiseAnalysis, kind: str) -> dict[str, Any]:
    limits = {"low": n.allan.low, "high": n.allan.high, "freedom": n.allan.freedom}
    return {
        "coefficients": {t: _coefficient(n.fit[t], SI[kind][t]) for t in TERMS},
        "allan": _curve(n.allan) | limits,
        "modified": _curve(n.modified),
        "hadamard": _curve(n.hadamard),
        "as_measured": n.as_measured and _curve(n.as_measured),
        "fit": {
            "shortest": n.fit.shortest,
            "model_error": n.fit.model_error,
            "misfit": n.fit.misfit,
            "freedom": n.fit.freedom,
            "terms": "".join(n.fit.estimates),
            "estimates": dict(n.fit.estimates),
            "covariance": n.fit.covariance,
        },
        "gauss_markov": [
            _coefficient(g.sigma, SAMPLE[kind])
            | {"correlation_time": g.time, "correlation_time_spread": g.spread}
            for g in n.fit.markov
        ],
        "models": [
            {
                "terms": m.terms,
                "correlation_times": [time * n.fit.sample_period for time in m.times],
                "log_likelihood": m.nats,
                "cost": m.cost,
                "model_error": m.error,
            }
            for m in n.fit.models
        ],
        "floor": {"deviation": n.floor.deviation, "tau": n.floor.tau, "upper_bound": n.floor.bound},
    }


def _curve(c: Curve) -> dict[str, Any]:
    return {"tau": c.tau, "deviation": c.deviation}


def _coefficient(c: Coefficient, unit: str) -> dict[str, Any]:
    value = {"value": c.value if c.needed else None}
    return _estimate(c, unit) | value | {"needed": c.needed}


def _estimate(e: Estimate, unit: str) -> dict[str, Any]:
    return {"value": e.value, "std": e.std, "low": e.low, "high": e.high, "unit": unit}


def _line(v: Line, unit: str) -> dict[str, Any]:
    return {
        "frequency": v.frequency,
        "frequency_std": v.frequency_std,
        "width": v.width,
        "amplitude": v.amplitude,
        "amplitude_std": v.amplitude_std,
        "unit": unit,
        "ratio": v.ratio,
        "p_value": v.p_value,
        "relation": v.relation.text if v.relation else None,
    }


def _warm_up(w: WarmUp, unit: str) -> dict[str, Any]:
    return {
        "amplitude": w.amplitude,
        "std": w.std,
        "time_constant": w.tau,
        "p_value": w.p_value,
        "unit": unit,
    }


def _thermal(c: Channel) -> dict[str, Any] | None:
    t, unit = c.thermal, SAMPLE[c.kind]
    if t is None:
        return None
    powers = {n: "" if i == 0 else "/K" if i == 1 else f"/K^{i}" for i, n in enumerate(NAMES)}
    return {
        "order": t.order,
        "T0": t.T0,
        "unit": unit,
        "bound": t.bound,
        "p_value": t.p_value,
        "hysteresis": t.hysteresis and _hysteresis(t.hysteresis, unit),
        "hysteresis_reason": t.no_hysteresis,
        "coefficients": {n: _estimate(v, unit + powers[n]) for n, v in t.coefficients.items()},
    }


def _hysteresis(h: Hysteresis, unit: str) -> dict[str, Any]:
    return {
        "opening": h.opening.value,
        "std": h.opening.std,
        "low": h.opening.low,
        "high": h.opening.high,
        "p_value": h.p_value,
        "warranted": h.warranted,
        "kh": h.kh,
        "width": h.width,
        "unit": unit,
        "kh_unit": f"{unit}/K",
        "width_unit": "K",
    }
