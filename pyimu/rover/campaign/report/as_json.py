"""The summary of a campaign as data, the contents of report.json."""

from __future__ import annotations

from typing import Any

from pyimu.files import plain
from pyimu.rover.campaign.report.words import lines
from pyimu.rover.campaign.score import ANGLES, FREEDOM
from pyimu.rover.campaign.sensitivity import LEVEL
from pyimu.rover.campaign.settings import Settings
from pyimu.rover.campaign.summary import CLAIM, TARGETS, Share, Summary, explained


def contents(settings: Settings, s: Summary) -> dict[str, Any]:
    """The contents of report.json, in SI.

    ``campaign``: the settings; ``runs``, ``level`` of all intervals; ``summary``, in lines;
    ``errors`` by angle: {``max``, ``rms``, ``end``: [{``p``, ``value``, ``low``, ``high``}]} in
    rad, of the runs without fault; ``claim``: {``within`` [rad], ``end``, ``always``: {``count``,
    ``runs``, ``share``, ``low``, ``high``}}; ``nees`` by error: {``freedom``, ``mean``, ``bounds``,
    ``inside``, ``over_time``}; ``sensitivity``: {``estimator``, ``chance``, ``targets``: by error
    {``explained``, ``factors``: [{``factor``, ``S1``, ``low``, ``high``}]}}; ``faults``:
    [{``fault``, ``runs``, ``errors``, ``status``: by flag a share}].
    """
    sound = bool(s.sound.any())
    return plain(
        {
            "campaign": settings.contents(),
            "runs": s.runs,
            "level": LEVEL,
            "summary": lines(s),
            "errors": _errors(s, "none") if sound else None,
            "claim": _claim(s) if sound else None,
            "nees": {name: _honesty(s, name) for name in FREEDOM} if sound else None,
            "sensitivity": _sensitivity(s) if sound else None,
            "faults": [
                {
                    "fault": name,
                    "runs": len(s.of_fault(name, "run")),
                    "errors": _errors(s, name),
                    "status": {words: share_of(f) for words, f in s.flags(name).items()},
                }
                for name in s.fault_names
            ],
        }
    )


def _errors(s: Summary, fault: str) -> dict[str, Any]:
    return {
        name: {
            kind: [vars(q) for q in s.quantiles(f"{name}_error_{kind} [rad]", fault)]
            for kind in ("max", "rms", "end")
        }
        for name in reversed(ANGLES)
    }


def _claim(s: Summary) -> dict[str, Any]:
    return {"within": CLAIM, "end": share_of(s.within("end")), "always": share_of(s.within("max"))}


def share_of(f: Share) -> dict[str, Any]:
    """A share as plain types: count, runs, share and its interval."""
    low, high = f.interval
    return {"count": f.count, "runs": f.runs, "share": f.value, "low": low, "high": high}


def _honesty(s: Summary, name: str) -> dict[str, Any]:
    h = s.honesty(name)
    return {
        "freedom": h.freedom,
        "mean": h.mean,
        "bounds": h.bounds,
        "inside": share_of(h.inside),
        "over_time": h.over_time,
    }


def _sensitivity(s: Summary) -> dict[str, Any]:
    return {
        "estimator": "first-order index, RBD-FAST on the runs as drawn (SALib)",
        "chance": s.chance,
        "targets": {
            target: {
                "explained": explained(s.causes[target]),
                "factors": [
                    {"factor": i.factor, "S1": i.value, "low": i.low, "high": i.high}
                    for i in s.causes[target]
                ],
            }
            for target in TARGETS
        },
    }
