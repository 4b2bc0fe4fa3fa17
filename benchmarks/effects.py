"""How often ``close`` names what a part lacks, and what it says instead.

``python benchmarks/effects.py [ROW ...] [--first F] [--logs N] [--jobs J]`` closes the loop on
simulated logs (see ``effect_logs``): with nothing missing, with one effect of the whole catalogue
at 8, 12 and 30 sigmas over the fitted rows or at a consumer part's size, with two effects, with a
rover's and a table's log together, and with errors that no effect describes. Each result is a line
in a file; a run that was stopped goes on where it was. It prints the rates with their 95 %
intervals (Wilson) beside what is wanted, the coverage of the intervals, what was named for what,
and how the failures failed. ``docs/build/loop_rates_page.py`` makes a page of the file.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path

import effect_logs
import generators
from effect_logs.cases import MINUTES, ROWS, names
from effect_results import record as kept
from effect_results.confounds import CONFOUNDS, FINDINGS
from effect_results.judge import Record, named, outcome, why
from effect_results.table import confusion_text, failures_text, table_text
from runs.pool import ROOT, add_options, digest, note, run_all

import pyimu

RESULTS = ROOT / "out" / "effects.jsonl"
CODE = (*(Path(m.__path__[0]) for m in (pyimu, effect_logs, generators)), Path(kept.__file__))
"""What a result depends on; how it is judged may change, and the results be judged again."""


def keys(rows, only: str, first: int, logs: int, clean: int, minutes) -> Iterator[tuple]:
    """One case of each name after another, so that a run that is stopped has seen them all; their
    numbers begin with ``first``.
    """
    chosen = [(row, n) for row in rows for n in names(row) if only in n]
    for number in range(max(logs, clean)):
        for row, name in chosen:
            if number < (clean if row == "clean" else logs):
                yield name, first + number, *minutes


def tell(key: str, result: Record) -> None:
    size = ", ".join(f"{t['size']:.1f}" for t in result["truths"])
    found = ", ".join(f"{s} {e}" for s, e in named(result)) or "-"
    word = outcome(result)
    reason = "" if word == "right" else f"; {why(result)}"
    at = f"{key} ({'+'.join(result['motions'])}, {result['form']}, {size or 'clean'})"
    note(f"{at}: {word}; {found}{reason}; {result['seconds']:.0f} s")


def options() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("row", nargs="*", help=f"of {', '.join(ROWS)}; all without")
    parser.add_argument("--first", type=int, default=0, help="number of the first case (0)")
    parser.add_argument("--logs", type=int, default=2, help="cases a name (2)")
    parser.add_argument("--clean", type=int, default=20, help="clean cases a motion (20)")
    parser.add_argument("--only", default="", help="names that hold this text")
    parser.add_argument("--minutes", type=float, nargs=2, default=MINUTES, metavar=("LOW", "HIGH"))
    add_options(parser, RESULTS)
    return parser


def main(arguments: list[str]) -> int:
    parser = options()
    given = parser.parse_args(arguments)
    unknown = set(given.row) - set(ROWS)
    if unknown:
        parser.error(f"no such row: {', '.join(sorted(unknown))}; there are {', '.join(ROWS)}")
    which = given.only, given.first, given.logs, given.clean, given.minutes
    wanted = list(keys(given.row or ROWS, *which))
    if not wanted:
        parser.error(f"no case's name holds {given.only!r}")

    def report(key: str, result: Record) -> None:
        if given.details:
            tell(key, result)

    found = run_all(kept.record, wanted, given.results, digest(*CODE), given.jobs, report)
    records = list(found.values())
    print(table_text(records), "\n")
    print(confusion_text(records), "\n")
    print(failures_text(records), "\n")
    print("Counted as right where the alternatives name the truth:")
    for pair, reason in CONFOUNDS.items():
        print(f"  {', '.join(sorted(pair))}: {reason}")
    for effect, (finding, reason) in FINDINGS.items():
        print(f"  {effect}, said by the finding {finding}: {reason}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
