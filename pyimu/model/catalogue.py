"""The effects that are known by name: those of the package, and a user's own."""

from __future__ import annotations

import importlib.util
import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from types import ModuleType

from pyimu.errors import UserError
from pyimu.model.effect import Effect
from pyimu.model.effects import EFFECTS
from pyimu.model.kinds import STAGES
from pyimu.units import or_known


class Catalogue(Mapping[str, Effect]):
    """Effects by name, in the order in which those of one stage act."""

    def __init__(self, effects: Iterable[Effect]) -> None:
        self._effects: dict[str, Effect] = {}
        self.add(*effects)

    def __getitem__(self, name: str) -> Effect:
        return self._effects[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._effects)

    def __len__(self) -> int:
        return len(self._effects)

    def add(self, *effects: Effect) -> None:
        """List effects after those that are there. Raises UserError for a name that is taken."""
        for e in effects:
            if e.name in self._effects:
                raise UserError(
                    f"effect {e.name}: there is one of this name already; give yours another"
                )
            self._effects[e.name] = e

    def remove(self, *names: str) -> None:
        """Forget effects; sensors that have them keep them."""
        for name in names:
            del self._effects[name]

    def of(self, kind: str, name: str) -> Effect:
        """The effect of a sensor of this kind. Raises UserError where it has none of this name."""
        if name not in self._effects:
            raise UserError(f"unknown effect '{name}'{or_known(name, self._effects)}")
        if kind not in self._effects[name].triads:
            raise UserError(f"effect {name} does not belong to a {kind}")
        return self._effects[name]

    def in_order(self, effects: Iterable[Effect]) -> tuple[Effect, ...]:
        """Effects in the order in which they act.

        They are sorted by stage, and within a stage by their place in the catalogue.
        """
        places = {name: place for place, name in enumerate(self._effects)}
        return tuple(sorted(effects, key=lambda e: (STAGES.index(e.stage), places[e.name])))


CATALOGUE = Catalogue(EFFECTS)
"""Every effect that is known by name."""


def read_off(effects: Iterable[Effect], what: str) -> tuple[str, str] | None:
    """The first of ``effects`` with a coefficient that is read off raw samples as ``what``.

    ``what`` is "ceiling" or "step". Gives the names of effect and coefficient, None where there is
    none.
    """
    found = ((e.name, e.reading(what)) for e in effects)
    return next(((name, parameter) for name, parameter in found if parameter is not None), None)


def _only(chosen: Callable[[Effect], bool]) -> tuple[str, str]:
    """The effect of the package that is ``chosen``, and its first coefficient."""
    found = [e for e in EFFECTS if chosen(e)]
    if len(found) != 1:
        raise ValueError(f"one effect alone may be this: {', '.join(e.name for e in found)}")
    return found[0].name, next(iter(found[0].parameters))


POWER_ON = _only(lambda e: e.per_power_on)
"""Effect and coefficient of the bias that is drawn anew at each power-on."""

WHITE = _only(lambda e: e.law is not None and e.law.is_plain("white"))
"""Effect and coefficient of plain white noise."""

WALK = _only(lambda e: e.law is not None and e.law.is_plain("walk"))
"""Effect and coefficient of the plain random walk."""

INCREMENTS = _only(lambda e: e.law is not None and e.law.is_plain("rounding"))
"""Effect and coefficient of the step to which the integral of the output is rounded."""


def add_effects(*sources: str | os.PathLike | Effect) -> tuple[Effect, ...]:
    """Add effects of your own to the catalogue, for parts, ``close`` and every other command.

    For example::

        pyimu.add_effects("my_effects.py")              # every effect that the file defines
        pyimu.add_effects(my_effect)                    # one that was defined here

    The file is run as a Python program. A file or an effect that was added before replaces its
    older version. Gives the effects. Raises UserError for a file that cannot be run or defines
    none, and for the name of an effect of the package.
    """
    found = [e for s in sources for e in ([s] if isinstance(s, Effect) else _effects_of(Path(s)))]
    CATALOGUE.remove(
        *{e.name for e in found if e.name in CATALOGUE and CATALOGUE[e.name] not in EFFECTS}
    )
    CATALOGUE.add(*found)
    return tuple(found)


def _effects_of(path: Path) -> list[Effect]:
    module = _run(path)
    effects = [
        replace(e, file=str(path.resolve()))
        for e in vars(module).values()
        if isinstance(e, Effect) and e not in EFFECTS
    ]
    if not effects:
        raise UserError(
            f"{path}: defines no effect; write a function decorated with @pyimu.effect.effect(...)"
        )
    return effects


def _run(path: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location(f"pyimu_effects_{path.stem}", path)
    if path.suffix != ".py" or spec is None or spec.loader is None:
        raise UserError(f"{path}: is no file of Python, whose name ends in .py")
    module = importlib.util.module_from_spec(spec)
    try:
        # Not by the loader, which takes bytecode for fresh where a file of equal length was
        # written within a second of it.
        code = compile(path.read_bytes(), path, "exec", dont_inherit=True)
        exec(code, vars(module))
    except FileNotFoundError:
        raise UserError(f"{path}: no such file") from None
    except Exception as error:  # whatever a user's own program raises
        raise UserError(
            f"{path}: {type(error).__name__}: {str(error).partition(chr(10))[0]}"
        ) from error
    return module
