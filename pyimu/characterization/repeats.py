"""Samples that a sensor did not make anew: left out of its noise.

Where the register that a logger reads was not refreshed, the sample before stands there once more.
Left in, each counts as a second sample of the same noise: of every tenth N is 10 % too large.
Where they stand at even intervals the sensor is slower than its log: the samples that are left are
at its own rate then. Left in, N is 2 % too large where a logger reads 1.06 times as often as there
are samples, and 6 % where it does so 1.5 times.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np

from pyimu.characterization.samples import PIECE, Samples
from pyimu.characterization.store import Store
from pyimu.errors import Finding
from pyimu.model.part import AXES
from pyimu.recording.quality.repeats import Repeats, repeats
from pyimu.recording.quality.stuck import hung_runs

MOST = 0.1
"""Share of repeats above which nothing is said of a sensor's noise. Whether they are samples that
were lost, or the sensor is slower than its log by their share, nobody knows: N differs by half of
it."""

HUNG_ALONE = 0.1
"""Share of a log for which an axis hung while the others did not, above which it is left out and
the others are not cut for it."""


def without_repeats(
    sensors: Mapping[str, Samples], findings: Iterable[Finding], store: Store
) -> tuple[dict[str, Samples], list[Finding]]:
    """The sensors without the samples that they repeat, and ``findings``, those of the log, with
    what is so found of each whose three axes do so together: ``held_samples`` where it is slower
    than its log, and was brought to its own rate, else ``repeated_samples``; of one that repeats
    too many, its axes are ``absent``.
    """
    known = [f for f in findings if f.kind != "repeated_samples"]
    kept = {}
    for kind, samples in sensors.items():
        # What firmware sets to zero is no repeat.
        zeroed = any(f.kind == "zeroed" and f.column.startswith(kind) for f in known)
        stuck = {f.column for f in known if f.kind == "stuck_samples"}
        hung, dead = _hung(samples, stuck, zeroed)
        found = (
            None if zeroed else _repeats(replace(samples, absent={**samples.absent, **dead}), hung)
        )
        lost, own_rate = hung, False
        if found is not None:
            own_rate = found.every is not None
            known = [f for f in known if not (own_rate and _is_held(f, kind))]
            known.append(_of_log(found.finding(kind, len(samples)), samples, found.share))
            lost = np.union1d(found.rows, hung)
            if found.share > MOST and not own_rate:
                dead, lost = _too_many(found.share), lost[:0]
        if found is not None and own_rate:
            slower = replace(samples, h=samples.h * found.every)
            kept[kind] = _without(slower, lost, hung, store)
        else:
            kept[kind] = _without(samples, lost, lost, store) if len(lost) else samples
        if dead:
            kept[kind] = replace(kept[kind], absent={**dead, **samples.absent})
    return kept, known


def _repeats(samples: Samples, hung: np.ndarray) -> Repeats | None:
    live = [c for i, c in enumerate(samples.columns) if i not in samples.absent]
    return repeats(live, samples.segments, hung)


def _is_held(f: Finding, kind: str) -> bool:
    return f.kind == "held_samples" and f.column.startswith(kind)


def _of_log(f: Finding, samples: Samples, share: float) -> Finding:
    """The same, with the row of the log for that of the samples."""
    if "first_row" not in f.detail:
        return f
    return replace(f, detail={"share": share, "first_row": samples.row(f.detail["first_row"])})


def _too_many(share: float) -> dict[int, str]:
    reason = (
        f"{100 * share:.2g} % of the samples repeat the one before, so that neither the sensor's "
        "rate nor its noise is known; log each new sample once, as by the sensor's data-ready"
    )
    return dict.fromkeys(range(len(AXES)), reason)


def _hung(samples: Samples, stuck: set[str], zeroed: bool) -> tuple[np.ndarray, dict[int, str]]:
    """Samples (k,) that follow the first one of a run in which an axis of ``stuck`` hung, and the
    axes that hung alone for so long that they are left out, with the reason.
    """
    rows = {
        i: _hung_rows(samples.columns[i], zeroed)
        for i, axis in enumerate(AXES)
        if f"{samples.kind}_{axis}" in stuck
    }
    dead = {}
    for i, own in rows.items():
        others = [rows.get(j, own[:0]) for j in range(len(AXES)) if j not in (i, *samples.absent)]
        alone = np.setdiff1d(own, np.concatenate(others)) if others else own[:0]
        if len(alone) > HUNG_ALONE * len(samples):
            share = 100 * len(own) / len(samples)
            dead[i] = (
                f"it hung at one value for {share:.2g} % of the log, give the part without that"
            )
    kept = [own for i, own in rows.items() if i not in dead]
    return np.unique(np.concatenate([np.empty(0, int), *kept])), dead


def _hung_rows(column: np.ndarray, zeroed: bool) -> np.ndarray:
    """Samples (k,) of a column (n,) that follow the first one of a run that hung."""
    rows = [np.empty(0, int)]
    for a in range(0, len(column), PIECE):
        runs = hung_runs(np.array(column[a : a + PIECE]), zeroed)
        rows += [np.arange(a + first + 1, a + stop) for first, stop in runs]
    return np.concatenate(rows)


def _without(samples: Samples, rows: np.ndarray, gaps: np.ndarray, store: Store) -> Samples:
    """The samples without some of them (k,); where ``gaps`` (m,) of these were, gaps are then."""
    for a in range(0, len(samples), PIECE):
        b = min(a + PIECE, len(samples))
        kept = np.ones(b - a, bool)
        kept[rows[(rows >= a) & (rows < b)] - a] = False
        store.append(f"{samples.kind}_fresh_time", samples.time[a:b][kept])
        for axis, column in zip(AXES, samples.columns, strict=True):
            store.append(f"{samples.kind}_fresh_{axis}", column[a:b][kept])
    edges = np.unique(np.concatenate((np.ravel(samples.segments), gaps, gaps + 1)))
    edges = np.unique(edges - np.searchsorted(rows, edges)).astype(int).tolist()
    return replace(
        samples,
        time=store.column(f"{samples.kind}_fresh_time"),
        columns=[store.column(f"{samples.kind}_fresh_{axis}") for axis in AXES],
        segments=list(zip(edges[:-1], edges[1:], strict=True)),
        missing=np.union1d(samples.missing, samples.rows(rows)),
        most_lost=MOST,
    )
