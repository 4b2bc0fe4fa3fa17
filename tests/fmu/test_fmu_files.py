"""What is in an FMU: its description, its libraries, its sources; and what happens when it cannot
be built.
"""

import re
import shutil
import subprocess
import tempfile
import zipfile
from dataclasses import replace
from importlib.util import find_spec
from io import BytesIO
from pathlib import Path

import casadi as ca
import fmpy
import numpy as np
import pytest
from built import built
from fmpy import read_model_description
from fmpy.validation import validate_fmu
from fmu_toy import Unit, drive, toy
from lxml import etree

from pyimu.block.block import Block
from pyimu.block.normals import normals
from pyimu.block.variables import Limits, NoiseChannel, Variable
from pyimu.errors import UserError
from pyimu.files import check_folder
from pyimu.fmu import (
    FORMS,
    PLATFORMS,
    build,
    build_fmu,
    build_fmus,
    host_platform,
    simulate,
    simulate_blocks,
    source_folder,
    texts,
    write_generated,
)
from pyimu.fmu.build import FLAGS, header_folder, icon
from pyimu.fmu.package import BLOCKS
from pyimu.fmu.sources import DESCRIPTION, PAGE, TERMINALS
from pyimu.model.part import Part, Sensor
from pyimu.model.part_file import part

BLOCK = toy()
SCHEMAS = Path(fmpy.__file__).parent / "schema"


@pytest.fixture(scope="session")
def toys(tmp_path_factory):
    return built(BLOCK, tmp_path_factory)


@pytest.fixture(params=FORMS, ids=("fmi2", "fmi3", "block"))
def path(request, toys):
    return toys[request.param]


@pytest.fixture(params=(2, 3), ids=("fmi2", "fmi3"))
def description(request, toys):
    """Of a scalar form."""
    return read_model_description(str(toys[request.param]))


def form_of(path):
    return "block" if ".block." in path.name else int(path.name[-5])


def version_of(path):
    return 2 if form_of(path) == 2 else 3


def unzipped(path, folder):
    with zipfile.ZipFile(path) as archive:
        archive.extractall(folder)
    return folder


def told(*command):
    """What a command prints."""
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


# The model description


def test_fmpy_finds_nothing(path):
    assert validate_fmu(str(path)) == []


@pytest.mark.parametrize("form", (3, "block"))
@pytest.mark.parametrize(
    "name, schema",
    (
        ("sources/buildDescription.xml", "fmi3BuildDescription.xsd"),
        ("terminalsAndIcons/terminalsAndIcons.xml", "fmi3TerminalsAndIcons.xsd"),
    ),
)
def test_fmi_3_files_follow_their_schema(toys, form, name, schema):
    with zipfile.ZipFile(toys[form]) as archive:
        document = etree.parse(BytesIO(archive.read(name)))
    etree.XMLSchema(etree.parse(str(SCHEMAS / "fmi3" / schema))).assertValid(document)


def test_variables_are_the_blocks(description):
    rows = {v.name: (v.causality, v.variability, v.start) for v in description.modelVariables}
    assert list(rows) == [
        "time",
        *(v.name for v in BLOCK.inputs + BLOCK.parameters + BLOCK.outputs),
        "sample_period",
        "seed",
    ]
    assert rows["temperature"] == ("input", "continuous", "25.0")
    assert rows["counting"] == ("input", "discrete", "true")
    assert rows["gear"] == ("input", "discrete", "1")
    assert rows["M[2,1]"] == ("parameter", "tunable", "-0.5")
    assert rows["sample_period"] == ("parameter", "fixed", repr(1 / 976))
    assert rows["y[1]"] == ("output", "discrete", None)
    assert float(description.defaultExperiment.stepSize) == BLOCK.sample_period


def test_bounds_are_told(description):
    bounds = {v.name: (v.min, v.max) for v in description.modelVariables}
    assert bounds["noise.N"] == ("0.0", None) and bounds["gear"] == ("-9", None)


