"""How often ``close`` blames a sensor for what something else did.

``python benchmarks/traps.py [TRAP ...] [--logs N] [--seed S] [--jobs J]`` closes the loop on logs
in which the sensor is blameless and the clocks, the reference, a thermometer or the samples are
not (see ``trap_logs``), each once as the log of a part that nobody declared and once with the
part's own figures declared. It prints for each trap how often the sensor was blamed, for what, the
verdicts, and how often the finding names the true cause. Each result is a line in a file; a run
that was stopped goes on where it was. One blame in a hundred is allowed.
"""

from __future__ import annotations

import argparse
import sys
import time
import zlib
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import generators
import numpy as np
import trap_logs
from runs.intervals import shown
from runs.pool import ROOT, add_options, digest, note, run_all
from runs.pool import name as text
from trap_logs.catalogue import TRAPS
from trap_logs.log import Log

import pyimu
from pyimu.identification.result import Closed
from pyimu.model.part_reader import parse_part

DELAYS = frozenset({"time_delay", "lag", "first_order_lag"})
"""What may be said of a sensor that is late by one time in all logs."""

FORMS = ("undeclared", "declared")

RESULTS = ROOT / "out" / "traps.jsonl"
CODE = (*(Path(m.__path__[0]) for m in (pyimu, trap_logs, generators)), Path(__file__))
"""What a result depends on."""


@dataclass
class Tally:
    """What became of the logs of one trap in one form."""

    logs: int = 0
    blamed: int = 0
    named: int = 0
    effects: Counter = field(default_factory=Counter)
    verdicts: Counter = field(default_factory=Counter)
    seconds: list[float] = field(default_factory=list)

    def row(self, name: str, form: str) -> str:
        counts = ", ".join(f"{k} {n}" for k, n in self.effects.most_common()) or "-"
        words = ", ".join(f"{k} {n}" for k, n in self.verdicts.most_common())
        return (
            f"{name:37} {form:10} {self.logs:4} {self.blamed:6} {self.named:5} "
            f"{np.median(self.seconds or [np.nan]):5.1f}  {words:40} {counts}"
        )


HEADER = (
    f"{'trap':37} {'form':10} {'logs':>4} {'blamed':>6} {'named':>5} {'s':>5}  "
    f"{'verdicts':40} blamed for"
)


# One case


def case(name: str, seed: int, number: int) -> Log:
    """The case of a trap: it depends on the trap's name, the seed and its number alone."""
    return TRAPS[name](np.random.default_rng([zlib.crc32(name.encode()), seed, number]))


def closed(log: Log, form: str) -> Closed:
    """The loop closed on a case; the part is its own where ``form`` is "declared"."""
    recordings = [
        pyimu.Recording.from_arrays(f"log{i}", **columns) for i, columns in enumerate(log.logs)
    ]
    references = [
        pyimu.Recording.from_arrays(f"reference{i}", **columns)
        for i, columns in enumerate(log.references)
    ]
    part = parse_part(log.part, "trap.toml") if form == "declared" else None
    return pyimu.close(recordings, part=part, reference=references or None)


def blamed(log: Log, form: str, found: Closed) -> list[str]:
    """The effects that a blameless sensor is said to have."""
    excused = log.own if form == "undeclared" else frozenset()
    excused |= DELAYS if log.late else frozenset()
    return [f"{a.sensor} {a.effect}" for a in found.added if a.effect not in excused]


# Whether the finding names the true cause


def _reference(found: Closed, name: str, number: int = 0) -> dict | None:
    """A figure of the reference of a log, as report.json has it."""
    return found.references[number].get(name) if number < len(found.references) else None


def _clock(found: Closed, number: int = 0) -> dict:
    state = found.recordings[number].log_state.get("gyro", {})
    return (state.get("reference") or {}).get("clock") or {}


def _near(value: float | None, truth: float, least: float, share: float = 0.1) -> bool:
    return value is not None and abs(value - truth) <= max(least, share * abs(truth))


def _finds(found: Closed, *kinds: str) -> bool:
    return any(f.kind in kinds for f in found.quality)


def names_clock(log: Log, found: Closed) -> bool:
    """The lag of each log's clock to a millisecond, or a tenth."""
    return all(
        _near(_clock(found, i).get("late"), late, 1e-3) for i, late in enumerate(_lates(log))
    )


def _lates(log: Log) -> list[float]:
    return list(log.figures.values())


