"""Which values of a program are made as lanes of vectors, in what order, and what that costs."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import casadi as ca

from pyimu.block.alike import MORE, MOST, Alike, Lanes

Choice = dict[int, tuple[Lanes, int]]
"""By number of an instruction the vector that has its value, and in which lane."""

Value = int | Lanes
"""A number, by its instruction, or a vector."""

STORED = {1: 1.0, 3: 2.3, 4: 1.0}
"""The same that store so many lanes."""

EXTRACTED = (0.0, 1.0, 1.3, 1.6)
"""The same that take a number out of a lane."""


@dataclass(frozen=True)
class Unit:
    """Something that is done at once: a ``number`` is made, a ``lane`` taken out of a vector, a
    vector ``computed``, ``read`` from consecutive numbers of an input, ``taken`` from ``window``
    (input, first), that is four of these, or ``filled`` from what there is, and numbers or vectors
    ``stored`` at ``place`` (result, entry), or four ``copied`` there from an input.
    """

    kind: str
    lanes: Lanes
    place: tuple[int, int] | None = None


class Cycle(Exception):
    """Two vectors that wait for each other."""


class Units:
    """How values are made by a ``choice`` of vectors, and what that costs; ``sizes`` are those of
    the inputs.
    """

    def __init__(self, alike: Alike, choice: Choice, sizes: list[int]) -> None:
        self.alike, self.choice, self.sizes = alike, choice, sizes

    def needs(self, value: Value) -> list[Value]:
        """The values that are there before this one."""
        if isinstance(value, int):
            if value in self.choice:
                return [self.choice[value][0]]
            return self.alike.inner[value]
        if self._is_computed(value):
            return [*self.alike.aligned(value)]
        return self._sources(value)

    def cost(self, value: Value) -> float:
        """That of a number or a vector."""
        return self.number(value) if isinstance(value, int) else self.vector(value)[1]

    def number(self, k: int) -> float:
        """The cost of a value as a number."""
        if k in self.choice:
            return EXTRACTED[self.choice[k][1]]
        return self.alike.cost[k]

    def _is_computed(self, lanes: Lanes) -> bool:
        return self.choice.get(lanes[0], (None, 0))[0] == lanes

    def _sources(self, lanes: Lanes) -> list[Value]:
        """The vectors and numbers of which a vector is filled, inputs and constants apart."""
        found = (self.choice[k][0] if k in self.choice else k for k in lanes)
        return [
            *dict.fromkeys(v for v in found if isinstance(v, tuple) or not self.alike.is_leaf(v))
        ]

    def vector(self, lanes: Lanes) -> tuple[Unit, float]:
        """How a vector is made, and the cost."""
        alike, first = self.alike, lanes[0]
        if self._is_computed(lanes):
            return Unit("computed", lanes), MORE.get(alike.op[first], (1.0, 1.0))[1]
        filled, same = Unit("filled", lanes), all(k == first for k in lanes)
        if all(alike.op[k] == ca.OP_CONST for k in lanes):
            return filled, 0.3
        if same and alike.is_leaf(first):
            return filled, 0.5
        window = self._window(lanes)
        if window is not None:
            entries = [alike.read[k][1] for k in lanes]
            if entries == [*range(window[1], window[1] + len(lanes))]:
                return Unit("read", lanes, window), 0.7
            return Unit("taken", lanes, window), 1.2
        sources = {self.choice[k][0] if k in self.choice else None for k in lanes}
        if same or (None not in sources and len(sources) <= 2):
            return filled, 1.0 if same or len(sources) == 1 else 1.5
        return filled, len(lanes) + 0.3 * sum(alike.read[k] is not None for k in lanes)

    def _window(self, lanes: Lanes) -> tuple[int, int] | None:
        """Where four consecutive numbers of an input begin that have all lanes."""
        read = [self.alike.read[k] for k in lanes]
        if any(r is None or r[0] != read[0][0] for r in read):
            return None
        entries = [r[1] for r in read]
        start = min(*entries, self.sizes[read[0][0]] - MOST)
        return (read[0][0], start) if 0 <= start and max(entries) < start + MOST else None


def stored(
    alike: Alike, choice: Choice, entries: dict[int, int], first: int = 0
) -> Iterator[tuple[int, str, Lanes, Value | None, float]]:
    """Of each unit that stores some of the ``entries`` of a result, from the ``first`` on, the
    first of these, its kind and lanes, the value that it takes, None where that is an input, and
    its cost. A unit stores at most ``MOST`` entries, and follows from these alone.
    """
    begins, last = first, max(entries, default=-1)
    while begins <= last:
        entry = begins
        if entry not in entries:
            begins += 1
            continue
        copied = _copied(alike, entries, entry)
        if copied:
            begins += MOST
            yield entry, "copied", copied, None, STORED[MOST]
            continue
        k = entries[entry]
        lanes, lane = choice.get(k, (_constants(alike, entries, entry) or (k,), 0))
        made = lanes if len(lanes) > 1 else None if alike.is_leaf(k) else k
        if lane or any(entries.get(entry + n) != j for n, j in enumerate(lanes)):
            lanes = (k,)
        begins += len(lanes)
        yield entry, "stored", lanes, made, STORED[len(lanes)] + (len(lanes) == 1) * (lane > 1)


def _copied(alike: Alike, entries: dict[int, int], entry: int) -> Lanes:
    """Four consecutive numbers of an input that become a result as they are; else nothing."""
    lanes = tuple(entries.get(entry + n, entries[entry]) for n in range(MOST))
    read = [alike.read[k] for k in lanes]
    first = read[0]
    if first and read == [(first[0], first[1] + n) for n in range(MOST)]:
        return lanes
    return ()


def _constants(alike: Alike, entries: dict[int, int], entry: int) -> Lanes:
    """Four consecutive entries of a result that are constants; else nothing."""
    lanes = tuple(entries[entry + n] for n in range(MOST) if entry + n in entries)
    constant = len(lanes) == MOST and all(alike.op[k] == ca.OP_CONST for k in lanes)
    return lanes if constant else ()


def needed_first(
    wanted: Value, needs: Callable[[Value], list[Value]], begun: dict[Value, bool]
) -> Iterator[Value]:
    """What a value ``needs``, and then itself, each after its own needs, less what was there.

    ``begun`` says of the values that were come to whether they are there. Raises Cycle where one
    needs itself.
    """
    stack = [(wanted, iter((wanted,)))]
    while stack:
        value, left = stack[-1]
        for following in left:
            done = begun.get(following)
            if done is None:
                begun[following] = False
                stack.append((following, iter(needs(following))))
                break
            if not done:
                raise Cycle
        else:
            stack.pop()
            if stack:
                begun[value] = True
                yield value


class Plan:
    """The units that make the results of a program by a ``choice`` of vectors, and their ``cost``.

    ``sizes`` are those of the inputs. Raises Cycle where the vectors cannot be made one after the
    other.
    """

    def __init__(self, alike: Alike, choice: Choice, sizes: list[int]) -> None:
        self.alike, self.choice = alike, choice
        self.made_by = Units(alike, choice, sizes)
        self.units: list[Unit] = []
        self.cost = 0.0
        self._begun: dict[Value, bool] = {}
        for number, entries in alike.results.items():
            self._store(number, entries)

    def _store(self, number: int, entries: dict[int, int]) -> None:
        for entry, kind, lanes, made, cost in stored(self.alike, self.choice, entries):
            if made is not None:
                self._make(made)
            self.cost += cost
            self.units.append(Unit(kind, lanes, (number, entry)))

    def _make(self, wanted: Value) -> None:
        """Append what a value needs, and then itself, as far as it is not there yet."""
        for value in needed_first(wanted, self.made_by.needs, self._begun):
            self._finish(value)

    def _finish(self, value: Value) -> None:
        """Append a value whose needs are there."""
        if isinstance(value, tuple):
            unit, cost = self.made_by.vector(value)
            self.units.append(unit)
        else:
            cost = self.made_by.number(value)
            if value not in self.choice:
                self.units.append(Unit("number", (value,)))
        self.cost += cost
