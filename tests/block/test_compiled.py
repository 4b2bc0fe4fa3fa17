"""The compiled run gives the bits of casadi's virtual machine, its library outlives the process,
and its absence goes unnoticed.
"""

import os
import subprocess
import sys
import time
from dataclasses import replace

import casadi as ca
import numpy as np
import pytest
from places import same_path

import pyimu
from pyimu.attitude import attitude_ukf
from pyimu.block import cache as store
from pyimu.block import compiled as native
from pyimu.block.block import CHUNK, Block, Run
from pyimu.block.normals import normals
from pyimu.block.stepping import FEW, step_often, step_through
from pyimu.block.variables import NoiseChannel, Variable
from pyimu.errors import UserError
from pyimu.files.held import FORGOTTEN, PREFIX, work_folder

CHANNELS = [7, 2**40 + 1]


@pytest.fixture(autouse=True)
def cache(tmp_path, monkeypatch):
    """A cache of its own for each test, nothing known yet, and every step compiled at once."""
    for name in ("LOOKED_FOR", "WORTHWHILE"):
        monkeypatch.setattr(native, name, 0)
    monkeypatch.setenv("PYIMU_CACHE", str(tmp_path / "cache"))
    forget()
    yield tmp_path / "cache"
    forget()


def forget():
    """What a new process does not know."""
    native._machine_code.cache_clear()
    native._loaded.clear()


@pytest.fixture
def compilations(monkeypatch):
    """The keys of the libraries that were compiled."""
    made, compile_it = [], native._compile
    monkeypatch.setattr(
        native,
        "_compile",
        lambda source, compiler, key: made.append(key) or compile_it(source, compiler, key),
    )
    return made


def toy():
    """A random walk beside white noise; the state is as long as not to fit in registers."""
    s, u, p, w, h = (
        ca.SX.sym(n, k) for n, k in (("s", 40), ("u", 2), ("p", 1), ("w", 2), ("h", 1))
    )
    following = ca.vertcat(s[0] + p * ca.sqrt(h) * w[0], s[:-1])
    step = ca.Function(
        "step", [s, u, p, w, h], [following, ca.vertcat(u[0] * s[39] + s[0], u[1] + w[1])]
    )
    initial = ca.Function("initial", [u, p], [ca.SX.zeros(40), ca.SX.zeros(2)])
    scalars = [
        tuple(Variable(f"{n}[{i + 1}]", start=1.0) for i in range(k))
        for n, k in (("u", 2), ("p", 1), ("y", 2))
    ]
    return Block(
        "Toy", "", step, initial, *scalars, tuple(NoiseChannel(str(c), c) for c in CHANNELS), 0.01
    )


def blocks():
    part = pyimu.part("imt30")
    return [toy(), part.block, attitude_ukf(part)]


