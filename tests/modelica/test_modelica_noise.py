"""The normals in pure Modelica, and in the C that the library brings, are those of the units."""

import ctypes
import re
import shutil
import subprocess

import numpy as np
import pytest
from modelica_cases import LIBRARY, simulated, ulps, vector

from pyimu.block.normals import edges, normals

CHANNELS = (2**32 - 1, 7)
SEED = 2**31 - 1
DRAWS = 100

DRAW = """
model Draw
  output Real a;
  output Real b;
protected
  discrete Real k(start=0, fixed=true);
equation
  when sample(1, 1) then
    k = pre(k) + 1;
    a = PyImu.Noise.normal({seed}, {first}, {sample_a});
    b = PyImu.Noise.normal({seed}, {second}, {sample_b});
  end when;
end Draw;
"""


def drawn(count, seed, channels, samples=("k", "k")):
    text = DRAW.format(
        seed=seed,
        first=channels[0],
        second=channels[1],
        sample_a=samples[0],
        sample_b=samples[1],
    )
    rows = simulated("Draw", count, 1, text)
    return np.column_stack([rows["a"], rows["b"]])[1:]


def test_draws_are_those_of_the_units():
    """A hundred of two channels, which crosses every place in a block of four."""
    np.testing.assert_array_equal(drawn(DRAWS, SEED, CHANNELS), normals(SEED, CHANNELS, 1, DRAWS))


def beyond():
    """Numbers of the first samples of a channel whose word leaves its layer's rectangle, and of
    the first one in the tail: of such a word the layer is its lowest 8 bits.
    """
    words = np.random.Philox(key=[1, CHANNELS[1]]).random_raw(4000)
    layer = (words & 255).astype(int)
    odd = (words >> np.uint64(10) | np.uint64(1)).astype(np.int64) - (1 << 53)
    edge = edges()
    left = np.abs(odd * 2.0**-53 * edge[layer]) >= edge[layer + 1]
    wedge = np.flatnonzero(left & (layer > 0))[:10]
    return wedge.tolist(), int(np.flatnonzero(left & (layer == 0))[0])


def test_draws_beyond_the_layers_are_those_of_the_units():
    """Ten of a wedge, one of them at least refused, and one of the tail, whose last bit is that of
    the logarithm.
    """
    wedges, tail = beyond()
    chosen = " ".join(f"elseif k < {i + 1.5} then {k}" for i, k in enumerate((*wedges, tail)))
    chosen = f"if {chosen.removeprefix('elseif ')} else 0"
    got = drawn(len(wedges) + 1, 1, (CHANNELS[1], 1), (chosen, "k"))[:, 0]
    want = np.array([normals(1, [CHANNELS[1]], k, 1)[0, 0] for k in (*wedges, tail)])
    np.testing.assert_array_equal(got[:-1], want[:-1])
    assert ulps(got[-1], want[-1]) <= 1 and abs(want[-1]) > edges()[1]


@pytest.mark.skipif(shutil.which("cc") is None, reason="no C compiler")
def test_c_of_the_library_draws_the_same(tmp_path):
    """What ``external "C"`` includes is one file, which names the others beside it."""
    source = LIBRARY / "PyImu" / "Resources" / "C-Sources" / "pyimu_normal.c"
    shared = tmp_path / "normal.so"
    subprocess.run(
        ["cc", "-O2", "-shared", "-fPIC", "-o", shared, source, "-lm"], check=True, timeout=60
    )
    function = ctypes.CDLL(str(shared)).pyimu_normal
    function.restype, function.argtypes = ctypes.c_double, [ctypes.c_double] * 3
    got = [[function(SEED, c, k) for c in CHANNELS] for k in range(1, 1001)]
    np.testing.assert_array_equal(got, normals(SEED, CHANNELS, 1, 1000))


@pytest.mark.parametrize(
    ("block", "coefficient", "law"),
    [
        ("WhiteNoise", "N", lambda w, h: w / np.sqrt(h)),
        (
            "RateRandomWalk",
            "K",
            lambda w, h: np.vstack([np.zeros(3), np.cumsum(w, axis=0)[:-1] * np.sqrt(h)]),
        ),
    ],
)
def test_sources_are_their_noise(block, coefficient, law):
    """White noise and its sum, in closed form, to the rounding of that sum."""
    n, h = 12, 0.01
    given = f"{coefficient}={{0.1, 0.2, 0.3}}, seed=4, channel={{1, 2, 3}}"
    text = f"model Source PyImu.Noise.{block} noise({given}); end Source;"
    got = vector(simulated("Source", n * h, h, text), "noise.y")[1:]
    want = law(normals(4, [1, 2, 3], 1, n), h) * [0.1, 0.2, 0.3]
    np.testing.assert_allclose(got, want, rtol=0, atol=n * np.spacing(np.abs(want).max()))


def test_seed_by_the_instances_name_is_one_that_the_noise_takes():
    """Of any global seed and any hash, which are Integers of 32 bits: their sum is none. Sensors
    and noise sources have one formula; rumoca has no getInstanceName.
    """
    formulas = set()
    for name in ("Triad", "NoiseSource"):
        text = (LIBRARY / "PyImu" / "Interfaces" / f"{name}.mo").read_text()
        found = re.search(r"parameter Real seed\(min=0\) = (.*?)\n    \"", text, re.DOTALL)
        formulas.add(" ".join(found[1].split()))
    (formula,) = formulas
    assert "getInstanceName()" in formula and "globalSeed.seed" in formula
    formula = formula.replace("Modelica.Utilities.Strings.hashString(getInstanceName())", "hash")
    formula = formula.replace("globalSeed.seed", "own")
    cases = [(0, 0), (2**31 - 1, 2**31 - 1), (0, -(2**31)), (5, -9), (2**31 - 1, 1), (5, 9)]
    lines = [f"S s{i}(own={own}, hash={hashed});" for i, (own, hashed) in enumerate(cases)]
    block = (
        f"block S parameter Real own; parameter Real hash; Real y; equation y = {formula}; end S;"
    )
    rows = simulated("T", 1.0, 1.0, "\n".join(["model T", block, *lines, "end T;"]))
    want = [(own + hashed) % (2**31 - 1) for own, hashed in cases]
    assert [rows[f"s{i}.y"][0] for i in range(len(cases))] == want and min(want) >= 0


def test_ramp_grows_with_the_time_of_the_sample():
    text = "PyImu.Noise.Ramp noise(samplePeriod=0.1, R={1, -2, 3});"
    rows = simulated("Source", 0.5, 0.1, f"model Source {text} end Source;")
    want = np.outer(np.arange(1, 6) * 0.1, [1.0, -2.0, 3.0])
    np.testing.assert_allclose(vector(rows, "noise.y")[1:], want, rtol=1e-15)
