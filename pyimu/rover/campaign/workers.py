"""The batches of a campaign on Dask: processes of this machine, or a cluster by its address."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import CancelledError
from contextlib import contextmanager, suppress
from queue import Empty, SimpleQueue
from typing import Any

from pyimu.errors import UserError
from pyimu.rover.campaign.made_by import made_by
from pyimu.rover.campaign.score import Row, row_of
from pyimu.rover.campaign.settings import Settings

ANSWER = 10.0
"""s in which a scheduler has to answer."""

ARRIVAL = 30.0
"""s in which a scheduler must have a worker."""

AHEAD = 3
"""Batches that are given out for each thread of the workers: none then waits for the next, and few
are lost when all ends."""

LOOK, AWAY = 5.0, 20.0
"""s between two looks at whether the scheduler is still there, and s that it may be away."""

ATTEMPTS = 10
"""Workers that may die with one batch before the campaign gives up: it may be the batch's fault."""

Batch = tuple[range, list[Row]]


def here(settings: Settings, batches: Iterable[range]) -> Iterator[Batch]:
    """The rows of each batch, computed in this process."""
    for batch in batches:
        yield batch, rows_of(settings, batch)


def rows_of(settings: Settings, batch: range) -> list[Row]:
    """The rows of a batch."""
    return [row_of(settings, number) for number in batch]


def on_dask(
    settings: Settings, batches: list[range], scheduler: str | None, workers: int
) -> Iterator[Batch]:
    """The rows of each batch, in the order in which they are done.

    A batch whose worker has died is given to another one. Raises UserError where dask is not
    installed, the scheduler does not answer or has no worker, or the workers have other code of the
    package.
    """
    with _client(scheduler, workers) as client:
        if scheduler is not None:
            _check_workers(client, scheduler)
        try:
            yield from _computed(client, settings, batches)
        except (ConnectionError, CancelledError) as error:
            raise UserError(
                f"--scheduler {scheduler}: lost ({error}); what it has computed is kept, and the "
                "same command goes on from there"
            ) from None
        except _failures() as error:
            raise UserError(
                f"a batch of runs was lost with its worker {ATTEMPTS} times ({error}): give fewer "
                "--workers if the memory is too small"
            ) from None


def _computed(client: Any, settings: Settings, batches: list[range]) -> Iterator[Batch]:
    [given] = client.scatter([settings], broadcast=True)
    waiting, runs, done = iter(batches), {}, SimpleQueue()

    def submit() -> None:
        batch = next(waiting, None)
        if batch is not None:
            future = client.submit(rows_of, given, batch, pure=False)
            runs[future.key] = batch, future
            future.add_done_callback(done.put)

    for _ in range(AHEAD * max(1, sum(client.nthreads().values()))):
        submit()
    while runs:
        future = _answer(client, done.get)
        batch, _ = runs.pop(future.key)
        yield batch, _answer(client, future.result)
        submit()


def _answer(client: Any, ask: Callable[..., Any]) -> Any:
    """What ``ask(timeout=...)`` gives: the next future that is done, or a future's result.

    Raises ConnectionError where the scheduler has been away for ``AWAY`` s: a client waits for it
    forever, for a result too that lies on a worker.
    """
    away = 0.0
    while True:
        with suppress(Empty, TimeoutError):
            return ask(timeout=LOOK)
        away = 0.0 if client.status == "running" else away + LOOK
        if away >= AWAY:
            raise ConnectionError("the scheduler does not answer any more")


@contextmanager
def _client(scheduler: str | None, workers: int) -> Iterator[Any]:
    """A client of the scheduler at that address, or of processes of its own."""
    dask, distributed = _dask()
    with dask.config.set({"distributed.scheduler.allowed-failures": ATTEMPTS}):
        if scheduler is None:
            cluster = distributed.LocalCluster(
                n_workers=workers,
                threads_per_worker=1,
                # Any free port of this machine: None takes 8787, which another campaign may have.
                dashboard_address="127.0.0.1:0",
                silence_logs=logging.CRITICAL,
            )
            with cluster, distributed.Client(cluster) as client:
                yield client
        else:
            with _client_of(distributed, scheduler) as client:
                yield client


def _client_of(distributed: Any, scheduler: str) -> Any:
    try:
        return distributed.Client(scheduler, timeout=ANSWER)
    except (OSError, TimeoutError, ValueError) as error:
        raise UserError(
            f"--scheduler {scheduler}: no Dask scheduler answers there within {ANSWER:g} s "
            f"({str(error)[:80] or type(error).__name__}); `dask scheduler` starts one and prints "
            "its address, as tcp://host:8786"
        ) from None


def _check_workers(client: Any, scheduler: str) -> None:
    """Raise UserError where there is no worker, or one of other code."""
    try:
        client.wait_for_workers(1, timeout=ARRIVAL)
    except TimeoutError:
        raise UserError(
            f"--scheduler {scheduler}: no worker has come within {ARRIVAL:g} s; `dask worker "
            f"{scheduler}` starts one"
        ) from None
    mine = made_by()
    try:
        theirs = client.run(made_by)
    except Exception as error:
        raise UserError(
            f"--scheduler {scheduler}: its workers cannot load pyimu {mine} ({str(error)[:80]}); "
            "install it there"
        ) from None
    for worker, found in theirs.items():
        if found != mine:
            raise UserError(
                f"--scheduler {scheduler}: worker {worker} has pyimu {found}, not {mine}: runs "
                "would not be the same; install the same there"
            )


def _dask() -> tuple[Any, Any]:
    try:
        import dask
        import distributed
    except ImportError as error:
        raise UserError(
            f"a campaign needs Dask, and {error.name} is not installed: pip install "
            "'pyimu[campaign]', or --workers 0 for this process alone"
        ) from None
    return dask, distributed


def _failures() -> tuple[type[BaseException], ...]:
    return (_dask()[1].scheduler.KilledWorker,)