def names_skew(log: Log, found: Closed) -> bool:
    """The skew to a tenth, or five of its standard errors."""
    skew = _reference(found, "clock_skew") or {"value": None, "std": 0.0}
    # A reference that is late by its skew makes the sensor early.
    return _near(skew["value"], -log.figures["skew"], 5 * skew["std"])


def names_slips(log: Log, found: Closed) -> bool:
    """A clock that slips by the reference's sample period, to a fifth."""
    sizes = [abs(s["size"]) for s in _reference(found, "slips") or ()]
    return bool(sizes) and _near(sizes[0], log.figures["span"], 0.0, 0.2)


def names_rate(log: Log, found: Closed) -> bool:
    return _near(_number(_reference(found, "sample_rate")), log.figures["rate"], 0.0, 0.05)


def names_noise(log: Log, found: Closed) -> bool:
    """The reference's noise to a third."""
    return _near(_number(_reference(found, "noise")), log.figures["noise"], 0.0, 0.33)


def _number(value) -> float | None:
    """The root mean square of a number, a list, or an entry with a value."""
    value = value.get("value") if isinstance(value, dict) else value
    return None if value is None else float(np.sqrt(np.mean(np.square(value))))


def names_mounting(log: Log, found: Closed) -> bool:
    """The mounting's angle to 0.5 deg, which a misalignment may share."""
    turn = np.array(found.recordings[0].log_state["gyro"]["rotation"])
    angle = np.arccos(np.clip((np.trace(turn) - 1) / 2, -1, 1))
    return _near(float(angle), log.figures["angle"], np.deg2rad(0.5))


def names_slipped_mount(log: Log, found: Closed) -> bool:
    """The angle by which the mount slipped, to a fifth."""
    angles = [f.detail["angle"] for f in found.quality if f.kind == "mount_slipped"]
    return bool(angles) and _near(angles[0], log.figures["angle"], 0.0, 0.2)


def names_lag(log: Log, found: Closed) -> bool:
    """The time constant of the reference's filter to a tenth."""
    lags = [f.detail["time_constant"] for f in found.quality if f.kind == "reference_lag"]
    return bool(lags) and _near(lags[0], log.figures["lag"], 0.0)


PLACES = "ref_east"
"""The column of findings that are about positions."""


def names_lag_of_places(log: Log, found: Closed) -> bool:
    """The time constant of the positions' filter, or by what they are late, to a millisecond or a
    tenth.
    """
    said = {"reference_lag": "time_constant", "positions_late": "late"}
    of_places = [f for f in found.quality if f.kind in said and f.column == PLACES]
    lags = [f.detail[said[f.kind]] for f in of_places]
    return bool(lags) and _near(lags[0], log.figures["lag"], 1e-3)


def names_smoothed_places(log: Log, found: Closed) -> bool:
    return any(f.kind == "reference_smoothed" and f.column == PLACES for f in found.quality)


def names_wandering(log: Log, found: Closed) -> bool:
    """By how much the clock's lag changes in all, to a quarter."""
    clock = _clock(found)
    changed = clock["most"] - clock["least"] if clock else None
    return _near(changed, log.figures["span"], 0.0, 0.25)


def names_misreading(log: Log, found: Closed) -> bool:
    """The log whose numbers mean something else than their names say, and that they do."""
    guilty = f"log{log.figures['log']:.0f}"
    said = [f for f in found.quality if f.kind in ("gyro_axes", "gyro_unit")]
    if any(f.detail.get("recording") == guilty for f in said):
        return True
    return found.verdict == "reference_unfit" and guilty in found.reason


def names_filter(log: Log, found: Closed) -> bool:
    return found.verdict == "reference_unfit" or _finds(found, "reference_drift")


def names_other_cause(log: Log, found: Closed) -> bool:
    """What looks like a lag of the sensor, and each that is named says so."""
    return all("filtered without delay" in a.note for a in found.added if a.effect in DELAYS)


def names_nothing_else(log: Log, found: Closed) -> bool:
    """What no figure of the result names; it is enough that the sensor is not blamed."""
    return True


def _by_finding(*kinds: str) -> Callable[[Log, Closed], bool]:
    return lambda log, found: _finds(found, *kinds)


def names_nothing(log: Log, found: Closed) -> bool:
    """Nothing to be named: the verdict says so, or names the sensor's own effects alone."""
    return found.verdict in ("clean", "named", "undecidable") and not found.refused


