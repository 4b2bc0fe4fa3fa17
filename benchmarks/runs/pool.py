"""Cases in parallel processes, each result a line of JSON in a file, so that a run can go on where
it was stopped.

A line holds the case's key, a digest of the code that made it, and its result. Lines of other code
are left in the file and not used, so that a figure never mixes two versions.
"""

from __future__ import annotations

import argparse
import fcntl
import hashlib
import json
import multiprocessing
import os
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TextIO

ROOT = Path(__file__).resolve().parents[2]
Result = dict[str, Any]
Tell = Callable[[str, Result], None]


def digest(*sources: Path) -> str:
    """Of files, and of the Python and TOML below folders."""
    found = hashlib.sha256()
    for source in sources:
        below = sorted(p for p in source.rglob("*") if p.suffix in (".py", ".toml"))
        for path in [source] if source.is_file() else below:
            found.update(str(path.relative_to(source)).encode() + path.read_bytes())
    return found.hexdigest()[:12]


def finished(path: Path, code: str | None = None) -> dict[str, Result]:
    """The results in a file by key, those of ``code`` alone; without it those of the last line's.

    A line that is not whole, because its run was killed, is left out.
    """
    if not path.is_file():
        return {}
    lines = list(_lines(path))
    if code is None and lines:
        code = lines[-1]["code"]
    return {line["key"]: line["result"] for line in lines if line["code"] == code}


def _lines(path: Path) -> Iterator[dict[str, Any]]:
    with path.open(encoding="utf-8", errors="replace") as file:
        for text in file:
            try:
                line = json.loads(text)
            except ValueError:
                continue
            if isinstance(line, dict) and {"key", "code", "result"} <= set(line):
                yield line


def run_all(
    work: Callable[..., Result],
    keys: Sequence[tuple],
    results: Path,
    code: str,
    jobs: int = 2,
    tell: Tell = lambda key, result: None,
) -> dict[str, Result]:
    """``work(*key)`` of each key that the file does not hold yet; gives the results of all keys.

    ``work`` must be a function that processes can import. Raises RuntimeError where another run
    writes to the same file.
    """
    results.parent.mkdir(parents=True, exist_ok=True)
    wanted = {name(key): key for key in keys}
    with _locked(results) as file:
        there = finished(results, code)
        missing = [key for text, key in wanted.items() if text not in there]
        for key, result in _computed(work, missing, jobs):
            line = json.dumps({"key": name(key), "code": code, "result": result})
            file.write(line + "\n")
            file.flush()
            os.fsync(file.fileno())
            there[name(key)] = json.loads(line)["result"]
            tell(name(key), there[name(key)])
    return {text: there[text] for text in wanted}


def name(key: tuple) -> str:
    return " ".join(map(str, key))


@contextmanager
def _locked(path: Path) -> Iterator[TextIO]:
    """The file open to be written at its end, on a line of its own, by this run alone."""
    with path.open("a+", encoding="utf-8") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            raise RuntimeError(f"{path}: another run writes to it") from None
        if path.stat().st_size and not path.read_bytes().endswith(b"\n"):
            file.write("\n")
        yield file


def _computed(work, keys: Iterable[tuple], jobs: int) -> Iterator[tuple[tuple, Result]]:
    """Keys and results as they come; a few cases wait for a process, not all of them."""
    for variable in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ[variable] = "1"
    context = multiprocessing.get_context("spawn")
    rest, running = iter(keys), dict[Future, tuple]()
    first = next(rest, None)
    if first is None:
        return
    with ProcessPoolExecutor(jobs, mp_context=context) as pool:
        try:
            running[pool.submit(work, *first)] = first
            while True:
                while len(running) < 2 * jobs and (key := next(rest, None)) is not None:
                    running[pool.submit(work, *key)] = key
                if not running:
                    break
                done, _ = wait(running, return_when=FIRST_COMPLETED)
                for future in done:
                    yield running.pop(future), future.result()
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise


def add_options(parser: argparse.ArgumentParser, results: Path) -> None:
    """The options of a run: how many processes, where its results are, and what it tells."""
    parser.add_argument("--jobs", type=int, default=2, help="processes (2)")
    parser.add_argument("--results", type=Path, default=results)
    parser.add_argument("--details", action="store_true", help="one line a case, on stderr")


def note(text: str) -> None:
    print(text, file=sys.stderr, flush=True)
