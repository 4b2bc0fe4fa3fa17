"""The spectrum of the noise that was chosen against that of a residual."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.signal import lfilter
from scipy.stats import binom

from pyimu.identification.noise.cells import Cells
from pyimu.identification.noise.choose import Axis, State, Term
from pyimu.identification.noise.laws import kinds
from pyimu.identification.noise.misfit import misfits_of
from pyimu.identification.noise.rows import Rows
from pyimu.identification.noise.spectrum import bands
from pyimu.model.sensor import Sensor

H, N_ROWS, WHITE, TAU = 0.02, 20000, 1.0, 4.0
PART = Sensor("gyro", {"angle_random_walk": {"N": [np.sqrt(WHITE * H)] * 3}})
MARKOV = next(k for k in kinds(PART, H, N_ROWS * H) if k.name == "gauss_markov")


def chosen(slow, rng):
    """White noise and a ``slow`` one (n,), for which a Gauss-Markov process was chosen."""
    time, none = np.arange(N_ROWS) * H, np.zeros(N_ROWS)
    r = np.sqrt(WHITE) * rng.standard_normal(N_ROWS) + slow
    made = bands([Rows(time, r, none, none, H, N_ROWS)])
    base = made.density(WHITE * H, 0.0, (), 0.0)
    column = MARKOV.in_bands(made, {"tau": TAU})[None]
    cells = Cells(made.count, made.squares, base, column, np.zeros(1))
    axis = Axis(made, cells, None, np.zeros((0, 0)), {})
    return State({0: axis}, {0: (Term(MARKOV, {"tau": TAU}, 0),)})


def markov(variance, rng):
    kept = np.exp(-H / TAU)
    new = np.sqrt(variance * (1 - kept**2)) * rng.standard_normal(N_ROWS)
    return lfilter([1.0], [1.0, -kept], new)


def test_noise_of_the_chosen_kind_has_its_spectrum():
    """The chance is one: below 1e-3 it falls in a thousandth of the draws at most."""
    rng = np.random.default_rng(7)
    state, draws, seen = chosen(markov(0.1, rng), rng), 300, 0
    cells = state.axes[0].spectrum
    for squares in cells.drawn(cells.fit()[0], draws, rng):
        axis = replace(state.axes[0], spectrum=replace(cells, squares=squares))
        seen += bool(misfits_of(SimpleNamespace(state=State({0: axis}, state.found))))
    assert seen <= binom.ppf(1 - 1e-6, draws, 1e-3)


@pytest.mark.parametrize("hz", [0.2, 1.0])
def test_a_line_whose_frequency_wanders_is_no_gauss_markov_process(hz):
    """A sine of the same variance, which goes astray by a turn in ten seconds."""
    rng = np.random.default_rng(11)
    cycles = np.cumsum(hz * H + 0.1 * np.sqrt(H) * rng.standard_normal(N_ROWS))
    state = chosen(np.sqrt(0.2) * np.sin(2 * np.pi * cycles), rng)
    (found,) = misfits_of(SimpleNamespace(state=state)).values()
    assert found.share > 0.25
    assert found.ratio > 1.0
    # An octave's mean, of a line within it.
    assert hz / 2 < found.hz < 2 * hz
    assert f"{found.hz:.2g} Hz" in found.shape
