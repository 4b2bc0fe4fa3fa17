"""What a choice of vectors costs, followed from one choice to the next wider one."""

from __future__ import annotations

from pyimu.block.alike import Alike, Lanes
from pyimu.block.vector_plan import Choice, Cycle, Units, Value, needed_first, stores


class Cost:
    """The cost of a choice: of what its results need, each value once.

    How often a value is needed is counted, so that of a wider choice only what changes is looked
    at.
    """

    def __init__(self, alike: Alike, choice: Choice, sizes: list[int]) -> None:
        self.alike, self.sizes = alike, sizes
        self.made_by = Units(alike, choice, sizes)
        self.results: dict[int, set[int]] = {}
        for number, entries in alike.results.items():
            for k in entries.values():
                self.results.setdefault(k, set()).add(number)
        self.total = 0.0
        self._count: dict[Value, int] = {}
        self._needs: dict[Value, list[Value]] = {}
        self._with: dict[int, set[Lanes]] = {}
        self._before: dict[Value, int] = {}
        for number in alike.results:
            self._need(self._stored(number, 1))

    def widened(self, choice: Choice, least: float) -> bool:
        """Whether a wider choice costs less by more than ``least``, and no two of its vectors wait
        for each other; if so it is the one that is followed from now on.
        """
        total, made_by, self._before = self.total, self.made_by, {}
        new = [k for k in choice if k not in made_by.choice]
        touched = {v for k in new for v in (k, *self._with.get(k, ())) if v in self._count}
        results = {n for k in new for n in self.results.get(k, ())}
        old = {v: self._needs[v] for v in touched}
        self.total -= sum(made_by.cost(v) for v in touched)
        stored = [k for n in results for k in self._stored(n, -1)]
        self.made_by = Units(self.alike, choice, self.sizes)
        self.total += sum(self.made_by.cost(v) for v in touched)
        # What is needed anew first, so that nothing goes which stays.
        for value in touched:
            self._needs[value] = self.made_by.needs(value)
            self._need(self._needs[value])
        for number in results:
            self._need(self._stored(number, 1))
        self._drop(stored)
        for needs in old.values():
            self._drop(needs)
        if self.total < total - least and not self._waits({choice[k][0] for k in new}):
            return True
        self._undo(total, made_by, old)
        return False

    def _stored(self, number: int, sign: int) -> list[Value]:
        """The values that a result stores, whose cost is added or taken off."""
        cost, values = stores(self.alike, self.made_by.choice, self.alike.results[number])
        self.total += sign * cost
        return values

    def _need(self, values: list[Value]) -> None:
        stack = [*values]
        while stack:
            value = stack.pop()
            count = self._count.get(value, 0)
            self._before.setdefault(value, count)
            self._count[value] = count + 1
            if not count:
                self._appears(value)
                self.total += self.made_by.cost(value)
                stack += self._needs[value]

    def _drop(self, values: list[Value]) -> None:
        stack = [*values]
        while stack:
            value = stack.pop()
            count = self._count[value]
            self._before.setdefault(value, count)
            if count > 1:
                self._count[value] = count - 1
                continue
            self.total -= self.made_by.cost(value)
            stack += self._needs[value]
            self._goes(value)

    def _appears(self, value: Value) -> None:
        self._needs[value] = self.made_by.needs(value)
        if isinstance(value, tuple):
            for k in value:
                self._with.setdefault(k, set()).add(value)

    def _goes(self, value: Value) -> None:
        del self._count[value], self._needs[value]
        if isinstance(value, tuple):
            for k in value:
                self._with[k].discard(value)

    def _undo(self, total: float, made_by: Units, needs: dict[Value, list[Value]]) -> None:
        self.total, self.made_by = total, made_by
        for value, count in self._before.items():
            now = value in self._count
            if count and not now:
                self._appears(value)
            if now and not count:
                self._goes(value)
            if count:
                self._count[value] = count
        self._needs.update(needs)

    def _waits(self, vectors: set[Lanes]) -> bool:
        """Whether one of these vectors needs itself."""
        begun: dict[Value, bool] = {}
        try:
            for first in vectors & self._needs.keys():
                for _ in needed_first(first, self._needs.__getitem__, begun):
                    pass
        except Cycle:
            return True
        return False
