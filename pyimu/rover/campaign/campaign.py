"""``run``: a campaign from its settings to its table."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

from pyimu.display.silent import silent
from pyimu.errors import UserError
from pyimu.rover.campaign.report.deliver import deliver
from pyimu.rover.campaign.report.words import lines
from pyimu.rover.campaign.settings import Settings
from pyimu.rover.campaign.summary import Summary
from pyimu.rover.campaign.table import Folder, batches
from pyimu.rover.campaign.workers import Batch, here, on_dask

Say = Callable[..., None]


@dataclass(frozen=True)
class Done:
    """A campaign's table: of ``count`` runs ``computed`` were made now, in ``seconds`` s."""

    folder: Folder
    count: int
    computed: int
    seconds: float
    summary: Summary

    def report(self) -> str:
        """What was done, and what it says, line by line."""
        speed = f", {self.computed / self.seconds:.1f} runs/s" if self.computed else ""
        made = f"{self.count} runs, {self.computed} of them now in {self.seconds:.0f} s{speed}"
        return "\n".join([made, *lines(self.summary)])

    @property
    def where(self) -> str:
        """Where table and report are."""
        return f"table: {self.folder.runs}, report: {self.folder.page}"

    @property
    def data(self) -> Path:
        """The file that has the report as JSON."""
        return self.folder.data


def run(
    settings: Settings,
    runs: int,
    out: Path | str,
    *,
    scheduler: str | None = None,
    workers: int | None = None,
    say: Say = silent,
) -> Done:
    """Compute the runs 0 to ``runs`` - 1 that the folder ``out`` does not have yet.

    They are computed by so many ``workers``, processes of this machine (None: as many as it has
    cores; 0: in this process, without Dask), or by those of the Dask ``scheduler`` at an address.
    The table ``runs.parquet`` is the same to the byte whatever computed it, and how often the work
    was broken off. A program that starts processes must do it under ``if __name__ == "__main__"``.

    Raises UserError for a folder that holds another campaign or cannot be written, where Dask is
    missing or the scheduler does not answer, and for settings that no run can be made of.
    """
    if isinstance(runs, bool) or not isinstance(runs, int) or runs < 1:
        raise UserError(f"runs {runs!r}: expected 1 or more")
    if workers is not None and workers < 0:
        raise UserError(f"workers {workers}: expected 1 or more, or 0 for this process alone")
    folder = Folder(Path(out), settings)
    folder.check()
    started, missing = time.monotonic(), folder.missing(runs)
    if missing:
        source = _source(settings, missing, scheduler, workers)
        with closing(source):
            for done, (batch, rows) in enumerate(source, 1):
                if done == 1:
                    folder.claim()
                folder.keep(batch, rows)
                say(*_progress(done, len(missing), started, runs))
    computed = sum(len(batch) for batch in missing)
    seconds = time.monotonic() - started
    folder.finish(runs)
    say("drawing the report")
    return Done(folder, runs, computed, seconds, deliver(folder))


def _source(
    settings: Settings, missing: list[range], scheduler: str | None, workers: int | None
) -> Iterator[Batch]:
    if workers == 0 and scheduler is None:
        return here(settings, missing)
    count = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return on_dask(settings, missing, scheduler, workers or count or 1)


def _progress(done: int, of: int, started: float, runs: int) -> tuple[str, float]:
    """What is said after a batch: how many runs are there, and the time left."""
    passed, total = time.monotonic() - started, len(batches(runs))
    there = round(runs * (total - of + done) / total)
    return f"{there} of {runs} runs, {duration(passed / done * (of - done))} left", done / of


def duration(seconds: float) -> str:
    """s as people say them."""
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"
