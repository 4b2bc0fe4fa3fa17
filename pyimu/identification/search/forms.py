"""The likeliest form of each effect that has one to be found: each value is tried on the whole
residual, and the best is where regression starts from.

What varies slowly is tried on means of seconds, a line on the periodogram of the whitened residual.
The best of many is large by chance, too: the ``toll`` [nat] is what the choice makes of it.
"""

from __future__ import annotations

from collections.abc import Iterable

from pyimu.identification.fit.fit import Fit
from pyimu.identification.search.by_chance import Chance
from pyimu.identification.search.form import Form, form_of
from pyimu.identification.search.line_form import line_form
from pyimu.identification.search.slow_forms import Slow
from pyimu.model.effect import Effect


def forms(
    fit: Fit, effects: Iterable[Effect], penalty: float, chance: Chance | None = None
) -> dict[str, Form]:
    """By name the likeliest form of each effect that has one to be tried; without those whose form
    shows in no log. ``penalty`` [nat] is what a coefficient costs, ``chance`` the draws of what the
    fit leaves, where there are some.
    """
    wanted = [e for e in effects if form_of(e)]
    if not wanted or fit.is_reduced:
        return {}
    linears, out = fit.linearise(), {}
    slow = Slow(fit, linears, chance or Chance(fit, linears, penalty))
    for e in wanted:
        found = line_form(fit, linears, e, penalty) if e.is_line else slow.form(e)
        if found is not None:
            out[e.name] = found
    return out