def test_units_have_base_units(description):
    units = {u.name: u.baseUnit for u in description.unitDefinitions}
    assert set(units) == {"1", "degC", "rad/s", "rad/s/sqrt(s)", "rad/sqrt(s)", "s"}
    assert (units["rad/s"].rad, units["rad/s"].s, units["rad/s"].factor) == (1, -1, 1.0)
    assert (units["degC"].K, units["degC"].offset) == (1, 273.15)
    assert units["rad/sqrt(s)"] is None and units["rad/s/sqrt(s)"] is None


@pytest.mark.parametrize(
    "unit, base",
    (
        ("V", {"kg": 1, "m": 2, "s": -3, "A": -1}),
        ("T", {"kg": 1, "s": -2, "A": -1}),
        ("g", {"m": 1, "s": -2, "factor": 9.80665}),
        ("rad/s/K", {"rad": 1, "s": -1, "K": -1}),
    ),
)
def test_units_in_si(unit, base):
    tree = etree.fromstring(texts(toy(unit=unit))["modelDescription.fmi3.xml"].encode())
    (element,) = tree.xpath(f"//Unit[@name='{unit}']/BaseUnit")
    assert {k: float(v) for k, v in element.attrib.items()} == base


@pytest.mark.parametrize("form", FORMS, ids=("fmi2", "fmi3", "block"))
def test_units_in_which_variables_are_shown(form):
    """Value in the display unit = factor times value; said of each variable that has one, of a
    vector once for all. A corner is shown in Hz, a pure number as it is.
    """
    accel = Sensor("accel", {"turn_on_bias": {"b0": [2e-2, 1e-6, 0.0]}})
    gyro = Sensor("gyro", {"turn_on_bias": {"b0": [0, 5e-6, 0]}, "lag": {"wn": 300.0}})
    tree = etree.fromstring(texts(Part("p", 100.0, gyro, accel).block)[DESCRIPTION[form]].encode())
    shown = {}
    for element in tree.xpath("//*[@displayUnit]"):
        name = element.get("name") or element.getparent().get("name")
        (display,) = tree.xpath(
            f"//Unit[@name='{element.get('unit')}']"
            f"/DisplayUnit[@name='{element.get('displayUnit')}']"
        )
        shown[name.partition("[")[0]] = (display.get("name"), float(display.get("factor")))
    assert shown["gyro"] == shown["rate"] == ("deg/s", pytest.approx(180 / np.pi, rel=1e-15))
    assert shown["accel"] == ("g", pytest.approx(1 / 9.80665, rel=1e-15))
    assert shown["gyro_error.turn_on_bias.b0"] == (
        "deg/h",
        pytest.approx(180 / np.pi * 3600, rel=1e-15),
    )
    assert shown["accel_error.turn_on_bias.b0"] == ("mg", pytest.approx(1e3 / 9.80665, rel=1e-15))
    assert shown["gyro_error.lag.wn"] == ("Hz", pytest.approx(1 / (2 * np.pi), rel=1e-15))
    assert not {"temperature", "gyro_error.lag.zeta", "sample_period"} & set(shown)


def test_default_experiment(description):
    experiment = description.defaultExperiment
    assert (float(experiment.startTime), float(experiment.stopTime)) == (0.0, BLOCK.stop_time)
    assert float(experiment.stepSize) == BLOCK.sample_period


def terminals(block, form):
    """Name of a bus to its members by name, each the element of its variable."""
    files = texts(block)
    tree = etree.fromstring(files[TERMINALS[form]].encode())
    etree.XMLSchema(etree.parse(str(SCHEMAS / "fmi3" / "fmi3TerminalsAndIcons.xsd"))).assertValid(
        tree
    )
    description = etree.fromstring(files[DESCRIPTION[form]].encode())
    variables = {v.get("name"): v for v in description.find("ModelVariables")}
    return {
        t.get("name"): {
            m.get("memberName"): variables[m.get("variableName")]
            for m in t.findall("TerminalMemberVariable")
        }
        for t in tree.iter("Terminal")
        if t.get("matchingRule") == "bus"
    }


