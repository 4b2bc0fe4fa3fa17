"""What the fuzzers share: mutated files in child processes of bounded time and memory.

A fuzzer is a module with ``seeds(folder)``, which writes valid files and gives their names, and
``try_one(path)``, which may raise nothing: it says what became of the file. ``python fuzz/NAME.py
--seconds 60`` runs it; what breaks it is kept in ``--keep`` and named, and the exit status is 1.
"""

from __future__ import annotations

import argparse
import importlib
import os
import random
import resource
import shutil
import signal
import sys
import tempfile
import time
import traceback
from collections import Counter
from pathlib import Path

sys.path.append(str(Path(__file__).parent.parent / "tests/support"))  # writers of valid files

BATCH = 200
"""Files that a child process tries, at most: a new one has no memory of the old."""

LONGEST = 20
"""s of processor for one file."""

PATIENCE = 10 * LONGEST
"""s by the clock: something that waits uses no processor, and a busy machine gives little of it."""

MEMORY = 2 << 30
"""Bytes that a child process may have beside what it begins with."""

INTERESTING = [0, 1, 4, 7, 8, 127, 128, 255, 256, 2**15, 2**16 - 1, 2**31 - 1, 2**32 - 1]


def mutated(data: bytes, rng: random.Random) -> bytes:
    """``data`` with one to eight faults: bits, bytes, numbers, pieces lost, doubled and moved."""
    out = bytearray(data)
    for _ in range(rng.choice((1, 1, 1, 2, 4, 8))):
        if not out:
            break
        at, kind = rng.randrange(len(out)), rng.randrange(7)
        end = min(len(out), at + rng.choice((1, 4, 16, 100)))
        if kind == 0:
            out[at] ^= 1 << rng.randrange(8)
        elif kind == 1:
            out[at] = rng.randrange(256)
        elif kind == 2:
            size = rng.choice((1, 2, 4, 8))
            number = rng.choice(INTERESTING) % 2 ** (8 * size)
            out[at : at + size] = number.to_bytes(size, rng.choice(("little", "big")))
        elif kind == 3:
            del out[at:end]
        elif kind == 4:
            out[at:at] = out[at:end] * rng.choice((1, 1, 3, 50))
        elif kind == 5:
            where = rng.randrange(len(out))
            out[where:where] = out[at:end]
        else:
            del out[rng.randrange(len(out)) :]
    return bytes(out)


def mutated_text(text: str, rng: random.Random, words: list[str]) -> str:
    """``text`` with one to six faults: cells, lines and words changed, lost and put in."""
    lines = text.split("\n")
    for _ in range(rng.choice((1, 1, 2, 3, 6))):
        at = rng.randrange(len(lines))
        line, kind = lines[at], rng.randrange(7)
        where = rng.randrange(len(line) + 1)
        if kind == 0:
            lines[at] = line[:where] + rng.choice(words) + line[where:]
        elif kind == 1:
            lines[at] = line[:where] + line[where + rng.randrange(1, 8) :]
        elif kind == 2:
            lines.insert(rng.randrange(len(lines) + 1), line)
        elif kind == 3 and len(lines) > 1:
            del lines[at]
        elif kind == 4:
            cut = rng.randrange(len(line) + 1)
            lines[at] = line[:cut] + rng.choice(words) + line[min(cut + 5, len(line)) :]
        elif kind == 5:
            lines[at] = rng.choice(words)
        else:
            lines[at] = line * rng.choice((2, 30))
    return "\n".join(lines)


