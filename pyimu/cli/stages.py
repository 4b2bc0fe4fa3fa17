"""How far a search is that does not know how many rounds it takes."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from typing import Any

ROUND = 6.0
"""What a round over the candidates takes, where what comes before and after it takes 1 or so."""

STAGES = (
    (re.compile("^quality of the raw samples"), 1.0, False),
    (re.compile(r"^(\w+): fitting the model"), 3.0, True),
    (re.compile(r"^(\w+): \d+ added, trying"), ROUND, True),
    (re.compile(r"^(\w+): is anything left"), 1.5, True),
    (re.compile("^attitude against"), 1.0, False),
    (re.compile("^the whole model"), 1.0, False),
    (re.compile("^compiling"), 1.0, False),
    (re.compile("^drawing"), 1.0, False),
)
"""What is said at the beginning of a stage, what that takes, and whether each sensor has one. On
the demo's log: 1.4, 4.1, 12.1, 1.9, 1.2, 1.7, 0.2 and 1 s."""


class Stages:
    """Says a search on with the share of it that is behind.

    Each sensor is expected to have two rounds, and one more whenever it has had as many as were
    expected; the share never falls. ``sensors`` are those that the logs hold.
    """

    def __init__(self, say: Callable[..., None], sensors: Iterable[str]) -> None:
        self._say, self._share = say, 0.0
        self._behind = self._current = 0.0
        self._rounds = dict.fromkeys(sensors, 0)

    def __call__(self, text: str, share: float | None = None) -> None:
        """Say what is being done now."""
        for said, takes, each in STAGES:
            found = said.match(text)
            if found:
                self._behind, self._current = self._behind + self._current, takes
                if each and takes == ROUND and found[1] in self._rounds:
                    self._rounds[found[1]] += 1
                break
        expected: Any = sum(takes * (self._each(takes) if each else 1) for _, takes, each in STAGES)
        self._share = max(self._share, min(self._behind / expected, 0.99))
        self._say(text, self._share)

    def _each(self, takes: float) -> int:
        """How many of a stage there are in all."""
        if takes != ROUND:
            return len(self._rounds)
        return sum(max(2, done + 1) for done in self._rounds.values())
