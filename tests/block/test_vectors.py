"""The C with names and with vectors gives the bits of casadi's virtual machine, whatever numbers
come; vectors are found where operations are alike, and in an order in which they can be made.
"""

import casadi as ca
import numpy as np
import pytest

import pyimu
from pyimu.attitude import attitude_ukf
from pyimu.block import compiled as native
from pyimu.block.alike import VECTOR, Alike
from pyimu.block.block import Block
from pyimu.block.c_code import c_code
from pyimu.block.program import UNARY, program
from pyimu.block.stepping import step_through
from pyimu.block.straight import SPELLED, straight
from pyimu.block.unit_order import _needs, ordered
from pyimu.block.variables import Variable
from pyimu.block.vector_cost import Cost
from pyimu.block.vector_plan import Cycle, Plan
from pyimu.block.vectors import LEAST_GAIN, _extended, chosen, vectors

SPECIAL = [0.0, -0.0, 1.0, -1.0, 0.5, -3.25, np.inf, -np.inf, np.nan, 5e-324, 1e308, -1e-310]

needs_vectors = pytest.mark.skipif(
    not native.compiler_command() or not native._has_vectors(tuple(native.compiler_command())),
    reason="no compiler here, or no registers for vectors of four",
)


def planned(function):
    alike, sizes = Alike(program(function)), [function.nnz_in(k) for k in range(function.n_in())]
    return Plan(alike, {}, sizes), Plan(alike, chosen(alike, sizes), sizes)


def of_every_operation():
    """Each operation on three and four neighbours, and on a mixture that no vector has as it is."""
    x = ca.SX.sym("x", 8)
    out = []
    for op in sorted(SPELLED):
        for lanes in ([0, 1, 2, 3], [4, 5, 6], [5, 0, 7]):
            for k in lanes:
                if op in UNARY:
                    out.append(ca.SX.unary(op, x[k]))
                else:
                    out.append(ca.SX.binary(op, x[k], x[(k + 1) % 8]))
    y = ca.vertcat(*out)
    return ca.Function(
        "step", [ca.SX.sym("s"), x, *(ca.SX.sym(n, n == "h") for n in "pwh")], [ca.SX(1), y]
    )


def block_of(step):
    names = [
        tuple(Variable(f"{n}[{i}]") for i in range(k))
        for n, k in (("u", 8), ("p", 0), ("y", step.numel_out(1)))
    ]
    u, p = ca.SX.sym("u", 8), ca.SX.sym("p", 0)
    initial = ca.Function("initial", [u, p], [ca.SX.zeros(1), ca.SX.zeros(step.numel_out(1))])
    return Block("Each", "", step, initial, *names, (), 0.01)