class Child:
    """A child process that tries mutated files, with how many it did and what they came to."""

    def __init__(self, fuzzer, names: list[Path], folder: Path, seed: int, until: float) -> None:
        self.fuzzer, self.names, self.folder = fuzzer, names, folder
        self.seed, self.until = seed, until

    def run(self) -> tuple[Counter, str]:
        """Counts of what became of the files, and what is wrong, "" where nothing is."""
        read, write = os.pipe()
        pid = os.fork()
        if pid == 0:
            os.close(read)
            self._work(write)
        os.close(write)
        with os.fdopen(read, "r", errors="replace") as stream:
            lines = stream.read().splitlines()
        _, status = os.waitpid(pid, 0)
        counts = Counter(line for line in lines if not line.startswith("!"))
        wrong = "\n".join(line[1:] for line in lines if line.startswith("!"))
        if os.WIFSIGNALED(status):
            name = signal.Signals(os.WTERMSIG(status)).name
            wrong = f"ended by {name}" + (" (too slow)" if name in ("SIGPROF", "SIGALRM") else "")
        elif status and not wrong:  # as a library that calls exit() ends it
            wrong = f"ended with exit status {os.WEXITSTATUS(status)} and no word"
        return counts, wrong

    def _work(self, write: int) -> None:
        _bound_memory()
        rng = random.Random(self.seed)
        quiet = os.open(os.devnull, os.O_WRONLY)
        os.dup2(quiet, 1)
        os.dup2(quiet, 2)
        with os.fdopen(write, "w") as stream:
            for count in range(BATCH):
                if count and time.monotonic() > self.until:
                    break
                path = self.fuzzer.mutate(rng.choice(self.names), self.folder, rng)
                signal.setitimer(signal.ITIMER_PROF, LONGEST)
                signal.alarm(PATIENCE)
                try:
                    said = self.fuzzer.try_one(path)
                except BaseException:  # noqa: BLE001
                    text = traceback.format_exc()
                    stream.write("".join(f"!{line}\n" for line in text.splitlines()[-14:]))
                    stream.flush()
                    os._exit(1)
                signal.setitimer(signal.ITIMER_PROF, 0)
                signal.alarm(0)
                stream.write(f"{said}\n")
        os._exit(0)


def _bound_memory() -> None:
    """Give this process ``MEMORY`` beside what it has, on systems that say how much that is."""
    said = Path("/proc/self/statm")
    if said.exists():  # macOS has none, and keeps to no such limit either
        own = int(said.read_text().split()[0]) * os.sysconf("SC_PAGE_SIZE")
        resource.setrlimit(resource.RLIMIT_AS, (own + MEMORY, own + MEMORY))


def run(fuzzer, seconds: float, seed: int, keep: Path) -> int:
    """Fuzz for ``seconds``; gives how many files broke something."""
    counts: Counter = Counter()
    broken: list[str] = []
    with tempfile.TemporaryDirectory(prefix="pyimu-fuzz-") as name:
        folder, seeds = Path(name, "tried"), Path(name, "seeds")
        folder.mkdir()
        seeds.mkdir()
        if (pid := os.fork()) == 0:  # its libraries start threads, which no fork survives
            fuzzer.seeds(seeds)
            os._exit(0)
        if os.waitpid(pid, 0)[1]:
            raise SystemExit(f"{fuzzer.NAME}: its valid files could not be written")
        names = sorted(seeds.iterdir())
        for module in fuzzer.LOADED:  # once, not in every child
            importlib.import_module(module)
        until = time.monotonic() + seconds  # loading takes longer than a short run
        while time.monotonic() < until:
            for old in folder.iterdir():
                shutil.rmtree(old) if old.is_dir() else old.unlink()
            found, wrong = Child(fuzzer, names, folder, seed, until).run()
            counts += found
            if wrong:
                broken.append(wrong)
                keep.mkdir(parents=True, exist_ok=True)
                last = max(folder.iterdir(), key=lambda path: path.stat().st_mtime_ns)
                last.rename(keep / f"{fuzzer.NAME}-{seed}-{last.name}")
                print(f"{fuzzer.NAME}, seed {seed}: {wrong}\nkept in {keep}", flush=True)
            seed += 1
    total = sum(counts.values()) + len(broken)
    came = ", ".join(f"{number:,} {said}" for said, number in counts.most_common())
    print(f"{fuzzer.NAME}: {total:,} tried: {came}; {len(broken)} broke something", flush=True)
    return len(broken)


def main(fuzzer) -> None:
    parser = argparse.ArgumentParser(description=fuzzer.__doc__)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=Path, default=Path("out/fuzz"))
    given = parser.parse_args()
    sys.exit(1 if run(fuzzer, given.seconds, given.seed, given.keep) else 0)
