"""Coefficients of which the logs tell less than is known of any part, held where that has them.

A fit leaves them where the rows and the prior together put them, and what is left of a log need not
be as random as the prior takes it for: they may end far from where any part is. As the model's they
would be numbers that nothing shows, and a bias that goes with one of them would be as far off. Held
at their identity they leave the others what goes with that; these keep the standard errors that
they have beside one that is not known.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from pyimu.identification.fit.errors_in_variables import equations
from pyimu.identification.fit.fit import Fit, departure, stepped, with_prior
from pyimu.identification.fit.keys import Coefficient, Key
from pyimu.identification.fit.maximum_likelihood import fit
from pyimu.identification.fit.normal import variances
from pyimu.identification.search.investigation import Investigation

OUTWEIGHED = np.sqrt(0.5)
"""Standard error, in units of the prior's, from which on the prior says more of a coefficient than
the logs do: both tell by the inverse of their variance."""


def with_unshown_held(inv: Investigation) -> Investigation:
    """An investigation with what its logs do not show at the identity, and all else fitted beside
    that.

    Of rests each row says something of several coefficients: the prior shares that out among them.
    """
    keys = [] if inv.after.is_reduced else unshown(inv.after)
    if not keys:
        return inv
    before = _held(inv.before, keys)
    # Where nothing was added both are one model.
    after = _held(inv.after, keys) if inv.steps else _with_errors_of(before, inv.after)
    return replace(inv, before=before, after=after)


def unshown(fitted: Fit) -> list[Coefficient]:
    """The coefficients of which the rows tell less than their prior, beside those already held.

    The one that is shown least comes first, and the others are judged beside it: where rows show
    the sum of some alone, the last of them stands for it.
    """
    normal = with_prior(equations(fitted), fitted)
    seen = None if normal.seen is None else normal.variance
    free = {k: s for k, s in fitted.prior.items() if k in fitted.free and k in normal.position}
    wider = _widened(fitted.std, normal.keys, variances(normal.gram, seen))
    left, out = list(range(len(normal.keys))), []
    while free:
        at = np.ix_(left, left)
        variance = variances(normal.gram[at], None if seen is None else seen[at])
        std = wider[left] * np.sqrt(variance)
        share = {k: std[left.index(normal.position[k])] / s for k, s in free.items()}
        least = max(share, key=share.get)
        if share[least] <= OUTWEIGHED:
            break
        del free[least]
        out.append(least)
        left.remove(normal.position[least])
    return out


def _widened(std: Mapping[Key, float], keys: list[Key], variance: np.ndarray) -> np.ndarray:
    """By what factor the standard errors of a fit are larger than its equations have them."""
    with np.errstate(invalid="ignore", divide="ignore"):
        wider = np.array([std.get(k, np.nan) for k in keys]) / np.sqrt(variance)
    return np.where(np.isfinite(wider), wider, 1.0)


def _held(fitted: Fit, keys: list[Coefficient]) -> Fit:
    """A fit with coefficients at their identity, and fitted anew beside that."""
    back = np.array([-departure(fitted, k) for k in keys])
    held = replace(stepped(fitted, keys, back), free=fitted.free.difference(keys))
    return _with_errors_of(fit(held.with_noise()), fitted)


def _with_errors_of(held: Fit, free: Fit) -> Fit:
    """The fit with standard errors no smaller than those beside ``free`` coefficients."""
    std = {k: max(s, free.std.get(k, 0.0)) for k, s in held.std.items()}
    return replace(held, std=std)
