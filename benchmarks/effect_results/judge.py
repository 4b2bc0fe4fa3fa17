"""What the loop made of a case, in one word."""

from __future__ import annotations

from typing import Any

from effect_results.confounds import FINDINGS, confounded

Record = dict[str, Any]

NOISE = frozenset({"angle_random_walk", "rate_random_walk"})
"""Effects that a part declares and that the loop reports as changed, or as drift."""

NAMED_APART = 6.0
"""nat; effects that explain as much to within so many are told by the loop as each other's
alternatives."""

OWN = "found_effect"
"""The name of a formula that the loop found by itself."""

OUTCOMES = (
    "right",
    "beside",
    "partly",
    "wrong",
    "refused",
    "unexplained",
    "drift",
    "missed",
    "failed",
)
"""All effects named and nothing else; all of them and something beside; some of them; something
else; nothing, and the truth refused, the residual called unexplained or drift; nothing at all; an
error."""


def named(record: Record) -> list[tuple[str, str]]:
    """What the result says that the part lacks or has wrong: sensor and effect."""
    out = [(a["sensor"], a["effect"]) for a in record.get("added", ())]
    out += [(s, e) for s, e, _ in record.get("changed", ()) if e not in NOISE]
    truths = {t["effect"] for t in record["truths"]}
    wanted = truths & NOISE
    out += [
        (s, e)
        for s, e, _ in record.get("changed", ())
        if e in wanted or e in NOISE and truths & _instead(record, s, e)
    ]
    if "rate_random_walk" in wanted:
        out += [(s, "rate_random_walk") for s in record.get("drift", ())]
    out += _by_finding(record)
    return list(dict.fromkeys(out))


def _by_finding(record: Record) -> list[tuple[str, str]]:
    """True effects that a finding about the reference names."""
    return [
        (t["kind"], t["effect"])
        for t in record["truths"]
        if t["effect"] in FINDINGS and FINDINGS[t["effect"]][0] in record.get("quality", ())
    ]


def stands_for(record: Record, sensor: str, effect: str, truth: Record) -> bool:
    """Whether what was named is a true effect, or one that the result says the truth may be instead
    and that is listed as one that no log tells from it, or these logs do not.
    """
    if sensor != truth["kind"]:
        return False
    if effect == truth["effect"]:
        return True
    as_good = truth["effect"] in _alternatives(record, sensor, effect)
    return as_good and (confounded(effect, truth["effect"]) or alike(record, effect, truth))


def alike(record: Record, effect: str, truth: Record) -> bool:
    """Whether the logs are expected to speak for a true effect against another by too little to
    name it, by the generator's own motion and noise.
    """
    apart = record.get("nat_apart", {}).get(f"{effect} {truth['effect']}")
    return apart is not None and apart < NAMED_APART


def _alternatives(record: Record, sensor: str, effect: str) -> set[str]:
    found = {n for a in record["added"] if a["effect"] == effect for n in a["alternatives"]}
    return found | _instead(record, sensor, effect)


def _instead(record: Record, sensor: str, effect: str) -> set[str]:
    """What explains as much as a declared noise that was changed."""
    return set(record.get("instead", {}).get(f"{sensor}.{effect}", ()))


def outcome(record: Record) -> str:
    """One of ``OUTCOMES``."""
    if "verdict" not in record:
        return "failed"
    truths = record["truths"]
    if any(not t["effect"] for t in truths):
        return _of_the_nameless(record)
    found = [(s, e, [stands_for(record, s, e, t) for t in truths]) for s, e in named(record)]
    seen = [any(hits[i] for _, _, hits in found) for i in range(len(truths))]
    extra = any(not any(hits) for _, _, hits in found)
    if not truths:
        return "wrong" if extra else "right"
    if all(seen):
        return "beside" if extra else "right"
    if any(seen):
        return "wrong" if extra else "partly"
    return "wrong" if extra else _of_nothing(record)


def _of_nothing(record: Record) -> str:
    true = {(t["kind"], t["effect"]) for t in record["truths"]}
    if any((r["sensor"], r["effect"]) in true for r in record["refused"]):
        return "refused"
    return record["verdict"] if record["verdict"] in ("unexplained", "drift") else "missed"


def _of_the_nameless(record: Record) -> str:
    """An error without a name is rightly called unexplained, or given a formula, or the name of an
    effect that no log tells it from, of which the result says so.
    """
    found = {e for _, e in named(record)}
    if named_with_confidence(record):
        return "wrong"
    if found or record["unexplained"] or record["verdict"] == "unexplained":
        return "right"
    return "drift" if record["verdict"] == "drift" else "missed"


def named_with_confidence(record: Record) -> set[str]:
    """The effects that were named for an error without a name, less its formula and what is listed
    as one that no log tells it from.
    """
    truths = {t["term"] for t in record["truths"]}
    found = {e for _, e in named(record)} - {OWN}
    return {e for e in found if not any(confounded(e, t) for t in truths)}


def said(record: Record) -> list[str]:
    """The columns of the confusion matrix that a case counts in: what was named, or in brackets
    what was said instead.
    """
    if "verdict" not in record:
        return ["(failed)"]
    kinds = {t["kind"] for t in record["truths"]}
    found = [e if s in kinds or not kinds else f"{s} {e}" for s, e in named(record)]
    word = outcome(record)
    if found:
        return found
    if record["unexplained"] and word == "right":
        return ["(unexplained)"]
    return [f"({word})" if word in ("refused", "unexplained", "drift") else "(nothing)"]


def why(record: Record) -> str:
    """A failure in a few words."""
    for key in ("failed", "refused_log"):
        if key in record:
            return record[key]
    true = {(t["kind"], t["effect"]): t for t in record["truths"]}
    refused = [r for r in record["refused"] if (r["sensor"], r["effect"]) in true]
    if refused:
        return f"refused: {refused[0]['reason']}"
    parts = [p for k, e in true if (p := _unseen(record, f"{k}.{e}")) and e]
    fates = [c for c in record["candidates"] if (c["sensor"], c["effect"]) in true]
    parts += [f"{c['effect']} {c['outcome']}: {c['reason']}" for c in fates]
    found = [f"{s} {e}" for s, e in named(record)]
    parts += [f"named {', '.join(found)}"] if found else [record["verdict"]]
    return "; ".join(parts)


def _unseen(record: Record, name: str) -> str:
    """Why an effect was not looked for, where it was not: ``visible`` has by effect what it is
    invisible by, or nothing.
    """
    if name not in record["visible"]:
        return f"{name} is not looked for"
    reason = record["visible"][name]
    return f"{name} is not looked for, {reason}" if reason else ""
