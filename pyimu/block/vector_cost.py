"""What a choice of vectors costs, followed from one choice to the next wider one."""

from __future__ import annotations

from itertools import islice
from typing import NamedTuple

from pyimu.block.alike import MOST, Alike, Lanes
from pyimu.block.vector_plan import Choice, Cycle, Units, Value, needed_first, stored

Place = tuple[int, int]
"""A result and one of its entries."""


class Store(NamedTuple):
    """The cost of something that is stored, and its value, None for an input."""

    cost: float
    value: Value | None


Stores = dict[Place, Store]
"""By the first of the entries that are stored at once."""


class Cost:
    """The cost of a choice: of what its results need, each value once.

    How often a value is needed is counted, so that of a wider choice only what changes is looked
    at.
    """

    def __init__(self, alike: Alike, choice: Choice, sizes: list[int]) -> None:
        self.alike, self.sizes = alike, sizes
        self.made_by = Units(alike, choice, sizes)
        self.results: dict[int, set[Place]] = {}
        for number, entries in alike.results.items():
            for entry, k in entries.items():
                self.results.setdefault(k, set()).add((number, entry))
        self.total = 0.0
        self._count: dict[Value, int] = {}
        self._needs: dict[Value, list[Value]] = {}
        self._with: dict[int, set[Lanes]] = {}
        self._before: dict[Value, int] = {}
        self._stores = {
            (number, entry): Store(cost, value)
            for number, entries in alike.results.items()
            for entry, _, _, value, cost in stored(alike, choice, entries)
        }
        self._stored_as(self._stores, 1)
        self._need(_values(self._stores))

    def widened(self, choice: Choice, least: float) -> bool:
        """Whether a wider choice costs less by more than ``least``, and no two of its vectors wait
        for each other; if so it is the one that is followed from now on.
        """
        total, made_by, self._before = self.total, self.made_by, {}
        new = [*islice(choice, len(made_by.choice), None)]  # a wider one has them at its end
        touched = {v for k in new for v in (k, *self._with.get(k, ())) if v in self._count}
        places = sorted({place for k in new for place in self.results.get(k, ())})
        old = {v: self._needs[v] for v in touched}
        self.total -= sum(made_by.cost(v) for v in touched)
        self.made_by = Units(self.alike, choice, self.sizes)
        self.total += sum(self.made_by.cost(v) for v in touched)
        gone, come = self._stored_anew(places)
        self._stored_as(gone, -1)
        self._stored_as(come, 1)
        # What is needed anew first, so that nothing goes which stays.
        for value in touched:
            self._needs[value] = self.made_by.needs(value)
            self._need(self._needs[value])
        self._need(_values(come))
        self._drop(_values(gone))
        for needs in old.values():
            self._drop(needs)
        if self.total < total - least and not self._waits({choice[k][0] for k in new}):
            for place in gone:
                del self._stores[place]
            self._stores |= come
            return True
        self._undo(total, made_by, old)
        return False

    def _stored_anew(self, places: list[Place]) -> tuple[Stores, Stores]:
        """The stores that are no more where the values at ``places`` are made in another way, and
        those in their stead.
        """
        gone: Stores = {}
        come: Stores = {}
        left = places[::-1]
        while left:
            number, changed = left[-1]
            entries = self.alike.results[number]
            reach = range(changed - MOST + 1, changed + 1)
            first = next(e for e in reach if (number, e) in self._stores)
            end = max(entries) + 1
            for entry, _, _, value, cost in stored(self.alike, self.made_by.choice, entries, first):
                while left and left[-1] < (number, entry):
                    left.pop()
                follows = left and left[-1] < (number, entry + MOST)
                if not follows and (number, entry) in self._stores:
                    end = entry  # from here on all is as it was
                    break
                come[number, entry] = Store(cost, value)
            while left and left[-1] < (number, end):
                left.pop()
            gone |= {
                place: self._stores[place]
                for place in ((number, e) for e in range(first, end))
                if place in self._stores
            }
        return gone, come

    def _stored_as(self, stores: Stores, sign: int) -> None:
        """The cost of stores is added or taken off."""
        self.total += sign * sum(store.cost for store in stores.values())

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


def _values(stores: Stores) -> list[Value]:
    """What is stored, inputs apart."""
    return [store.value for store in stores.values() if store.value is not None]
