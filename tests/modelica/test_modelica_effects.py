"""The printed effects give the values of their definitions, sample by sample."""

import casadi as ca
import numpy as np
import pytest
from catalogue_cases import CASES, excited, run
from modelica_cases import LAST_PLACES, LIBRARY, simulated, ulps, vector

from pyimu.model.catalogue import CATALOGUE
from pyimu.model.effects import EFFECTS
from pyimu.model.kinds import KINDS
from pyimu.model.signals import COLUMNS, N_INPUT, SIGNALS
from pyimu.modelica.bench import AMPLITUDES, NORMALS, PERIOD, SAMPLES, bench_text, excite, typical
from pyimu.modelica.effect_functions import effect_functions, signal_of
from pyimu.modelica.graph import OPERATIONS
from pyimu.modelica.names import identifier, pascal
from pyimu.modelica.text import numbers

TRANSCENDENTAL = ("exp(", "log(", "sin(", "cos(", "expm1(")
"""Functions of which two libraries may give values that differ in the last bit."""

SHARES = {"angle_quantization": 0.005, "hard_dead_zone": 0.15, "saturation": 0.03}
"""Coefficients in a share of the natural size where the usual one, 0.05, would hide the effect: a
step of the angle must be less than a sample turns, a limit must lie within the input's range.
"""

CHANGES = {"bias_step": {"t0": [0.1, 0.15, 0.2, 0.3]}}
"""Coefficients by which an effect shows itself within a bench's 0.4 s."""


OTHERS = {
    "lag": [{"zeta": 1.5}, {"wn": 0.0}],
    "quantization": [{"q": [0.0, 0.0, 0.0]}],
    "angle_quantization": [{"q": [0.0, 0.0, 0.0]}],
    "time_delay": [{"td": d * PERIOD} for d in (0.0, *np.arange(0.5, 30.0, 2.0).tolist(), 30.0)],
}
"""Coefficients by which an effect takes the ways that it does not take with its own."""

NEVER = {"bias_instability": 2, "time_delay": 9}
"""Choices that fall to one side for every coefficient that the limits allow: clamps, and of a delay
the signs and weights of samples that are not between the shortest and the longest one.
"""


def driven(sensor):
    """All signals (n, N_INPUT) and the normals (n, nw) that a bench feeds a sensor."""
    (e,) = sensor.effects
    k = np.arange(1, SAMPLES + 1)
    u = np.zeros((SAMPLES, N_INPUT))
    own = KINDS[sensor.kind].own
    shifts = {own: 0}
    for shift, argument in enumerate(e.environment, 1):
        shifts[signal_of(e, argument, sensor.kind)] = shift
    for name, shift in shifts.items():
        start = np.array(SIGNALS[name].start)
        u[:, COLUMNS[name]] = (
            k[:, None] * PERIOD if name == "time" else excite(k, start, AMPLITUDES[name], shift)
        )
    n = len(sensor.noise)
    return u, excite(k, np.zeros(n), NORMALS, 7) if n else None


def expected(sensor):
    """Output (n, 3) of the definition to what a bench feeds it."""
    u, w = driven(sensor)
    return run(sensor, u, w=w, h=PERIOD)


def own_sensor(name, kind):
    """Each coefficient with another value, matrices without symmetry."""
    sensor = excited(name, kind, SHARES.get(name, 0.05))
    return sensor.with_values(name, **CHANGES.get(name, {}))


def sensors():
    """Every sensor of one effect, with its own coefficients and with others, by a name."""
    found = {(name, kind, 0): own_sensor(name, kind) for name, kind in CASES}
    for name, others in OTHERS.items():
        kind = CATALOGUE[name].sensors[0]
        for i, changes in enumerate(others, 1):
            found[name, kind, i] = own_sensor(name, kind).with_values(name, **changes)
    return found


SENSORS = sensors()