@pytest.mark.parametrize("form", (3, "block"))
@pytest.mark.parametrize(
    "start, given, end, taken, meet",
    (
        ("rover", "motion", "sensor", "motion", ("rate[3]", "specific_force[3]", "temperature")),
        ("sensor", "imu", "ukf", "imu", ("gyro[3]", "accel[3]", "temperature")),
        ("sensor", "imu", "low-pass", "imu", ("gyro[3]", "accel[3]")),
        ("low-pass", "filtered", "ukf", "imu", ("gyro[3]", "accel[3]")),
    ),
)
def test_buses_meet_in_the_members_that_they_share(form, start, given, end, taken, meet):
    """Members meet by their names; every one is a variable, and has the unit of the other."""
    imt30 = part("imt30")
    one, other = (
        terminals(BLOCKS[unit](imt30), form)[bus] for unit, bus in ((start, given), (end, taken))
    )
    names = {name.partition("[")[0] for name in meet}
    if form != "block":
        names = {f"{n}[{i}]" if f"{n}[3]" in meet else n for n in names for i in (1, 2, 3)}
    assert set(one) & set(other) == names
    for name in names:
        assert (one[name].get("causality"), other[name].get("causality")) == ("output", "input")
        assert one[name].get("unit") == other[name].get("unit")


def test_model_structure(description):
    """At a communication point a held output depends on no input; its start value on what
    ``initial`` reads.
    """
    outputs = {u.variable.name: [v.name for v in u.dependencies] for u in description.outputs}
    assert outputs == {v.name: [] for v in BLOCK.outputs}
    initial = {
        u.variable.name: [v.name for v in u.dependencies] for u in description.initialUnknowns
    }
    assert initial == {
        "y[1]": ["b0"],
        "y[2]": ["temperature", "M[1,2]", "M[2,1]"],
        "positive": ["b0"],
        "ticks": [],
    }


def test_documentation_lists_every_variable(path):
    with zipfile.ZipFile(path) as archive:
        page = archive.read("documentation/index.html").decode()
    assert all(
        f"<code>{v.name}</code>" in page for v in read_model_description(str(path)).modelVariables
    )
    assert "gain &lt;1&gt;" in page
    assert re.search(
        r"<code>ticks</code></td><td><code>counting</code> <code>gear</code></td>", page
    )


# The archive


def test_contents(path):
    with zipfile.ZipFile(path) as archive:
        names = archive.namelist()
        dates = {info.date_time for info in archive.infolist()}
    assert names == sorted(names) and len(dates) == 1
    sources = {
        "block.c",
        "block.h",
        "block_core.h",
        "block_saved.c",
        "block_values.c",
        "noise.c",
        "noise.h",
        "model.h",
        "model_prefix.h",
        "model_table.h",
        "prefix.h",
        "step.c",
    }
    common = {
        "modelDescription.xml",
        "documentation/index.html",
        "documentation/licenses/license.txt",
    }
    two = {"sources/fmi2.c", "model.png", "binaries/linux64/Toy.so"}
    three = {
        "sources/fmi3.c",
        "sources/buildDescription.xml",
        "terminalsAndIcons/terminalsAndIcons.xml",
        "terminalsAndIcons/icon.png",
        "binaries/x86_64-linux/Toy.so",
    }
    if host_platform() == "x86_64-linux":
        assert set(names) == common | {f"sources/{f}" for f in sources} | (
            two if form_of(path) == 2 else three
        )


def test_same_block_same_bytes(path, tmp_path):
    again = build_fmu(toy(), tmp_path, form_of(path))
    assert again.read_bytes() == path.read_bytes()


def tokens(block):
    """Those of each form, as its model description says."""
    files = texts(block)
    return tuple(
        re.search(r'(?:guid|instantiationToken)="(.*?)"', files[DESCRIPTION[form]])[1]
        for form in FORMS
    )


def test_token_follows_the_content():
    others = [
        toy(),
        toy(name="Other"),
        toy(sample_period=0.01),
        toy(unit="deg/s"),
        replace(BLOCK, description=""),
    ]
    all_tokens = [token for b in others for token in tokens(b)]
    assert len(set(all_tokens)) == len(all_tokens) and tokens(others[0]) == tokens(BLOCK)


