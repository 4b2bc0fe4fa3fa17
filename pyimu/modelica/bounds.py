"""The bounds of a coefficient as assertions, which say what is wrong and what would be right."""

from __future__ import annotations

from collections.abc import Iterator

from pyimu.modelica.text import number


def bound_asserts(
    where: str,
    name: str,
    many: bool,
    minimum: float | None,
    maximum: float | None,
    as_read: str = "",
) -> Iterator[str]:
    """Assertions that ``name``, an array where there are ``many``, keeps its bounds.

    The text begins with ``where`` and says ``as_read`` of the coefficient, else its name. What is
    no number breaks a bound as well.
    """
    for sign, bound, word in ((">=", minimum, "below"), ("<=", maximum, "above")):
        if bound is not None:
            worst = f"{'min' if word == 'below' else 'max'}({name})" if many else name
            yield (
                f'assert({worst} {sign} {number(bound)}, "{where}: {as_read or name} must not be '
                f'{word} {bound:g}");'
            )
