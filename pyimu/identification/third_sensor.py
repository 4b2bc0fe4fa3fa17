"""The magnetometer beside what the loop found of gyro and accelerometer."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pyimu.identification.magnetometer.examine import Examined
from pyimu.identification.magnetometer.words import remark
from pyimu.identification.result import Closed
from pyimu.model.kinds import MAGNETOMETER
from pyimu.recording.recording import Recording


def and_magnetometer(closed: Closed, seen: Examined | str, logs: Sequence[Recording]) -> Closed:
    """The result with what was found of the magnetometer, which has no part in the verdict.

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
