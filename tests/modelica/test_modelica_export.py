"""A part of one's own as a Modelica class, and what the command says of one that has none."""

import re
import subprocess
import sys

import numpy as np
import pytest
from catalogue_cases import as_part, everything
from modelica_cases import LAST_PLACES, measured, simulated, ulps
from places import same_path

from pyimu.errors import UserError
from pyimu.model.catalogue import CATALOGUE, add_effects
from pyimu.model.part_file import part as find_part
from pyimu.model.signals import SIGNALS, inputs_for
from pyimu.modelica.bench import AMPLITUDES, excite
from pyimu.modelica.export import export
from pyimu.modelica.names import camel
from pyimu.modelica.part_text import part_text

SAMPLES = 40


def bench(part, name):
    """A model that gives a part other inputs at each sample, and these inputs (n, nu)."""
    k, h = np.arange(1, SAMPLES + 1), part.sample_period
    lines, connections, columns = [f"{name}.Imu imu(seed=3);"], [], []
    for shift, signal in enumerate(inputs_for(part.signals)):
        start = np.array(SIGNALS[signal].start)
        size = AMPLITUDES.get(signal, 0.2)
        columns.append(excite(k, start, size, shift))
        values = "{" + ", ".join(map(repr, start.tolist())) + "}"
        lines.append(
            f"PyImu.Examples.Excitation {camel(signal)}(samplePeriod={h!r}, n={len(start)}, "
            f"shift={shift}, amplitude=fill({size}, {len(start)}), offset={values});"
        )
        element = "" if len(start) > 1 else "[1]"
        connections.append(f"connect({camel(signal)}.y{element}, imu.{camel(signal)});")
    text = "\n".join(["model Bench", *lines, "equation", *connections, "end Bench;"])
    return text, np.hstack(columns)


def compare(part, name, text, tolerance=LAST_PLACES):
    model, u = bench(part, name)
    rows = simulated("Bench", SAMPLES * part.sample_period, part.sample_period, text + model)
    got = measured(rows)[1:]
    want = part.block.run(u, seed=3)[0]
    assert ulps(got, want, u[:, :7]) <= tolerance
    return got


def test_every_signal_reaches_its_effects():
    """All effects without noise in one chain; an error of the last place in one grows in those
    behind it by their slopes, of which none is above 2, and through 40 of them.
    """
    quiet = [
        everything(kind).without(
            *(e.name for e in CATALOGUE.values() if e.stochastic or not e.smooth)
        )
        for kind in ("gyro", "accel")
    ]
    part = as_part(*quiet)
    compare(part, "Test", part_text(part), 40 * LAST_PLACES)


# The command

EFFECT = """
import casadi as ca
from pyimu import Environment, Parameter, State, effect

@effect(stage="gain", term="a wobble", equation="y = x + a T b x", source="none")
def {name}(
    x,
    a: Parameter("1/K", ()),
    max: Parameter("1", ()),
    T: Environment("temperature"),
    b: State("1", ()),
):
    return x + a * {call} * b * x + max * ca.fmax(x, 0), {{"b": b + 1}}
"""

PART = """
name = "my-part 3"
sample_rate = {value = 100.0, unit = "Hz"}

[gyro.wobble]
a = {value = 0.01, unit = "1/K", source = "a guess"}
max = {value = 0.25, unit = "1", source = "a name that Modelica knows"}

[gyro.saturation]
limit = {value = 1.5, unit = "rad/s"}

[accel.magnetic_sensitivity]
C = {value = [[1.0, 2.0, 3.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], unit = "m/s^2/T"}
"""


def command(folder, call, part=PART):
    """``pyimu modelica`` with a part and an effect of one's own."""
    (folder / "part.toml").write_text(part)
    (folder / "effects.py").write_text(EFFECT.format(call=call, name="wobble"))
    words = ["part.toml", "--effects", "effects.py", "--out", "out"]
    return subprocess.run(
        [sys.executable, "-m", "pyimu", "modelica", *words],
        cwd=folder,
        env=same_path(),
        capture_output=True,
        text=True,
        timeout=120,
    )


@pytest.fixture
def own_effect(request, tmp_path):
    """The effect as this process knows it, for as long as a test lasts."""
    path = tmp_path / "own_effects.py"
    given = getattr(request.node, "callspec", None)
    path.write_text(EFFECT.format(call=given.params["call"] if given else "T", name="wobble"))
    (added,) = add_effects(path)
    yield added
    CATALOGUE.remove(added.name)


def test_command_writes_a_part_with_an_effect_of_ones_own(tmp_path, own_effect):
    done = command(tmp_path, "T")
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.split() == ["out/MyPart3.mo"]
    text = (tmp_path / "out" / "MyPart3.mo").read_text()
    assert text.startswith('within ;\npackage MyPart3 "') and "a: a guess" in text
    compare(find_part(tmp_path / "part.toml"), "MyPart3", text, 0)


def test_what_has_no_modelica_form_is_refused_in_a_line(tmp_path):
    done = command(tmp_path, "ca.erf(T)")
    assert done.returncode == 2 and done.stdout == ""
    assert done.stderr.startswith("pyimu: effect wobble: its function uses erf, which cannot be")
    assert done.stderr.count("\n") == 1 and not list(tmp_path.rglob("*.mo"))


@pytest.mark.parametrize(
    ("call", "part", "said"),
    [
        ("T", PART.replace("0.01", '"estimate"', 1), "part my-part 3: gyro.wobble.a is left"),
        ("ca.inf", PART, "effect wobble: its function uses the constant inf"),
        ("ca.log1p(T)", PART, "effect wobble: its function uses log1p, which cannot be said"),
        ("(ca.inf - ca.inf)", PART, "effect wobble: its function uses the constant nan"),
        ("T", PART.replace("my-part 3", "py_imu"), "part py_imu: as a Modelica class it would be"),
        ("T", "", "part.toml: "),
    ],
)
def test_nothing_is_written_of_a_part_that_is_refused(call, part, said, tmp_path, own_effect):
    """As the command does, without its start."""
    (tmp_path / "part.toml").write_text(part)
    with pytest.raises(UserError, match=re.escape(said)):
        export(tmp_path / "part.toml", tmp_path / "out")
    assert not (tmp_path / "out").exists() or not list((tmp_path / "out").iterdir())


def test_effect_that_would_be_called_as_a_class_of_the_part_is_refused(tmp_path):
    path = tmp_path / "own_effects.py"
    path.write_text(EFFECT.format(call="T", name="gyroscope"))
    (added,) = add_effects(path)
    try:
        (tmp_path / "part.toml").write_text(PART.replace("gyro.wobble", "gyro.gyroscope"))
        with pytest.raises(UserError, match="effect gyroscope: as a Modelica class it would be"):
            export(tmp_path / "part.toml", tmp_path / "out")
    finally:
        CATALOGUE.remove(added.name)
