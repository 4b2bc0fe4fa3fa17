"""The magnetometer beside what the loop found of gyro and accelerometer."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pyimu.identification.magnetometer.examine import FOUND, UNCONFIRMED, UNEVEN, Examined
from pyimu.identification.magnetometer.words import remark
from pyimu.identification.result import Closed
from pyimu.identification.verdict.verdict import FAR, Verdict
from pyimu.model.kinds import MAGNETOMETER
from pyimu.recording.recording import Recording
from pyimu.report.numbers import number

BESIDE = "nothing is missing of the other sensors"


def of_magnetometer(seen: Examined | str, declared: bool) -> Verdict | None:
    """The verdict where gyro and accelerometer lack nothing; None where the magnetometer lacks
    nothing either.

    Of a part that nobody declared hard and soft iron are estimated like the gyro's scale factor,
    and are no finding.
    """
    if isinstance(seen, str):
        return Verdict("undecidable", f"{BESIDE}, and {seen}") if seen else None
    if seen.outcome == FOUND:
        return Verdict("named", "mag hard and soft iron") if declared else None
    if seen.outcome == UNCONFIRMED:
        reason = "hard and soft iron explain the magnetometer's fitted rows, and no others"
        return Verdict("not_confirmed", reason)
    if seen.outcome == UNEVEN:
        return Verdict("undecidable", f"{BESIDE}, and the field is too uneven for the magnetometer")
    if not seen.times_noise <= FAR:
        far = number(seen.times_noise, 2)
        return Verdict("unexplained", f"the magnetometer's residual is {far} times its noise")
    return None


def and_magnetometer(closed: Closed, seen: Examined | str, logs: Sequence[Recording]) -> Closed:
    """The result with what was found of the magnetometer.

    ``logs`` are those of its entries, in their order.
    """
    if isinstance(seen, str):
        if not seen:
            return closed
        reasons = closed.not_examined | {MAGNETOMETER: seen}
        return replace(closed, remarks=(*closed.remarks, seen), not_examined=reasons)
    entries = [
        replace(entry, errors=entry.errors | {MAGNETOMETER: seen.by_log[r.name]})
        if r.name in seen.by_log
        else entry
        for entry, r in zip(closed.recordings, logs, strict=True)
    ]
    return replace(
        closed,
        remarks=(*closed.remarks, remark(seen)),
        errors=closed.errors | {MAGNETOMETER: seen.errors},
        exhibits=closed.exhibits | {MAGNETOMETER: seen.exhibits},
        recordings=tuple(entries),
        magnetometer=seen,
    )
