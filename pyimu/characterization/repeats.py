"""Samples that a sensor did not make anew: left out of its noise.

Where the register that a logger reads was not refreshed, the sample before stands there once more.
Left in, each counts as a second sample of the same noise: of every tenth N is 10 % too large.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from pyimu.characterization.samples import PIECE, Samples
from pyimu.characterization.store import Store
from pyimu.errors import Finding
from pyimu.model.part import AXES
from pyimu.recording.quality.stuck import at_even_intervals, hung_runs

FEW = 1e-3
"""Share of repeats below which they do not matter: N grows by as much."""

MOST = 0.1
"""Share of repeats above which nothing is said of a sensor's noise. Whether they are samples that
were lost, or the sensor is slower than its log by their share, nobody knows: N differs by half of
it."""

BY_CHANCE = 0.3
"""Part of the repeats that chance may make, where samples are rounded, for them to be left out."""

HUNG_ALONE = 0.1
"""Share of a log for which an axis hung while the others did not, above which it is left out and
the others are not cut for it."""


def without_repeats(
    sensors: Mapping[str, Samples], findings: Iterable[Finding], store: Store
) -> tuple[dict[str, Samples], list[Finding]]:
    """The sensors without the samples that they repeat, and a finding ``repeated_samples`` of each
    whose three axes do so together; of one that repeats too many, its axes are ``absent``.

    Repeats at even intervals are left: they are of a sensor slower than its log (``held_samples``).
    ``findings`` are those of the log.
    """
    found = [(f.kind, f.column) for f in findings]
    kept, said = {}, []
    for kind, samples in sensors.items():
        # What firmware sets to zero is no repeat.
        zeroed = any(k == "zeroed" and column.startswith(kind) for k, column in found)
        stuck = {column for k, column in found if k == "stuck_samples"}
        hung, dead = _hung(samples, stuck, zeroed)
        repeats = _Repeats(replace(samples, absent={**samples.absent, **dead}))
        again, share = repeats.rows(hung) if not zeroed else (np.empty(0, int), 0.0)
        if len(again):
            detail = {"share": share, "first_row": samples.row(int(again[0]))}
            said.append(Finding("repeated_samples", kind, len(again), detail))
        lost = np.union1d(again, hung)
        if share > MOST:
            dead, lost = _too_many(share), lost[:0]
        kept[kind] = _without(samples, lost, store) if len(lost) else samples
        if dead:
            kept[kind] = replace(kept[kind], absent={**dead, **samples.absent})
    return kept, said


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


@dataclass(frozen=True)
class _Repeats:
    """The samples of a sensor all of whose axes show the value of the sample before."""

    samples: Samples

    def rows(self, hung: np.ndarray) -> tuple[np.ndarray, float]:
        """Their numbers (k,) without ``hung``, where there are more than matters or chance makes,
        and not at even intervals; and the share of the samples that chance does not make of them.
        """
        none, n = (np.empty(0, int), 0.0), len(self.samples)
        live = [i for i in range(len(AXES)) if i not in self.samples.absent]
        live = [i for i in live if np.ptp(self.samples.columns[i]) > 0]
        if len(live) < 2:
            return none
        found, chance = self._together(live)
        found = np.setdiff1d(found, hung, assume_unique=True)
        few = len(found) < FEW * n or BY_CHANCE * len(found) < chance * n
        if few or at_even_intervals(np.diff(found)):
            return none
        fresh = np.diff(np.setdiff1d(np.arange(n), found, assume_unique=True))
        return none if at_even_intervals(fresh) else (found, len(found) / n - chance)

    def _together(self, live: list[int]) -> tuple[np.ndarray, float]:
        """The repeats (k,), and how probable one is by chance.

        Axes repeat independently where rounding makes them. How often one does is told where
        another does not.
        """
        found, each, others = [np.empty(0, int)], np.zeros(len(live)), np.zeros(len(live))
        rows = 0
        for first, same in self._same(live):
            all_of_them = same.all(axis=0)
            found.append(first + np.flatnonzero(all_of_them))
            rows += same.shape[1]
            each += np.sum(same & ~all_of_them, axis=1)
            for k in range(len(live)):
                others[k] += np.sum(np.delete(same, k, axis=0).all(axis=0))
        return np.concatenate(found), float(np.prod(each / np.maximum(rows - others, 1)))

    def _same(self, live: list[int]) -> Iterator[tuple[int, np.ndarray]]:
        """By piece the number of its first sample, and whether axes repeat (len(live), k)."""
        for start, stop in self.samples.segments:
            for a in range(start + 1, stop, PIECE):
                b = min(a + PIECE, stop)
                columns = (np.array(self.samples.columns[i][a - 1 : b]) for i in live)
                yield a, np.array([c[1:] == c[:-1] for c in columns])


def _without(samples: Samples, rows: np.ndarray, store: Store) -> Samples:
    """The samples without some of them (k,), where gaps are then."""
    for a in range(0, len(samples), PIECE):
        b = min(a + PIECE, len(samples))
        kept = np.ones(b - a, bool)
        kept[rows[(rows >= a) & (rows < b)] - a] = False
        store.append(f"{samples.kind}_fresh_time", samples.time[a:b][kept])
        for axis, column in zip(AXES, samples.columns, strict=True):
            store.append(f"{samples.kind}_fresh_{axis}", column[a:b][kept])
    edges = np.unique(np.concatenate((np.ravel(samples.segments), rows, rows + 1)))
    edges = np.unique(edges - np.searchsorted(rows, edges)).astype(int).tolist()
    return replace(
        samples,
        time=store.column(f"{samples.kind}_fresh_time"),
        columns=[store.column(f"{samples.kind}_fresh_{axis}") for axis in AXES],
        segments=list(zip(edges[:-1], edges[1:], strict=True)),
        missing=np.union1d(samples.missing, samples.rows(rows)),
        most_lost=MOST,
    )