@pytest.fixture(scope="module")
def own_rows():
    """Of the bench of each sensor; all in one model, as compiling the library takes longer than
    running it.
    """
    benches = {f"{pascal(n)}{i}Of{pascal(k)}": s for (n, k, i), s in SENSORS.items()}
    texts = [bench_text(sensor, bench, within="") for bench, sensor in benches.items()]
    classes = [text[text.index("model ") :] for text in texts]
    parts = [f"{bench} b{i};" for i, bench in enumerate(benches)]
    text = "\n".join(["model All", *classes, *parts, "end All;"])
    rows = simulated("All", SAMPLES * PERIOD, PERIOD, text)
    return {case: of(rows, f"b{i}") for i, case in enumerate(SENSORS)}


@pytest.fixture(scope="module")
def library_rows():
    """Of each bench of the library, all in one model, too."""
    parts = [f"PyImu.Examples.Benches.{pascal(e.name)} b{i};" for i, e in enumerate(EFFECTS)]
    rows = simulated("All", SAMPLES * PERIOD, PERIOD, "\n".join(["model All", *parts, "end All;"]))
    return {e.name: of(rows, f"b{i}") for i, e in enumerate(EFFECTS)}


def of(rows, block):
    """Input and output (n, 3) of the effect in one bench."""
    return tuple(vector(rows, f"{block}.effect.{name}")[1:] for name in "xy")


@pytest.mark.parametrize(("name", "kind", "number"), SENSORS)
def test_effect_gives_the_values_of_its_definition(name, kind, number, own_rows):
    """And, with its own coefficients, is not idle in its bench."""
    (x, got), want = own_rows[name, kind, number], expected(SENSORS[name, kind, number])
    assert number or np.all(np.any(want != x, axis=0))
    printed = effect_functions(CATALOGUE[name]).all
    text = "".join(line for f in printed for line in f.lines)
    if any(word in text for word in TRANSCENDENTAL):
        assert ulps(got, want, x) <= LAST_PLACES
    else:
        np.testing.assert_array_equal(got, want)


def choices(function):
    """The choices of a casadi function as one of its symbols: conditions, signs and orders.

    The test whether a number is one, which Modelica does not need, is none, nor is what follows
    from it.
    """
    given = [ca.SX.sym(function.name_in(i), function.sparsity_in(i)) for i in range(5)]
    work, decided, found, after_test = {}, {}, [], set()
    for i in range(function.n_instructions()):
        op = OPERATIONS[function.instruction_id(i)]
        of, to = function.instruction_input(i), function.instruction_output(i)
        if op == "OUTPUT":
            continue
        if op in ("INPUT", "CONST"):
            value = given[of[0]].nz[of[1]] if op == "INPUT" else function.instruction_constant(i)
            work[to[0]], known = ca.SX(value), None
        else:
            args, arity = [work[j] for j in of], 1 if op in UNARY else 2
            apply = ca.SX.unary if arity == 1 else ca.SX.binary
            args, knowns = args[:arity], [decided.get(j) for j in of[:arity]]
            work[to[0]] = apply(function.instruction_id(i), *args)
            known = follows(op, args, knowns)
            if known and op in ("LE", "LT"):
                after_test.add(len(found) - 1)
            if op == "IF_ELSE_ZERO" and knowns[0] is None:
                found.append(args[0])
            elif op in ("FABS", "SIGN"):
                found.append(args[0] < 0)
            elif op in ("FMIN", "FMAX"):
                found.append(args[0] < args[1])
        decided[to[0]] = known
    kept = [c for i, c in enumerate(found) if i not in after_test]
    return ca.Function("choices", given, [ca.vertcat(*kept)]) if kept else None


UNARY = {"ASSIGN", "NEG", "NOT", "FABS", "SIGN", "SQRT", "SQ", "TWICE", "EXP", "EXPM1", "LOG"} | {
    "SIN",
    "COS",
    "INV",
    "FLOOR",
    "CEIL",
}


def follows(op, args, knowns):
    """What is known of a result: that a number is one, and what follows from that."""
    if op in ("LE", "LT"):
        return True if args[1].is_constant() and float(args[1]) == np.inf else None
    if op == "ASSIGN":
        return knowns[0]
    if op == "NOT":
        return None if knowns[0] is None else not knowns[0]
    if op in ("AND", "OR"):
        ruling = op == "OR"
        if ruling in knowns:
            return ruling
        return None if None in knowns else not ruling
    return None