NAMED: dict[str, Callable[[Log, Closed], bool]] = {
    "nothing": names_nothing,
    "thermometer": names_nothing,
    "occlusions": names_nothing,
    "clock": names_clock,
    "lag": names_lag,
    "skew": names_skew,
    "slips": names_slips,
    "sample_rate": names_rate,
    "noise": names_noise,
    "mounting": names_mounting,
    "jumps": _by_finding("reference_spikes"),
    "reference_drift": _by_finding("reference_drift"),
    "smoothed": _by_finding("reference_smoothed"),
    "lag_of_places": names_lag_of_places,
    "smoothed_places": names_smoothed_places,
    "vibration": _by_finding("vibration"),
    "bursts": _by_finding("coarse_stamps", "jitter"),
    "wanders": names_wandering,
    "misread": names_misreading,
    "filter": names_filter,
    "adapts": _by_finding("reference_adapts", "reference_lag", "reference_smoothed"),
    "mounting_slips": names_slipped_mount,
    "unblamed": names_nothing_else,
    "no_delay": names_other_cause,
    "jitter": _by_finding("jitter"),
    "gaps": _by_finding("gaps"),
    "spikes": _by_finding("spikes"),
    "filled": _by_finding("filled_in"),
}
"""By cause: whether a result names it."""


# The table


def record(name: str, form: str, number: int, seed: int) -> dict[str, Any]:
    """One case of a trap in one form, through the loop: what is counted of it."""
    log = case(name, seed, number)
    began = time.perf_counter()
    try:
        found = closed(log, form)
    except pyimu.UserError as error:
        return {"wrong": [], "named": False, "verdict": "refused", "detail": f"refused: {error}"}
    seconds = time.perf_counter() - began
    wrong, named = blamed(log, form, found), NAMED[log.cause](log, found)
    detail = "; ".join(_detail(log, found, wrong, named))
    told = {"wrong": wrong, "named": bool(named), "verdict": found.verdict, "detail": detail}
    return told | {"seconds": round(seconds, 2)}


def tally(records: list[dict[str, Any]]) -> Tally:
    return Tally(
        len(records),
        sum(bool(r["wrong"]) for r in records),
        sum(r["named"] for r in records),
        Counter(effect for r in records for effect in r["wrong"]),
        Counter(r["verdict"] for r in records),
        [r["seconds"] for r in records if "seconds" in r],
    )


def _detail(log: Log, found: Closed, wrong, named) -> Iterator[str]:
    """One line on a case: its motion, its verdict, and what was added or refused, with gains."""
    yield f"({', '.join(log.motions)})"
    yield f"{'BLAMED ' if wrong else ''}{'' if named else 'not named '}{found.verdict}"
    yield found.reason
    for a in found.added:
        yield f"+{a.sensor} {a.effect} {a.gain:.0f} nat (gate {a.gate:.0f})"
    for kind, r in found.refused:
        yield f"-{kind} {r.effect} {r.gain:.0f} nat ({r.reason})"
    if found.errors.get("gyro"):
        e = found.errors["gyro"]
        degrees = np.degrees([e.before.total, e.after.total, e.noise])
        yield "gyro {:.4f} -> {:.4f}, floor {:.4f} deg/s".format(*degrees)
    clock = _clock(found)
    if clock:
        yield "late {} ms".format([_ms(clock[k]) for k in ("late", "least", "most")])


def _ms(value: float | None) -> float | None:
    return None if value is None else round(1e3 * value, 2)


def options() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("trap", nargs="*", help=f"of {', '.join(TRAPS)}; all without")
    parser.add_argument("--logs", type=int, default=50, help="cases a trap (50)")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--form", choices=FORMS, nargs="*", default=FORMS)
    add_options(parser, RESULTS)
    return parser


def main(arguments: list[str]) -> bool:
    parser = options()
    given = parser.parse_args(arguments)
    unknown = set(given.trap) - set(TRAPS)
    if unknown:
        parser.error(f"no such trap: {', '.join(sorted(unknown))}; there are {', '.join(TRAPS)}")

    def tell(key: str, result: dict[str, Any]) -> None:
        if given.details:
            note(f"  {key} {result['detail']}")

    pairs = [(name, form) for name in given.trap or TRAPS for form in given.form]
    keys = [(*pair, number, given.seed) for pair in pairs for number in range(given.logs)]
    found = run_all(record, keys, given.results, digest(*CODE), given.jobs, tell)
    print(HEADER)
    total, wrong = 0, 0
    for pair in pairs:
        counted = tally([found[text(key)] for key in keys if key[:2] == pair])
        print(counted.row(*pair), flush=True)
        total, wrong = total + counted.logs, wrong + counted.blamed
    print(f"blamed: {shown(wrong, total)}")
    return wrong <= 0.01 * total


if __name__ == "__main__":
    sys.exit(not main(sys.argv[1:]))
