"""The nearest of known names, to end a message with."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches


def nearest(name: str, names: Iterable[str], cutoff: float = 0.7) -> str | None:
    """The member of ``names`` closest in spelling to ``name``, ignoring case, or None."""
    folded: dict[str, str] = {}
    for candidate in names:
        folded.setdefault(candidate.casefold(), candidate)
    match = get_close_matches(str(name).casefold(), folded, n=1, cutoff=cutoff)
    return folded[match[0]] if match else None


def did_you_mean(name: str, names: Iterable[str], cutoff: float = 0.7) -> str:
    """``", did you mean NEAREST?"`` to end an error message with, empty where nothing is near."""
    near = nearest(name, names, cutoff)
    return f", did you mean {near}?" if near else ""


def or_known(name: str, names: Iterable[str]) -> str:
    """The end of an error message as ``did_you_mean``; all ``names`` where nothing is near."""
    listed = list(names)
    return did_you_mean(name, listed) or f"; known are {', '.join(listed)}"