def inputs(block, rows, rng):
    u = rng.standard_normal((rows, len(block.inputs)))
    u[:, [i for i, v in enumerate(block.inputs) if v.kind == "boolean"]] = rng.integers(
        0, 2, (rows, 1)
    )
    u[rows // 2] = np.nan
    return u


def without_compiler(monkeypatch):
    monkeypatch.setenv("CC", "no-such-compiler")
    forget()


# The bits


@pytest.mark.parametrize("block", blocks(), ids=lambda b: b.name)
def test_compiled_step_equals_the_virtual_machine_bit_for_bit(block):
    rng = np.random.default_rng(1)
    u, w = inputs(block, 400, rng), rng.standard_normal((400, len(block.noise)))
    last, want = (
        np.array(block.initial(block.start_inputs, block.start)[0], dtype=float).ravel(),
        np.empty((400, len(block.outputs))),
    )
    step_through(block.step, last, u, block.start, w, np.array([block.sample_period]), want)
    assert native.compiled(block.step, 400) is not None
    y, state = block.run(u, w=w)
    np.testing.assert_array_equal(y, want)
    np.testing.assert_array_equal(state, last)


def test_a_result_that_nobody_asks_for_is_made_nowhere():
    """One function calls another for one of its two results, each a vector that is copied out."""
    x = ca.MX.sym("x", 40)
    squares, chosen = ca.sqrt(x * x + 1), ca.MX(x)
    chosen[3] = squares[5]
    inner = ca.Function("inner", [x], [squares, chosen], {"never_inline": True})
    symbols = [ca.MX.sym(n, k) for n, k in (("s", 40), ("u", 2), ("p", 1), ("w", 2), ("h", 1))]
    s, u = symbols[:2]
    outer = ca.Function("outer", [s], [inner(s)[1]], {"never_inline": True})
    step = ca.Function("step", symbols, [outer(s), u + inner(s)[0][:2] + inner(u[0] + s)[1][:2]])
    block = replace(toy(), step=step)
    u, start = np.random.default_rng(4).standard_normal((300, 2)), np.arange(40.0)
    last, want = start.copy(), np.empty((300, 2))
    step_through(step, last, u, block.start, np.zeros((300, 2)), np.array([0.01]), want)
    assert native.compiled(step, 300) is not None
    y, state = block.run(u, state=start)
    np.testing.assert_array_equal(y, want)
    np.testing.assert_array_equal(state, last)


@pytest.mark.parametrize("reads_after", [False, True])
def test_a_ring_of_which_each_sample_writes_an_entry_is_not_copied(reads_after):
    """Unless the step reads of the state before the sample what it has written."""
    s, u, p, w, h = symbols = [
        ca.MX.sym(n, k) for n, k in (("s", 40), ("u", 2), ("p", 1), ("w", 2), ("h", 1))
    ]
    place, ring = s[0], s[1:]
    head, oldest = ca.fmod(place + 1, 39), ring.nz[ca.fmod(place + 1, 39)]
    ring.nz[place] = u[0] + oldest
    last = ca.sum1(s[1:]) if reads_after else u[1]
    step = ca.Function("step", symbols, [ca.vertcat(head, ring), ca.vertcat(oldest, last)])
    copied = "casadi_copy(wr" in native._source([step])
    assert copied == reads_after
    block = replace(toy(), step=step)
    u, state = np.random.default_rng(5).standard_normal((301, 2)), np.arange(40.0)
    after, want = state.copy(), np.empty((301, 2))
    step_through(step, after, u, block.start, np.zeros((301, 2)), np.array([0.01]), want)
    run = Run(block, 301, state=state)
    pieces = [run.advance(u[a:b]) for a, b in ((0, 1), (1, 100), (100, 301))]
    np.testing.assert_array_equal(np.vstack(pieces), want)
    np.testing.assert_array_equal(run.state, after)


def test_greater_and_lesser_of_nan_infinity_and_zeros_are_those_of_the_virtual_machine():
    values = [np.nan, np.inf, -np.inf, 0.0, -0.0, 1.0, -1.0]
    u = np.array([(a, b) for a in values for b in values])
    symbols = [ca.SX.sym(n, k) for n, k in (("s", 1), ("u", 2), ("p", 1), ("w", 2), ("h", 1))]
    s, (a, b) = symbols[0], ca.vertsplit(symbols[1])
    step = ca.Function("step", symbols, [s, ca.vertcat(ca.fmax(a, b), ca.fmin(a, b))])
    block = replace(toy(), step=step)
    start, p, h = np.zeros(1), block.start, np.array([0.01])
    want = np.empty((len(u), 2))
    step_through(step, start, u, p, np.zeros((len(u), 2)), h, want)
    got, _ = block.run(u, state=start)
    assert got.tobytes() == want.tobytes()


@pytest.mark.parametrize("compiler", [True, False], ids=("compiled", "virtual machine"))
@pytest.mark.parametrize("first", [1, -5, 2**40])
def test_seed_draws_the_normals_of_its_samples(compiler, first, monkeypatch):
    if not compiler:
        without_compiler(monkeypatch)
    block, n = toy(), CHUNK + 77
    u = np.random.default_rng(2).standard_normal((n, 2))
    y, state = block.run(u, seed=2**64 - 3, first_sample=first)
    want, last = block.run(u, w=normals(2**64 - 3, CHANNELS, first, n))
    assert (native.compiled(block.step, 1) is not None) == compiler
    np.testing.assert_array_equal(y, want)
    np.testing.assert_array_equal(state, last)


@pytest.mark.parametrize("compiler", [True, False], ids=("compiled", "virtual machine"))
def test_pieces_of_a_run_are_the_run(compiler, monkeypatch):
    if not compiler:
        without_compiler(monkeypatch)
    block = toy()
    u = np.random.default_rng(3).standard_normal((700, 2))
    run = Run(block, 700, seed=5)
    pieces = [run.advance(u[a:b]) for a, b in ((0, 1), (1, 130), (130, 131), (131, 700))]
    y, state = block.run(u, seed=5)
    np.testing.assert_array_equal(np.vstack(pieces), y)
    np.testing.assert_array_equal(run.state, state)


def test_without_seed_and_normals_there_is_no_noise(monkeypatch):
    block, u = toy(), np.random.default_rng(4).standard_normal((300, 2))
    silent = block.run(u, w=np.zeros((300, 2)))[0]
    np.testing.assert_array_equal(block.run(u)[0], silent)
    without_compiler(monkeypatch)
    np.testing.assert_array_equal(block.run(u)[0], silent)


@pytest.mark.parametrize("seed", [-1, 2**64])
def test_seed_beyond_64_bits_is_refused(seed):
    with pytest.raises(UserError, match="seed"):
        toy().run(np.zeros((3, 2)), seed=seed)


@pytest.mark.parametrize(
    "wrong",
    [{"u": np.zeros((3, 3))}, {"w": np.zeros((4, 2))}, {"state": np.zeros(3)}, {"p": np.zeros(2)}],
)
def test_arrays_of_a_wrong_shape_are_refused_before_they_are_read(wrong):
    with pytest.raises(ValueError, match="block Toy"):
        toy().run(**{"u": np.zeros((3, 2)), **wrong})


# When it pays


def test_short_runs_are_not_compiled_until_there_were_many(monkeypatch, compilations):
    monkeypatch.setattr(native, "LOOKED_FOR", 500)
    monkeypatch.setattr(native, "WORTHWHILE", 1000)
    step = toy().step
    assert [native.compiled(step, 400) is not None for _ in range(4)] == [False, False, True, True]
    assert len(compilations) == 1


def test_a_long_run_is_compiled_whoever_counted_its_rows(monkeypatch):
    """An integer of numpy counts as any other; the rows of a recording are one."""
    for name in ("LOOKED_FOR", "WORTHWHILE"):
        monkeypatch.setattr(native, name, 500)
    assert native.compiled(toy().step, np.int64(500)) is not None


def test_without_a_compiler_the_run_is_the_same(monkeypatch):
    block = blocks()[1]
    u = inputs(block, 50, np.random.default_rng(2))
    want = block.run(u, seed=1)[0]
    without_compiler(monkeypatch)
    np.testing.assert_array_equal(block.run(u, seed=1)[0], want)


def test_a_compiler_that_fails_is_asked_once(monkeypatch, tmp_path, compilations):
    monkeypatch.setenv("CC", "false")
    block = toy()
    for _ in range(3):
        assert native.compiled(block.step, 10) is None
    assert len(compilations) == 1


# The cache


def test_library_is_found_by_the_next_process(cache, compilations):
    for _ in range(2):
        assert native.compiled(toy().step, 10) is not None
        forget()
    assert len(compilations) == 1 and len(list(cache.iterdir())) == 1


def test_library_is_found_by_another_process(cache):
    program = (
        "import numpy as np, test_compiled as t\nfrom pyimu.block import compiled as native\n"
        "native.LOOKED_FOR, native._compile = 0, None\nprint(repr(t.toy().run(np.ones((9, 2)), "
        "seed=3)[0].tolist()),"
        "native.compiled(t.toy().step, 1) is not None)"
    )
    want = toy().run(np.ones((9, 2)), seed=3)[0].tolist()
    done = subprocess.run(
        [sys.executable, "-c", program], env=same_path(), capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == f"{want!r} True"


def test_another_step_flags_noise_or_processor_are_another_library(monkeypatch, tmp_path):
    listed, compiler = native._listed([toy().step]), ("cc",)
    keys = [native._key(listed, compiler), native._key(listed + " ", compiler)]
    monkeypatch.setattr(native, "FLAGS", (*native.FLAGS, "-g"))
    keys.append(native._key(listed, compiler))
    for name in native.HAND_WRITTEN:
        (tmp_path / name).write_text("int other;")
    monkeypatch.setattr(native, "source_folder", lambda: tmp_path)
    keys.append(native._key(listed, compiler))
    monkeypatch.setattr(native, "_processor", lambda compiler: "another")
    keys.append(native._key(listed, compiler))
    assert len(set(keys)) == 5


@pytest.mark.skipif(sys.platform == "win32", reason="a compiler in two lines of shell")
def test_a_compiler_that_knows_no_processor_compiles_without(monkeypatch, tmp_path):
    """One that refuses ``-march=native`` is asked for what all machines of the kind have."""
    compiler = tmp_path / "picky"
    compiler.write_text('#!/bin/sh\ncase "$*" in *native*) exit 1;; esac\nexec cc "$@"\n')
    compiler.chmod(0o755)
    assert native.flags([str(compiler)]) == [*native.FLAGS]
    monkeypatch.setenv("CC", str(compiler))
    assert native.compiled(toy().step, 10) is not None


@pytest.mark.parametrize(
    "damage",
    [
        lambda data: data[: len(data) // 2],
        lambda data: data[:-1] + b"x",
        lambda data: b"",
        lambda data: b"not a library",
    ],
    ids=("truncated", "altered", "empty", "text"),
)
def test_damaged_library_is_compiled_again(cache, compilations, damage):
    native.compiled(toy().step, 10)
    (path,) = cache.iterdir()
    whole = path.read_bytes()
    path.write_bytes(damage(whole))
    forget()
    want = toy().run(np.ones((5, 2)), seed=1)[0]
    assert len(compilations) == 2 and path.read_bytes() == whole and np.isfinite(want).all()


def test_foreign_file_under_a_librarys_name_is_compiled_again(cache, compilations):
    """A file whose digest is right and that is no library, as one of another system would be."""
    native.compiled(toy().step, 10)
    (path,) = cache.iterdir()
    path.rename(path.with_name(f"{compilations[0]}.{store._digest(b'foreign')}.so"))
    next(cache.iterdir()).write_bytes(b"foreign")
    forget()
    assert native.compiled(toy().step, 10) is not None and len(compilations) == 2


@pytest.mark.skipif(not hasattr(os, "getuid"), reason="asks for POSIX permissions")
def test_folder_that_others_may_write_to_is_not_run_from(cache, compilations):
    native.compiled(toy().step, 10)
    cache.chmod(0o777)
    forget()
    assert native.compiled(toy().step, 10) is not None and len(compilations) == 2


@pytest.mark.skipif(not hasattr(os, "getuid"), reason="asks for POSIX permissions")
@pytest.mark.parametrize(
    "mode, found", ((0o755, True), (0o1777, True), (0o777, False), (0o775, False))
)
def test_a_cache_that_others_may_replace_is_not_run_from(
    tmp_path, monkeypatch, compilations, mode, found
):
    """Who may write to a folder may put another in the place of one in it, but for a sticky one."""
    monkeypatch.setenv("PYIMU_CACHE", str(tmp_path / "parent" / "own" / "cache"))
    forget()
    native.compiled(toy().step, 10)
    (tmp_path / "parent").chmod(mode)
    forget()
    assert native.compiled(toy().step, 10) is not None and len(compilations) == 2 - found


@pytest.mark.skipif(not hasattr(os, "getuid"), reason="asks for POSIX permissions")
def test_a_cache_behind_a_link_that_others_may_replace_is_not_run_from(
    tmp_path, monkeypatch, compilations
):
    for name in ("kept", "open"):
        (tmp_path / name).mkdir()
    (tmp_path / "open" / "link").symlink_to(tmp_path / "kept")
    (tmp_path / "open").chmod(0o777)
    for _ in range(2):
        monkeypatch.setenv("PYIMU_CACHE", str(tmp_path / "open" / "link" / "cache"))
        forget()
        native.compiled(toy().step, 10)
    assert len(compilations) == 2


def test_a_temporary_folder_goes_and_takes_along_what_a_killed_process_left(tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    for name, age in (("dead", 2 * FORGOTTEN), ("alive", 0.0)):
        (tmp_path / f"{PREFIX}{name}").mkdir()
        (tmp_path / f"{PREFIX}{name}" / "run.c").write_text("")
        os.utime(tmp_path / f"{PREFIX}{name}", (time.time() - age,) * 2)
    (tmp_path / "pyimu-results").mkdir()
    os.utime(tmp_path / "pyimu-results", (0, 0))
    with work_folder() as folder:
        (folder / "file").write_text("")
    assert {p.name for p in tmp_path.iterdir()} == {f"{PREFIX}alive", "pyimu-results"}


def test_without_a_place_for_temporary_files_the_virtual_machine_runs(tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "missing"))
    assert native.compiled(toy().step, 10) is None


@pytest.mark.parametrize("where", ["", "file"])
def test_without_a_cache_the_run_is_compiled_all_the_same(tmp_path, monkeypatch, where):
    """Switched off, and a folder that cannot be made."""
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("PYIMU_CACHE", where and str(tmp_path / "file" / "below"))
    assert native.compiled(toy().step, 10) is not None
    assert not list(tmp_path.glob("**/*.so"))


def test_cache_keeps_what_was_used_last(cache, monkeypatch):
    """As many as fit, by their sizes."""
    monkeypatch.setattr(store, "KEPT", 60)
    for k in range(5):
        store.keep(f"{k:032x}", bytes([k] * 20))
        (path,) = cache.glob(f"{k:032x}.*")
        os.utime(path, (k, k))
    assert sorted(int(p.name.split(".")[0], 16) for p in cache.iterdir()) == [2, 3, 4]


def test_cache_loses_what_a_killed_process_left(cache):
    cache.mkdir(mode=0o700)
    for name, age in (("dead.tmp", 2 * store.DEAD), ("alive.tmp", 0.0)):
        (cache / name).write_bytes(b"half")
        os.utime(cache / name, (time.time() - age,) * 2)
    store.keep("0" * 32, b"whole")
    assert {p.suffix for p in cache.iterdir()} == {".tmp", ".so"}
    assert [p.name for p in cache.glob("*.tmp")] == ["alive.tmp"]


@pytest.mark.parametrize(
    ("platform", "environment", "want"),
    [
        ("linux", {"XDG_CACHE_HOME": "/c"}, "/c/pyimu"),
        ("linux", {}, "/h/.cache/pyimu"),
        ("linux", {"XDG_CACHE_HOME": "c"}, "/h/.cache/pyimu"),
        ("darwin", {"XDG_CACHE_HOME": "/c"}, "/h/Library/Caches/pyimu"),
        ("win32", {"LOCALAPPDATA": "/l"}, "/l/pyimu"),
        ("win32", {}, "/h/AppData/Local/pyimu"),
        ("linux", {"PYIMU_CACHE": "/p"}, "/p"),
        ("linux", {"PYIMU_CACHE": ""}, "None"),
    ],
)
@pytest.mark.skipif(sys.platform == "win32", reason="paths of POSIX")
def test_cache_folder_is_the_platforms(monkeypatch, platform, environment, want):
    for name in ("PYIMU_CACHE", "XDG_CACHE_HOME", "LOCALAPPDATA"):
        monkeypatch.delenv(name, raising=False)
    for name, value in {"HOME": "/h", **environment}.items():
        monkeypatch.setenv(name, value)
    monkeypatch.setattr(sys, "platform", platform)
    assert str(store.cache_folder()) == want


def test_a_step_taken_often_is_compiled_and_gives_the_bits_of_the_virtual_machine(compilations):
    s, u, p, none, h = (
        ca.SX.sym(n, k) for n, k in (("s", 1), ("u", 1), ("p", 1), ("w", 0), ("h", 1))
    )
    after = ca.fmax(u - p, ca.fmin(u + p, s))  # the play of a hysteresis
    step = ca.Function("memory", [s, u, p, none, h], [after, s])
    x = np.cumsum(np.random.default_rng(1).standard_normal((4 * FEW, 1)), axis=0)
    found, want = np.empty((2, len(x), 1))
    ends = [np.zeros(1), np.zeros(1)]
    given = np.ones(1), np.zeros((len(x), 0)), np.full(1, 0.01)
    step_often(step, ends[0], x, *given, found)
    for k in range(0, len(x), FEW):
        rows = slice(k, k + FEW)
        step_through(step, ends[1], x[rows], given[0], given[1][rows], given[2], want[rows])
    np.testing.assert_array_equal(found, want)
    assert ends[0] == ends[1]
    assert len(compilations) == 1


@pytest.mark.parametrize(
    "says, quick",
    [
        ("#define __GNUC__ 12\n#define __AVX2__ 1\n", True),
        ("#define __GNUC__ 4\n#define __clang__ 1\n", False),
        ("#define __clang__ 1\n#define __GNUC__ 12\n", False),
        ("#define __GNUC__ 6\n", False),
        ("", False),
    ],
)
def test_only_a_gcc_that_knows_them_is_given_gccs_options(monkeypatch, says, quick):
    monkeypatch.setattr(native, "_processor", lambda compiler: says)
    given = native.flags(["cc"])
    assert (set(native.COMPILED_SOON) <= set(given)) == quick
    assert (native.OWN in given) == bool(says)