@pytest.fixture(params=[False, pytest.param(True, marks=needs_vectors)], ids=["names", "vectors"])
def body(request, tmp_path, monkeypatch):
    for name in ("LOOKED_FOR", "WORTHWHILE"):
        monkeypatch.setattr(native, name, 0)
    monkeypatch.setenv("PYIMU_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(native, "_has_vectors", lambda compiler: request.param)
    native._machine_code.cache_clear()
    native._loaded.clear()
    yield
    native._machine_code.cache_clear()
    native._loaded.clear()


@pytest.mark.usefixtures("body")
def test_every_operation_gives_the_bits_of_the_virtual_machine():
    block = block_of(of_every_operation())
    rng = np.random.default_rng(1)
    u = rng.choice(SPECIAL, (400, 8))
    want = np.empty((400, len(block.outputs)))
    for few in (slice(0, 200), slice(200, 400)):  # of which casadi's own machine takes care
        rest = block.start, np.zeros((200, 0)), np.array([block.sample_period])
        step_through(block.step, np.zeros(1), u[few], *rest, want[few])
    y, _ = block.run(u)
    assert native._loaded
    np.testing.assert_array_equal(y, want)
    np.testing.assert_array_equal(np.signbit(y[~np.isnan(y)]), np.signbit(want[~np.isnan(want)]))


def test_every_operation_of_vectors_becomes_one():
    _, plan = planned(of_every_operation())
    made = {plan.alike.op[u.lanes[0]] for u in plan.units if u.kind == "computed"}
    assert made == {*VECTOR}


def test_vectors_take_a_quarter_off_the_usual_update():
    step = attitude_ukf(pyimu.part("imt30")).prepared.step
    (usual,) = (f for f in step.find_functions() if f.name() == "usual_update")
    numbers, both = planned(usual)
    assert both.cost < 0.76 * numbers.cost


def test_each_unit_follows_what_it_needs():
    step = attitude_ukf(pyimu.part("imt30")).prepared.step
    (function,) = (f for f in step.find_functions() if f.name() == "by_velocity")
    _, plan = planned(function)
    at = {id(unit): n for n, unit in enumerate(ordered(plan))}
    assert len(at) == len(plan.units)
    for unit, needs in zip(plan.units, _needs(plan), strict=True):
        assert all(at[id(plan.units[k])] < at[id(unit)] for k in needs)


def test_vectors_that_wait_for_each_other_are_refused():
    """A sum and its own operand in one vector."""
    x = ca.SX.sym("x", 5)
    inner = x[0] + x[1]
    sums = ca.vertcat(inner, inner + x[2], x[3] + x[4])
    alike = Alike(program(ca.Function("f", [x], [sums])))
    lanes = tuple(k for k, op in enumerate(alike.op) if op == ca.OP_ADD)
    choice = {k: (lanes, n) for n, k in enumerate(lanes)}
    with pytest.raises(Cycle):
        Plan(alike, choice, [5])
    assert not Cost(alike, {}, [5]).widened(choice, -100.0)


def test_the_cost_that_is_followed_is_that_of_the_plan():
    """From choice to choice, those that are not taken among them."""
    step = attitude_ukf(pyimu.part("imt30")).prepared.step
    (function,) = (f for f in step.find_functions() if f.name() == "by_velocity")
    alike, sizes = Alike(program(function)), [function.nnz_in(k) for k in range(function.n_in())]
    choice, taken = {}, []
    cost = Cost(alike, choice, sizes)
    for seed in (*alike.neighbours(), *alike.likenesses(choice)):
        if not any(k in choice for k in seed):
            wider = _extended(alike, choice, seed)
            taken.append(cost.widened(wider, LEAST_GAIN))
            choice = wider if taken[-1] else choice
            if len(taken) % 10 == 0:
                assert cost.total == pytest.approx(Plan(alike, choice, sizes).cost, rel=1e-9)
    assert 5 < sum(taken) < len(taken) - 5


def test_a_function_with_a_call_stays_as_casadi_writes_it():
    x = ca.SX.sym("x", 3)
    function = ca.Function("calls", [x], [ca.sin(x)])
    assert straight(function) is None and vectors(function) is None
    assert "sin(" in c_code("code", [function])


def test_a_name_that_two_functions_have_stays_as_casadi_writes_it():
    x = ca.SX.sym("x", 3)
    inner = [ca.Function("inner", [x], [y], {"never_inline": True}) for y in (x * 2, x * x + 1)]
    v = ca.MX.sym("v", 3)
    outer = ca.Function("outer", [v], [inner[0](v) + inner[1](v)])
    assert "restrict i0" not in c_code("code", [outer])


def test_what_is_handed_on_is_copied_by_fours_and_read_by_itself():
    """A result that is an input stands beside a vector of the same four numbers."""
    x = ca.SX.sym("x", 9)
    function = ca.Function("handed", [x], [x, x[:4] * x[4:8]])
    text = vectors(function)
    assert text.count("STORE4(o0+") == 2 and "o0[8]=i0[8];" in text
    lines = text.splitlines()
    (product,) = (
        n for n, line in enumerate(lines) if "*" in line.partition("=")[2] and "Vector4 p" in line
    )
    for name in lines[product].partition("=")[2].strip("; ").split("*"):
        assert any(f"Vector4 {name}=" in line for line in lines[:product])


def test_constants_that_stand_together_are_stored_by_fours():
    x = ca.SX.sym("x", 2)
    function = ca.Function(
        "constant", [x], [ca.densify(ca.vertcat(x[0] * x[1], ca.SX(9, 1), 2, x))]
    )
    assert vectors(function).count("STORE4(o0+") == 2