def test_the_table_has_the_token_of_each_version():
    files, (two, three, blocks) = texts(BLOCK), tokens(BLOCK)
    assert f'MODEL_TOKEN_FMI2 "{two}"' in files["model_table.h"]
    assert f'MODEL_TOKEN_FMI3 "{three}"' in files["model_table.h"]
    assert f'MODEL_TOKEN_FMI3 "{blocks}"' in files["model_table.block.h"]


@pytest.mark.parametrize("form", FORMS, ids=("fmi2", "fmi3", "block"))
def test_one_form_has_the_texts_that_it_has_among_all(form):
    every, one = texts(BLOCK), texts(BLOCK, [form])
    assert DESCRIPTION[form] in one and one == {name: every[name] for name in one}
    assert (DESCRIPTION["block"] in one) == (form == "block")


def test_a_dimension_stands_before_the_arrays_that_it_measures(toys):
    """Readers that go through the file once know it then."""
    with zipfile.ZipFile(toys["block"]) as archive:
        tree = etree.fromstring(archive.read("modelDescription.xml"))
    seen, sized = set(), 0
    for variable in tree.find("ModelVariables"):
        for dimension in variable.findall("Dimension[@valueReference]"):
            assert dimension.get("valueReference") in seen
            sized += 1
        seen.add(variable.get("valueReference"))
    assert sized == len(BLOCK.inputs) + 4  # y[1] and y[2] have units of their own, hence 4 outputs


@pytest.mark.parametrize("form", (3, "block"))
def test_a_build_configuration_with_options_names_its_compiler(toys, form):
    """FMI 3.0, section 2.5.1.2: options are those of a compiler; none are needed here."""
    with zipfile.ZipFile(toys[form]) as archive:
        tree = etree.fromstring(archive.read("sources/buildDescription.xml"))
    files = list(tree.iter("SourceFileSet"))
    assert files and all(f.get("compiler") for f in files if f.get("compilerOptions"))


def test_no_half_written_fmu_stays(tmp_path):
    build_fmu(BLOCK, tmp_path)
    assert [p.name for p in tmp_path.iterdir()] == ["Toy.fmi2.fmu"]


def test_write_generated(tmp_path):
    written = write_generated(BLOCK, tmp_path / "generated" / "Toy")
    assert {p.name: p.read_text(encoding="utf-8") for p in written} == texts(BLOCK)


def test_icon_is_a_picture():
    Image = pytest.importorskip("PIL.Image")
    picture = Image.open(BytesIO(icon(64)))
    assert picture.size == (64, 64) and set(np.unique(picture)) == {0, 160, 255}


# The library


def declared(version):
    """The functions that the standard's header declares."""
    header = (header_folder() / f"fmi{version}Functions.h").read_text()
    return set(re.findall(rf"FMI{version}_Export\s+\w+TYPE\s+(fmi{version}\w+);", header))


def test_every_function_is_exported(path):
    with Unit(path) as unit:
        names = declared(unit.version)
        assert len(names) == {2: 44, 3: 75}[unit.version]
        assert all(hasattr(unit.fmu.dll, name) for name in names)


@pytest.mark.skipif(shutil.which("nm") is None, reason="needs nm")
def test_nothing_else_is_exported(path, tmp_path):
    (library,) = unzipped(path, tmp_path).glob("binaries/*/Toy.so")
    assert {
        line.split()[-1] for line in told("nm", "-D", "--defined-only", library).splitlines()
    } == declared(version_of(path))


@pytest.mark.skipif(shutil.which("readelf") is None, reason="needs readelf")
def test_only_libc_and_libm_are_needed(path, tmp_path):
    (library,) = unzipped(path, tmp_path).glob("binaries/*/Toy.so")
    assert set(re.findall(r"\(NEEDED\).*\[(lib[a-z]+)", told("readelf", "-d", library))) <= {
        "libc",
        "libm",
    }


