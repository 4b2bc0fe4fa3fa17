"""The printed effects give the values of their definitions, sample by sample."""

import numpy as np
import pytest
from catalogue_cases import CASES, excited, run
from modelica_cases import LAST_PLACES, simulated, ulps, vector

from pyimu.model.effects import EFFECTS
from pyimu.model.kinds import KINDS
from pyimu.model.signals import COLUMNS, N_INPUT, SIGNALS
from pyimu.modelica.bench import AMPLITUDES, NORMALS, PERIOD, SAMPLES, bench_text, excite, typical
from pyimu.modelica.effect_functions import effect_functions, signal_of
from pyimu.modelica.names import pascal

TRANSCENDENTAL = ("exp(", "log(", "sin(", "cos(", "expm1(")
"""Functions of which two libraries may give values that differ in the last bit."""

SHARES = {"angle_quantization": 0.005, "hard_dead_zone": 0.15, "saturation": 0.03}
"""Coefficients in a share of the natural size where the usual one, 0.05, would hide the effect: a
step of the angle must be less than a sample turns, a limit must lie within the input's range.
"""

CHANGES = {"bias_step": {"t0": [0.1, 0.15, 0.2, 0.3]}}
"""Coefficients by which an effect shows itself within a bench's 0.4 s."""


def expected(sensor):
    """Output (n, 3) of the definition to what a bench feeds it."""
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
    w = excite(k, np.zeros(n), NORMALS, 7) if n else None
    return run(sensor, u, w=w, h=PERIOD)


def compare(sensor, rows):
    """The rows of a bench are those of the definition, and the effect is not idle in it."""
    (e,) = sensor.effects
    got, want = vector(rows, "effect.y")[1:], expected(sensor)
    x = vector(rows, "effect.x")[1:]
    assert np.all(np.any(want != x, axis=0))
    text = "".join(line for f in effect_functions(e).all for line in f.lines)
    if any(word in text for word in TRANSCENDENTAL):
        assert ulps(got, want, x) <= LAST_PLACES
    else:
        np.testing.assert_array_equal(got, want)


@pytest.mark.parametrize(("name", "kind"), CASES)
def test_effect_gives_the_values_of_its_definition(name, kind):
    """Each coefficient with another value, matrices without symmetry."""
    sensor = excited(name, kind, SHARES.get(name, 0.05))
    sensor = sensor.with_values(name, **CHANGES.get(name, {}))
    model = f"{pascal(name)}Of{pascal(kind)}"
    rows = simulated(model, SAMPLES * PERIOD, PERIOD, bench_text(sensor, model, within=""))
    compare(sensor, rows)


@pytest.mark.parametrize("e", EFFECTS, ids=lambda e: e.name)
def test_bench_of_the_library_runs(e):
    rows = simulated(f"PyImu.Examples.Benches.{pascal(e.name)}", SAMPLES * PERIOD, PERIOD)
    got, want = vector(rows, "effect.y")[1:], expected(typical(e, e.sensors[0]))
    assert ulps(got, want, vector(rows, "effect.x")[1:]) <= LAST_PLACES
