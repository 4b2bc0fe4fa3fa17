"""The rates of the loop as a table, what was named for what, and how the failures failed."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
from effect_logs import nameless
from effect_logs.cases import MOTIONS
from runs.intervals import shown, wilson

from effect_results.coverage import covered, ratios
from effect_results.judge import (
    OUTCOMES,
    OWN,
    Record,
    named,
    named_with_confidence,
    outcome,
    said,
    why,
)

FORMULAS = {t.name for t in (*nameless.BILINEAR, *nameless.PERIODIC, *nameless.SWITCHING)}


@dataclass(frozen=True)
class Row:
    """One rate: of so many cases so many, and what is wanted of it, at most or at least."""

    name: str
    count: int
    of: int
    wanted: float
    at_most: bool = False

    @property
    def figure(self) -> str:
        return shown(self.count, self.of)

    @property
    def target(self) -> str:
        return f"{'at most' if self.at_most else 'at least'} {self.wanted:g}"

    @property
    def verdict(self) -> str:
        """Whether the interval lies on the wanted side, beyond it, or about it."""
        if not self.of:
            return ""
        low, high = wilson(self.count, self.of)
        if self.at_most:
            return "met" if high <= self.wanted else "missed" if low > self.wanted else "open"
        return "met" if low >= self.wanted else "missed" if high < self.wanted else "open"


def row_of(record: Record) -> str:
    """The part of a case's name that says its row: ``one/8``."""
    return record["name"].rsplit("/", 1)[0]


def rows(records: Iterable[Record]) -> list[Row]:
    """The rates of the table, in its order."""
    by_row = defaultdict(list)
    for r in records:
        by_row[row_of(r)].append(r)
    out = [_clean(by_row["clean"], m) for m in MOTIONS]
    texts = {
        "one/8": ("one log, 8 sigmas, right class, nothing beside", 0.93),
        "one/12": ("one log, 12 sigmas", 0.98),
        "one/30": ("one log, 30 sigmas", 1.0),
        "together/8": ("rover and table together, 8 sigmas", 0.98),
        "pair/12": ("two effects, 12 sigmas each, both and nothing beside", 0.92),
        "size1": ("a consumer part's size, right class, nothing beside", 0.98),
    }
    out += [_share(text, by_row[k], _right, wanted) for k, (text, wanted) in texts.items()]
    strange = by_row["unknown/30"]
    formulas = [r for r in strange if r["truths"][0]["term"] in FORMULAS]
    out.append(_share("unknown, 30 sigmas: named with confidence", strange, _named, 0.02, True))
    out.append(_share("unknown, 30 sigmas: said, or a formula", strange, _right, 0.95))
    out.append(_share("unknown, 30 sigmas: given a formula", formulas, _formula, 0.9))
    memory = by_row["strange/30"]
    out.append(_share("no formula's, 30 sigmas: named with confidence", memory, _named, 0.02, True))
    out.append(_share("no formula's, 30 sigmas: said, or a formula", memory, _right, 0.95))
    out.append(_blamed("clean, beside noisy attitudes", by_row["attitude/clean"]))
    beside = {"attitude/12": 0.98, "attitude/30": 1.0}
    text = "beside noisy attitudes, {} sigmas"
    return [
        *out,
        *(_share(text.format(k.split("/")[1]), by_row[k], _right, v) for k, v in beside.items()),
    ]


def _share(text, records, counts: Callable[[Record], bool], wanted, at_most=False) -> Row:
    return Row(text, sum(map(counts, records)), len(records), wanted, at_most)


def _clean(records, motion: str) -> Row:
    return _blamed(f"clean, {motion}", [r for r in records if r["name"].endswith(f"/{motion}")])


def _blamed(text: str, records) -> Row:
    return _share(f"{text}: blamed", records, lambda r: bool(named(r)), 0.01, True)


def _right(record: Record) -> bool:
    return outcome(record) == "right"


def _named(record: Record) -> bool:
    return bool(named_with_confidence(record))


def _formula(record: Record) -> bool:
    return OWN in {e for _, e in named(record)}


def figures(records: list[Record]) -> list[tuple[str, str, str]]:
    """Name, figure and target of every line of the table."""
    out = [(r.name, r.figure, f"{r.target} {r.verdict}".strip()) for r in rows(records)]
    for what, slow in (("fast", False), ("slow", True)):
        figure = shown(*covered(records, slow))
        out.append((f"95 % intervals that cover, {what} effects", figure, "0.94 to 0.96"))
    found = ratios(records)
    text = "-" if not found else f"median {np.median(found):.4f}, largest {max(found):.4f}"
    out.append((f"error after over the true model's, {len(found)} named", text, "1.005"))
    failed = sum("failed" in r for r in records)
    return [*out, ("ended in an error of the package", shown(failed, len(records)), "0")]


def table_text(records: list[Record]) -> str:
    lines = figures(records)
    widths = [max(len(line[i]) for line in lines) for i in range(2)]
    return "\n".join(f"{a:{widths[0]}}  {b:{widths[1]}}  {c}" for a, b, c in lines)


# What was named for what


def confusion(records: Iterable[Record]) -> dict[str, Counter[str]]:
    """By true effect, how often each name was given, a case of one effect alone counting once for
    each.
    """
    out: dict[str, Counter[str]] = defaultdict(Counter)
    for r in records:
        if len(r["truths"]) == 1:
            out[true_name(r)].update(said(r))
        elif not r["truths"]:
            out["(none)"].update(said(r))
    return dict(sorted(out.items()))


def true_name(record: Record) -> str:
    truth = record["truths"][0]
    return f"{truth['kind']} {truth['term']}"


def confusion_text(records: Iterable[Record]) -> str:
    matrix = confusion(records)
    width = max((len(n) for n in matrix), default=0)
    lines = [
        f"{name:{width}}  " + ", ".join(f"{k} {n}" for k, n in counts.most_common())
        for name, counts in matrix.items()
    ]
    return "\n".join(["What was said of what:", *lines])


# How the failures failed


def failures(records: Iterable[Record]) -> dict[str, Counter[str]]:
    """By true effects (of a pair both), how often each outcome."""
    out: dict[str, Counter[str]] = defaultdict(Counter)
    for r in records:
        terms = " + ".join(f"{t['kind']} {t['term']}" for t in r["truths"])
        key = terms if row_of(r) != "pair/12" else f"pair: {terms}"
        out[key or f"clean {r['name'].rsplit('/', 1)[1]}"][outcome(r)] += 1
    return out


def failures_text(records: list[Record]) -> str:
    """By effect the outcomes, the worst first, with an example of each failure."""
    counted = failures(records)
    worst = sorted(counted, key=lambda k: (counted[k]["right"] - counted[k].total(), k))
    width = max((len(n) for n in worst), default=0)
    head = f"{'':{width}}  " + " ".join(f"{w:>11}" for w in OUTCOMES)
    lines = [
        f"{name:{width}}  " + " ".join(f"{counted[name][w] or '.':>11}" for w in OUTCOMES)
        for name in worst
    ]
    examples = [
        f"  {r['name']} {r['number']} ({'+'.join(r['motions'])}, {r['form']}): {outcome(r)}; "
        f"{why(r)}"
        for r in records
        if outcome(r) != "right"
    ]
    return "\n".join([head, *lines, "", "Failures:", *examples])
