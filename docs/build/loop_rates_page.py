"""Write ``loop_rates.md`` and its picture: how often the loop names what a part lacks.

``python docs/build/loop_rates_page.py RESULTS ... [--folder FOLDER] [--commit COMMIT ...]``, with
the results that ``benchmarks/effects.py`` has written, a file for the code of each commit that the
page names.
Where a row has fewer cases than ``ENOUGH`` the page says that its figures are a first look.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.figure import Figure
from pages import DOCS, row, write_changed

sys.path.insert(0, str(DOCS.parent / "benchmarks"))

from effect_results.confounds import CONFOUNDS, FINDINGS  # noqa: E402
from effect_results.judge import NAMED_APART, OUTCOMES, Record  # noqa: E402
from effect_results.table import confusion, failures, figures, rows  # noqa: E402
from runs.pool import finished  # noqa: E402

from pyimu.report.numbers import joined  # noqa: E402

ENOUGH = 100
"""Cases of a row below which its figures are a first look: a rate of one half is known to a
tenth."""

NAME = "loop_rates"
BLUES = "Blues"
INCH = 0.16
"""Of the picture for each row and column."""


def page(records: list[Record], commits: Sequence[str] = ()) -> str:
    """The page's text; ``commits`` are those whose code made the results."""
    counts = [r.of for r in rows(records)]
    lines = [
        "# How often the loop names what a part lacks",
        "",
        f"From {len(records)} simulated logs of `benchmarks/effects.py`, whose generators share no",
        "code with the package. A size in sigmas is the norm of an effect's error over the fitted",
        "rows, whitened by the declared noise, once the bias and what is estimated are projected",
        "out. Intervals are Wilson's at 95 %; a target is met or missed where the whole interval",
        "lies on one side of it, and open where not.",
        "",
    ]
    told = sum(r.get("form") == "declared" for r in records)
    lines += [
        f"In {told} of them a part declares the sensor's noise, scale factor and misalignment; in",
        f"{len(records) - told} nobody declares anything, which is harder.",
        "",
    ]
    if commits:
        names = [f"`{c}`" for c in commits]
        parts = f"commit {names[0]}" if len(names) == 1 else f"commits {joined(names)}, each a part"
        lines += [f"Made with the code of {parts}.", ""]
    if min(counts) < ENOUGH:
        lines += [f"**A first look: rows of {min(counts)} to {max(counts)} cases.**", ""]
    lines += _table(["row", "figure", "target"], figures(records))
    lines += ["", "## What was said of what", "", f"![Confusion matrix]({NAME}.png)", ""]
    lines += ["## How the failures failed", "", *_failures(records), ""]
    lines += ["## What no log of this kind tells apart", ""]
    lines += [
        "Where the alternatives name the truth these count as right, and so do two effects of",
        "which a log, by its own motion and noise, is expected to speak for the true one by less",
        f"than {NAMED_APART:g} nat (`benchmarks/effect_logs/alike.py`).",
        "",
    ]
    pairs = [(", ".join(f"`{n}`" for n in sorted(p)), why) for p, why in CONFOUNDS.items()]
    pairs += [(f"`{e}`, by the finding `{name}`", why) for e, (name, why) in FINDINGS.items()]
    return "\n".join([*lines, *_table(["effects", "reason"], pairs), ""])


def _table(head: list[str], body) -> list[str]:
    rule = ["---"] * len(head)
    return [row(cells) for cells in (head, rule, *body)]


def _failures(records: list[Record]) -> list[str]:
    counted = failures(records)
    worst = sorted(counted, key=lambda k: (counted[k]["right"] - counted[k].total(), k))
    wrong = [k for k in worst if counted[k].total() > counted[k]["right"]]
    body = [(name, *(str(counted[name][w] or "") for w in OUTCOMES)) for name in wrong]
    return _table(["effect", *OUTCOMES], body)


def picture(matrix: dict[str, Counter[str]]) -> Figure:
    """The confusion matrix: truth downwards, what was said to the right, shares of the row."""
    said = sorted({k for counts in matrix.values() for k in counts}, key=_by_kind)
    share = np.array([[c[k] / c.total() for k in said] for c in matrix.values()])
    size = INCH * len(said) + 3.0, INCH * len(matrix) + 2.5
    with matplotlib.rc_context({"font.family": "DejaVu Sans", "font.size": 7}):
        figure = Figure(figsize=size, layout="constrained")
        panel = figure.subplots()
        panel.imshow(share, cmap=BLUES, vmin=0, vmax=1, aspect="auto")
        panel.set_xticks(range(len(said)), said, rotation=90)
        panel.set_yticks(range(len(matrix)), list(matrix))
        panel.set(xlabel="said", ylabel="true")
        for (i, j), value in np.ndenumerate(share):
            if value > 0:
                shade = "white" if value > 0.6 else "black"
                count = list(matrix.values())[i][said[j]]
                panel.text(j, i, str(count), ha="center", va="center", color=shade, fontsize=5)
    return figure


def _by_kind(name: str) -> tuple[bool, str]:
    """Names first, then what was said instead, in brackets."""
    return name.startswith("("), name


def write(results: Sequence[Path], folder: Path = DOCS, commits: Sequence[str] = ()) -> list[Path]:
    """Write page and picture from files of results; gives the paths of what changed."""
    each = [finished(one) for one in results]
    if empty := [one for one, found in zip(results, each, strict=True) if not found]:
        raise SystemExit(f"{empty[0]}: no results; benchmarks/effects.py writes them")
    records = list({key: r for found in each for key, r in found.items()}.values())
    path = folder / f"{NAME}.md"
    if not write_changed(path, page(records, commits)):
        return []
    image = folder / f"{NAME}.png"
    picture(confusion(records)).savefig(image, dpi=130, metadata={"Software": None})
    return [path, image]


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", type=Path, nargs="+")
    parser.add_argument("--folder", type=Path, default=DOCS)
    parser.add_argument("--commit", default=(), nargs="+", help="whose code made each of them")
    given = parser.parse_args()
    for written in write(given.results, given.folder, given.commit):
        print(written)
