"""The package's own machine for steps: its bits are those of casadi's."""

import casadi as ca
import numpy as np
import pytest

from pyimu.attitude import attitude_ukf
from pyimu.block.machine import machine
from pyimu.block.stepping import FEW, step_through
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.chain import chain_of
from pyimu.model.part_file import part as find_part
from pyimu.model.signals import N_INPUT

H = np.array([0.01])
CASES = [(e.name, kind) for e in CATALOGUE.values() for kind in sorted(e.sensors)]


def by_both(step, s, u, p, w):
    """Outputs (n, ny) and last state by this machine, and by casadi's, which takes a few rows."""
    found, want = (np.empty((len(u), step.numel_out(1))) for _ in range(2))
    last, expected = s.copy(), s.copy()
    machine(step).run(last, u, p, w, H, found)
    for k in range(0, len(u), FEW):
        rows = slice(k, k + FEW)
        step_through(step, expected, u[rows], p, w[rows], H, want[rows])
    return (found, last), (want, expected)


@pytest.mark.parametrize(("name", "kind"), CASES)
def test_steps_of_every_effect_equal_casadis_machine_bit_for_bit(name, kind):
    rng, chain = np.random.default_rng(1), chain_of(kind, (CATALOGUE[name],))
    u, w = rng.standard_normal((300, N_INPUT)), rng.standard_normal((300, len(chain.noise)))
    p = np.abs(rng.standard_normal(len(chain.slots))) * (rng.random(len(chain.slots)) < 0.8)
    found, want = by_both(chain.step, chain.start.copy(), u, p, w)
    np.testing.assert_array_equal(found[0], want[0])
    np.testing.assert_array_equal(found[1], want[1])


def test_every_operation_equals_casadis_machine():
    """Where the C library has a function the bits are its, to the last but one."""
    x = ca.SX.sym("x", 2)
    a, b = x[0], x[1]
    one = (ca.exp, ca.log, ca.sqrt, ca.sin, ca.cos, ca.tanh, ca.floor, ca.ceil, ca.fabs, ca.sign)
    two = (ca.eq, ca.ne, ca.logic_and, ca.logic_or, ca.fmin, ca.fmax, ca.atan2, ca.copysign)
    made = [*(f(a) for f in (*one, ca.logic_not, ca.expm1)), *(f(a, b) for f in two)]
    made += [a * a, 2 * a, 1 / a, -a, a + b, a - b, a * b, a / b, a**b, a**2.5, a < b, a <= b]
    s, none, h = ca.SX.sym("s"), ca.SX.sym("none", 0), ca.SX.sym("h")
    step = ca.Function("f", [s, x, none, none, h], [s + a, ca.densify(ca.vertcat(*made))])
    corners = [[p, q] for p in (-0.5, 0.0, 2.0, np.inf, np.nan) for q in (-1.0, 0.0, 0.5, np.nan)]
    u = np.concatenate([np.random.default_rng(1).uniform(-2, 3, (50, 2)), corners])
    found, want = by_both(step, np.zeros(1), u, np.zeros(0), np.zeros((len(u), 0)))
    np.testing.assert_allclose(found[0], want[0], rtol=2.3e-16, atol=0)


def test_a_step_that_it_does_not_know_is_left_to_casadi():
    s, none, x, h = ca.SX.sym("s"), ca.SX.sym("none", 0), ca.SX.sym("x"), ca.SX.sym("h")
    step = ca.Function("f", [s, x, none, none, h], [s, ca.erf(x)])
    assert machine(step) is None
    u, y = np.linspace(-1, 1, 2 * FEW)[:, None], np.empty((2 * FEW, 1))
    step_through(step, np.zeros(1), u, np.zeros(0), np.zeros((2 * FEW, 0)), H, y)
    np.testing.assert_allclose(y[:, 0], [float(ca.erf(v)) for v in u[:, 0]], rtol=1e-15)


def test_a_function_of_functions_is_left_to_casadi():
    assert machine(attitude_ukf(find_part("imt30")).step) is None