@pytest.mark.skipif(shutil.which("gcc") is None, reason="needs gcc")
def test_sources_compile_without_a_warning_and_hold_no_variables(path, tmp_path):
    """The sources as shipped; no object has initialized or zeroed data, so instances can share
    nothing.
    """
    sources = unzipped(path, tmp_path) / "sources"
    for file in sorted(sources.glob("*.c")):
        subprocess.run(
            [
                "gcc",
                *FLAGS,
                "-Wall",
                "-Wextra",
                "-Werror",
                "-I",
                header_folder(),
                "-c",
                file.name,
            ],
            cwd=sources,
            check=True,
        )
        sizes = told("size", "-A", file.with_suffix(".o"))
        assert re.findall(r"^\.(?:data|bss)\s+(\d+)", sizes, re.MULTILINE) == ["0", "0"]


# Blocks at the edge


def gain(outputs=1, inputs=1, parameters=1, sample="u", **changes):
    """A block without state and noise: y = p u, or less; ``sample`` is what u is called."""
    u, p = ca.SX.sym("u", inputs), ca.SX.sym("p", parameters)
    y = ca.vertcat(*[(u[0] if inputs else 1) * (p[0] if parameters else 2)] * outputs)
    step = ca.Function(
        "step",
        [ca.SX.sym("s", 0), u, p, ca.SX.sym("w", 0), ca.SX.sym("h")],
        [ca.SX.zeros(0), ca.densify(y)],
    )
    initial = ca.Function("initial", [u, p], [ca.SX.zeros(0), ca.SX.zeros(outputs)])
    block = Block(
        "Gain",
        "",
        step,
        initial,
        (Variable(sample),) * inputs,
        (Variable("p", start=3.0),) * parameters,
        (Variable("y"),) * outputs,
        (),
        0.1,
    )
    return replace(block, **changes)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("missing", ("nothing", "inputs", "parameters", "outputs"))
def test_blocks_may_lack_anything(tmp_path_factory, form, missing):
    block = gain(**({} if missing == "nothing" else {missing: 0}))
    fmu = built(block, tmp_path_factory)[form]
    assert validate_fmu(str(fmu)) == []
    with Unit(fmu).start() as unit:
        unit.step(0.0, 0.1)
        assert (
            unit.outputs()
            == {"nothing": [0.0], "inputs": [3.0], "parameters": [0.0], "outputs": []}[missing]
        )


def test_matrix_expressions_equal_python(tmp_path):
    """A casadi MX function uses work vectors, which belong to the instance."""
    s, u, p, w, h = (
        ca.MX.sym(name, n) for name, n in (("s", 2), ("u", 2), ("p", 4), ("w", 1), ("h", 1))
    )
    A = ca.reshape(p, 2, 2)
    following = ca.solve(A, s + h * u) + ca.repmat(w, 2, 1)
    step = ca.Function("step", [s, u, p, w, h], [following, ca.sin(ca.mtimes(A, following))])
    initial = ca.Function(
        "initial", [u, p], [ca.densify(ca.MX.zeros(2)), ca.densify(ca.MX.zeros(2))]
    )
    names = [
        tuple(Variable(f"{n}[{i + 1}]", start=start) for i, start in enumerate(starts))
        for n, starts in (("u", [0, 0]), ("A", [2, 0.5, -0.25, 3]), ("y", [0, 0]))
    ]
    block = Block("Solve", "", step, initial, *names, (NoiseChannel("w", 1),), 0.01)
    inputs = drive(200)[:, :2]
    for fmu, run in zip(build_fmus(block, tmp_path, FORMS), (simulate, simulate, simulate_blocks)):
        outputs = run(fmu, inputs, sample_period=0.01)
        np.testing.assert_array_equal(outputs[1:], block.run(inputs, w=normals(0, [1], 1, 200))[0])


@pytest.mark.parametrize("start", (np.inf, -np.inf, np.nan))
def test_a_start_value_that_a_unit_would_not_take_back_is_refused(start):
    """A master may hand start values back, and units take finite ones alone."""
    block = gain(parameters=1)
    with pytest.raises(UserError, match=f"block Gain: p must start finite, not at {start}"):
        texts(replace(block, parameters=(replace(block.parameters[0], start=start),)))


