"""How far the coefficients of what was named lie from the truth, in their standard errors."""

from __future__ import annotations

import numpy as np

from effect_results.judge import Record, outcome

Z95 = 1.959964


def deviations(record: Record) -> list[float]:
    """Of each estimated entry of each effect that is named by its own name."""
    if outcome(record) not in ("right", "beside", "partly"):
        return []
    out: list[float] = []
    for truth in record["truths"]:
        for a in record["added"]:
            if (a["sensor"], a["effect"]) == (truth["kind"], truth["effect"]):
                out += _of(a["parameters"].get(truth["parameter"]), truth["value"])
    return out


def _of(estimate, value) -> list[float]:
    if estimate is None:
        return []
    at, std, true = (np.asarray(v, float) for v in (estimate["value"], estimate["std"], value))
    if at.shape != true.shape:
        return []
    free = std > 0
    return ((at - true)[free] / std[free]).tolist()


def covered(records, slow: bool) -> tuple[int, int]:
    """Entries inside their 95 % intervals, and all, of effects that change slowly or not."""
    chosen = [r for r in records if all(t["slow"] == slow for t in r["truths"])]
    z = np.abs([d for r in chosen for d in deviations(r)])
    return int(np.sum(z <= Z95)), len(z)


def ratios(records) -> list[float]:
    """Error after over that of the true model, where all was named and nothing else."""
    named = [r for r in records if r["truths"] and all(t["effect"] for t in r["truths"])]
    right = [r for r in named if outcome(r) == "right"]
    errors = [r["errors"].get(r["truths"][0]["kind"]) for r in right]
    return [e["after"] / e["true"] for e in errors if e]