@pytest.mark.parametrize("name", CATALOGUE)
def test_benches_take_every_way_through_an_effect(name):
    """Both signs, inside and outside of a limit, the first sample and those after it, switched on
    and off: every choice falls to either side in one of the benches above.
    """
    taken = []
    for (of, _, _), sensor in SENSORS.items():
        if of != name:
            continue
        chosen = choices(sensor.step)
        if chosen is None:
            return
        u, w = driven(sensor)
        s, w = np.array(sensor.chain.start), np.zeros((SAMPLES, 0)) if w is None else w
        for k in range(SAMPLES):
            given = (s, u[k], sensor.p, w[k], PERIOD)
            taken.append(np.array(chosen(*given)).ravel() != 0)
            s = sensor.step(*given)[0]
    idle = np.all(taken, axis=0) | ~np.any(taken, axis=0)
    assert idle.sum() == NEVER.get(name, 0)


@pytest.mark.parametrize("e", EFFECTS, ids=lambda e: e.name)
def test_bench_of_the_library_runs(e, library_rows):
    (x, got), want = library_rows[e.name], expected(typical(e, e.sensors[0]))
    assert ulps(got, want, x) <= LAST_PLACES


def test_a_bench_compiles_alone():
    rows = simulated("PyImu.Examples.Benches.GaussMarkov", SAMPLES * PERIOD, PERIOD)
    (e,) = [e for e in EFFECTS if e.name == "gauss_markov"]
    want = expected(typical(e, "gyro"))
    assert ulps(vector(rows, "effect.y")[1:], want, vector(rows, "effect.x")[1:]) <= LAST_PLACES


LINES = {**AMPLITUDES, "time": 1.0}
"""Slopes of the straight lines along which signals go."""


def test_effects_without_memory_are_continuous_as_well():
    """The same functions at every instant, without a sample: one of each, along straight lines."""
    cases = [(n, k) for n, k in CASES if is_continuous(n) and k == CATALOGUE[n].sensors[0]]
    assert len(cases) > 15
    lines, equations, inputs = [], [], {}
    for i, (name, kind) in enumerate(cases):
        sensor = own_sensor(name, kind)
        values = ", ".join(
            f"{identifier(n)}={numbers(v.tolist())}" for n, v in sensor.values[name].items()
        )
        lines.append(f"PyImu.Effects.{pascal(name)}.{pascal(kind)}Continuous e{i}({values});")
        own = KINDS[kind].own
        for j, (argument, signal) in enumerate(
            [("x", own), *((a, signal_of(CATALOGUE[name], a, kind)) for a in e_arguments(name))]
        ):
            start, size = SIGNALS[signal].start, LINES[signal]
            rows = [
                f"{s!r} + {size}*({(-1) ** k * (k + j + 1)}*time - 1)" for k, s in enumerate(start)
            ]
            given = "{" + ", ".join(rows) + "}" if len(start) > 1 else rows[0]
            equations.append(f"e{i}.{identifier(argument) if j else 'x'} = {given};")
            inputs[i, signal] = (j, start, size)
    text = "\n".join(["model All", *lines, "equation", *equations, "end All;"])
    t, period = np.arange(9) * 0.125, 0.125
    rows = simulated("All", 1.0, period, text)
    for i, (name, kind) in enumerate(cases):
        u = np.zeros((len(t), N_INPUT))
        for (of, signal), (j, start, size) in inputs.items():
            if of == i:
                slopes = [(-1.0) ** k * (k + j + 1) for k in range(len(start))]
                u[:, COLUMNS[signal]] = np.array(start) + size * (np.outer(t, slopes) - 1)
        want = run(own_sensor(name, kind), u, h=period)
        got, x = vector(rows, f"e{i}.y"), vector(rows, f"e{i}.x")
        assert ulps(got, want, x) <= LAST_PLACES, name


def is_continuous(name):
    """Whether an effect has a form without samples."""
    path = LIBRARY / "PyImu" / "Effects" / f"{pascal(name)}.mo"
    return "Continuous" in path.read_text()


def e_arguments(name):
    """Signals that an effect depends on, by its own names."""
    return list(CATALOGUE[name].environment)