@pytest.mark.parametrize("bad", ("\x1b[31m", "a\nb", "\0", "\x7f", "\x9b", "\ud800", "\ufffe"))
@pytest.mark.parametrize("what", ("name", "description", "block", "noise", "limit"))
def test_characters_that_xml_has_not_and_that_move_a_cursor_are_refused(what, bad):
    block = gain()
    (p,) = block.parameters
    limits = Limits((f"p{bad}",), ca.Function("broken", [ca.SX.sym("p"), ca.SX.sym("h")], [0]))
    changed = {
        "name": {"parameters": (replace(p, name=f"p{bad}"),)},
        "description": {"parameters": (replace(p, description=f"a{bad}b"),)},
        "block": {"description": bad},
        "limit": {"limits": limits},
        "noise": {"noise": (NoiseChannel(f"w{bad}", 1),), "step": with_noise(block.step)},
    }[what]
    with pytest.raises(UserError, match="a name or a description must not have") as caught:
        texts(replace(block, **changed))
    assert bad not in str(caught.value)


def with_noise(step):
    """The step of ``gain`` with a normal that does nothing."""
    s, u, p, _, h = (ca.SX.sym(step.name_in(i), step.size1_in(i)) for i in range(5))
    return ca.Function("step", [s, u, p, ca.SX.sym("w"), h], step(s, u, p, ca.SX.zeros(0), h))


def test_other_characters_reach_the_description_and_the_c(tmp_path):
    """Quotes, a comment's end and letters of any script, as tools read them."""
    name = 'p"<&>*/\\n??/\u00b5\u4e2d\U0001f600'
    block = gain()
    block = replace(block, parameters=(replace(block.parameters[0], name=name),))
    for fmu in build_fmus(block, tmp_path, FORMS):
        description = read_model_description(str(fmu), validate=False)
        assert name in [v.name for v in description.modelVariables]
        with Unit(fmu) as unit:
            assert unit.get(name) == 3.0


@pytest.mark.parametrize(
    "changes, words",
    (
        ({"name": "a b"}, "C identifier"),
        ({"outputs": 2}, "more than one variable is called y"),
        ({"sample": "block_size"}, "more than one variable is called block_size"),
    ),
)
def test_blocks_that_cannot_become_an_fmu(changes, words):
    with pytest.raises(ValueError, match=words):
        texts(gain(**changes))


def test_sparse_blocks_are_refused():
    block = gain()
    sparse = ca.Function("initial", [ca.SX.sym("u"), ca.SX.sym("p")], [ca.SX.zeros(0), ca.SX(1, 1)])
    with pytest.raises(ValueError, match="sparse"):
        texts(replace(block, initial=sparse))


def test_functions_need_two_names():
    block = gain()
    again = ca.Function("step", [ca.SX.sym("u"), ca.SX.sym("p")], [ca.SX.zeros(0), ca.SX.zeros(1)])
    with pytest.raises(ValueError, match="names of their own, not step, step"):
        texts(replace(block, initial=again))


# Compilers


@pytest.mark.parametrize(
    "compiler, words",
    (("no-such-compiler", "no-such-compiler.*CC"), ("false", "could not make block.c")),
)
def test_compilers_that_fail(monkeypatch, tmp_path, compiler, words):
    monkeypatch.setenv("CC", compiler)
    with pytest.raises(UserError, match=words) as caught:
        build_fmu(BLOCK, tmp_path)
    assert "\n" not in str(caught.value) and not list(tmp_path.iterdir())


def test_what_was_compiled_is_not_compiled_again(monkeypatch, tmp_path):
    """A second build asks for no compiler; one with other start values that table alone."""
    monkeypatch.setenv("PYIMU_CACHE", str(tmp_path / "cache"))
    made, run = [], build._run
    monkeypatch.setattr(build, "_run", lambda c, f, what: made.append(what) or run(c, f, what))
    first = build_fmu(BLOCK, tmp_path / "a", 3).read_bytes()
    whole = len(made)
    assert build_fmu(BLOCK, tmp_path / "b", 3).read_bytes() == first and len(made) == whole
    start = replace(BLOCK.parameters[0], start=0.25 + BLOCK.parameters[0].start)
    build_fmu(replace(BLOCK, parameters=(start, *BLOCK.parameters[1:])), tmp_path / "c", 3)
    again = {m for m in made[whole:] if m.endswith(".c")}
    assert again == {m for m in made[:whole] if m.startswith("block")}


@pytest.mark.skipif(shutil.which("gcc") is None, reason="needs gcc")
def test_first_error_of_the_compiler_is_shown(tmp_path):
    block = gain()
    arguments = [ca.SX.sym("u"), ca.SX.sym("p")]
    broken = ca.Function("model_step", arguments, [ca.SX.zeros(0), ca.SX.zeros(1)])
    with pytest.raises(UserError, match="error.*model_step"):
        build_fmu(replace(block, initial=broken), tmp_path)


def test_a_folder_that_cannot_be_made_is_named(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(
        UserError, match=r"file/x/Toy.fmi2.fmu: cannot be written \(Not a directory\)"
    ):
        build_fmu(BLOCK, tmp_path / "file" / "x")


def test_a_folder_that_cannot_be_written_to_is_named_before_the_work(tmp_path, monkeypatch):
    """Nothing is left behind where it can; where it cannot, as in /proc, permissions would have
    said otherwise to root.
    """
    check_folder(tmp_path / "new" / "folder")
    assert not list(tmp_path.iterdir())

    def refuse(**_):
        raise FileNotFoundError(2, "No such file or directory")

    monkeypatch.setattr(tempfile, "TemporaryDirectory", refuse)
    with pytest.raises(
        UserError, match="new: cannot write there, No such file or directory; give another folder"
    ):
        check_folder(tmp_path / "new")


@pytest.mark.parametrize("form", FORMS)
def test_the_page_says_what_wants_new_inputs_at_every_sample(form):
    """Of a part that has something of the kind, and where a step can hold inputs for more than a
    sample.
    """
    jitter = Part("p", 100.0, Sensor("gyro", {"sampling_jitter": {}})).block
    assert ("make steps of one" in texts(jitter)[PAGE[form]]) == (form != "block")
    assert "make steps of one" not in texts(Part("p", 100.0).block)[PAGE[form]]
    assert all(
        "ants new inputs at every sample" in texts(jitter)[file]
        for file in (PAGE[form], DESCRIPTION[form])
    )


@pytest.mark.parametrize(
    "arguments, words", (({"form": 1}, "FMI version 1"), ({"platform": "vax"}, "platform 'vax'"))
)
def test_unknown_version_and_platform(tmp_path, arguments, words):
    with pytest.raises(UserError, match=words):
        build_fmu(BLOCK, tmp_path, **arguments)


def test_cross_compiling_says_what_it_needs(monkeypatch, tmp_path):
    monkeypatch.setattr("pyimu.fmu.build.find_spec", lambda name: None)
    with pytest.raises(UserError, match="pip install ziglang"):
        build_fmu(BLOCK, tmp_path, platform="all")


@pytest.mark.skipif(find_spec("ziglang") is None, reason="needs ziglang")
def test_all_platforms(tmp_path):
    fmus = build_fmus(BLOCK, tmp_path, FORMS, platform="all")
    libraries = [
        {n for n in zipfile.ZipFile(fmu).namelist() if n.startswith("binaries/")} for fmu in fmus
    ]
    assert (
        libraries[1]
        == libraries[2]
        == {f"binaries/{p.name}/Toy{p.suffix}" for p in PLATFORMS.values()}
    )
    assert libraries[0] == {
        "binaries/linux64/Toy.so",
        "binaries/aarch64-linux/Toy.so",
        "binaries/win64/Toy.dll",
        "binaries/darwin64/Toy.dylib",
        "binaries/aarch64-darwin/Toy.dylib",
    }


def test_the_c_sources_are_found():
    assert {"block.c", "fmi2.c", "fmi3.c", "noise.c"} <= {p.name for p in source_folder().iterdir()}
