"""The attitude filter in Modelica: its C gives the samples of the unit, its block wires them."""

import ctypes
import shutil
import subprocess

import numpy as np
import pytest
from modelica_cases import LIBRARY, simulated, vector

from pyimu.attitude import attitude_ukf
from pyimu.model.part_file import part
from pyimu.modelica.ukf_text import c_prefix, ukf_classes
from pyimu.units import STANDARD_GRAVITY

SOURCES = LIBRARY / "PyImu" / "Resources" / "C-Sources"
PREFIX = c_prefix("imt30")
SAMPLES = 400

TOOL = """
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include "pyimu_normal.c"
#include "{source}"
#include "{source}"

static jmp_buf back;
char said[200];

void ModelicaFormatError(const char *format, ...) {{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(said, sizeof said, format, arguments);
    va_end(arguments);
    longjmp(back, 1);
}}

void ModelicaError(const char *text) {{ ModelicaFormatError("%s", text); }}

void *make(double period, const double *p, size_t n) {{
    return setjmp(back) ? NULL : {prefix}_create(period, p, n);
}}

int go(void *memory, double number, const double *u, size_t nu, double *y, size_t ny) {{
    return setjmp(back) ? 1 : ({prefix}_sample(memory, number, u, nu, y, ny), 0);
}}

void end(void *memory) {{ {prefix}_free(memory); }}
"""
"""What a tool does: it includes the C, perhaps twice, beside its own, and has its errors."""

UTILITIES = """
#pragma once
void ModelicaError(const char *);
void ModelicaFormatError(const char *, ...);
"""


def compiled(folder, source, sources, prefix):
    """The library of a tool's program, with warnings as errors."""
    if shutil.which("cc") is None:
        pytest.skip("no C compiler")
    (folder / "ModelicaUtilities.h").write_text(UTILITIES)
    (folder / "tool.c").write_text(TOOL.format(source=source, prefix=prefix))
    words = ["-O1", "-shared", "-fPIC", "-Wall", "-Werror", "-I", folder, "-I", sources, "-I"]
    subprocess.run(
        ["cc", *words, SOURCES, "-o", folder / "tool.so", folder / "tool.c", "-lm"],
        check=True,
        timeout=120,
    )
    return ctypes.CDLL(str(folder / "tool.so"))


class Filter:
    """A filter of a tool's program, as its external object."""

    def __init__(self, tool, block, p=None, period=None):
        self.tool, self.n_output = tool, len(block.outputs)
        tool.make.restype = ctypes.c_void_p
        p = np.ascontiguousarray(block.start if p is None else p, dtype=float)
        made = tool.make(
            ctypes.c_double(block.sample_period if period is None else period),
            p.ctypes.data_as(ctypes.c_void_p),
            ctypes.c_size_t(len(p)),
        )
        self.memory = ctypes.c_void_p(made)

    def sample(self, number, u):
        """Outputs; None where it was refused."""
        u, y = np.ascontiguousarray(u, dtype=float), np.empty(self.n_output)
        refused = self.tool.go(
            self.memory,
            ctypes.c_double(number),
            u.ctypes.data_as(ctypes.c_void_p),
            ctypes.c_size_t(len(u)),
            y.ctypes.data_as(ctypes.c_void_p),
            ctypes.c_size_t(len(y)),
        )
        return None if refused else y

    def said(self):
        return (ctypes.c_char * 200).in_dll(self.tool, "said").value.decode()


@pytest.fixture(scope="module")
def block():
    return attitude_ukf(part("imt30"))


@pytest.fixture(scope="module")
def tool(tmp_path_factory):
    """The C of the library."""
    return compiled(tmp_path_factory.mktemp("tool"), f"{PREFIX}.c", SOURCES, PREFIX)


def eventful(block, n=SAMPLES):
    """Inputs (n, 18): a turn with noise, rests, headings, speeds, a field, and what is no number.

    ``n`` samples at the rate of the part.
    """
    rng, k = np.random.default_rng(5), np.arange(n)
    u = np.tile(block.start_inputs, (n, 1))
    column = {v.name: i for i, v in enumerate(block.inputs)}
    moving = (k // 50) % 2 == 1
    u[:, :3] = 0.3 * moving[:, None] + 1e-3 * rng.standard_normal((n, 3))
    u[:, 3:6] = [0, 0, STANDARD_GRAVITY] + 0.02 * rng.standard_normal((n, 3)) * (1 + 9 * moving)[
        :, None
    ]
    u[:, column["temperature"]] = 25 + 0.01 * k
    u[:, column["heading"]] = 0.2
    u[:, column["heading_variance"]] = 1e-4
    u[:, column["heading_valid"]] = k % 40 == 7
    u[:, column["stationary"]] = ~moving
    u[:, column["speed_variance"]] = 1e-2
    u[:, column["speed_valid"]] = k % 3 == 0
    u[:, column["mag[1]"] : column["mag[3]"] + 1] = [2e-5, 1e-6, -4e-5]
    u[55, 0] = np.nan
    return u


def test_c_gives_the_samples_of_the_unit(tool, block):
    """To the bit, from the outputs before the first sample on, with parameters of its own."""
    p = block.start.copy()
    p[[v.name for v in block.parameters].index("latitude")] = 0.9
    p[[v.name for v in block.parameters].index("field_strength")] = 4.5e-5
    u = eventful(block)
    want, _ = block.run(u, p=p)
    made = Filter(tool, block, p)
    before = np.array(block.initial(block.start_inputs, p)[1]).ravel()
    np.testing.assert_array_equal(made.sample(0, block.start_inputs), before)
    got = np.array([made.sample(k + 1, row) for k, row in enumerate(u)])
    np.testing.assert_array_equal(got, want)
    changing = np.ptp(got[:, :18], axis=0) > 0
    assert changing.sum() == 17  # all but the flag quasi_static
    tool.end(made.memory)


def test_a_sample_that_is_made_again_is_the_same(tool, block):
    """A tool may evaluate an event several times; and two filters know nothing of each other."""
    u = eventful(block, 60)
    want, _ = block.run(u)
    one, other = Filter(tool, block), Filter(tool, block)
    for made in (one, other):
        made.sample(0, block.start_inputs)
    for k, row in enumerate(u):
        other.sample(k + 1, u[-1 - k])
        for _ in range(3):
            np.testing.assert_array_equal(one.sample(k + 1, row), want[k])
    one.sample(0, block.start_inputs)
    np.testing.assert_array_equal(one.sample(1, u[0]), want[0])


@pytest.mark.parametrize("number", [1, 3, 7])
def test_samples_out_of_their_order_are_refused(tool, block, number):
    made, u = Filter(tool, block), block.start_inputs
    for k in (0, 1, 2)[: number - 1]:
        assert made.sample(k, u) is not None
    asked = {1: 1, 3: 3, 7: 1}[number]
    assert made.sample(asked, u) is None
    after = {1: -1, 3: 1, 7: 2}[number]
    assert made.said() == f"AttitudeUkf: sample {asked} was asked for after sample {after}"


def test_what_does_not_fit_is_refused(tool, block):
    assert not Filter(tool, block, period=0.0).memory
    made = Filter(tool, block, p=block.start[1:])
    assert not made.memory
    n = len(block.start)
    assert made.said() == f"AttitudeUkf: {n - 1} parameters were given, {n} are needed"
    made = Filter(tool, block)
    assert made.sample(0, block.start_inputs[1:]) is None and "18 inputs" in made.said()


# The block around it, with a function in Modelica in place of the C

ECHO = """
  function attitudeUkfSample
    input Real memory[:];
    input Real number;
    input Real u[18];
    output Real y[21];
  algorithm
    for i in 1:18 loop
      y[i] := 1000*number + u[i];
    end for;
    y[19] := 5;
    y[20] := memory[size(memory, 1)];
    y[21] := number - 2;
  end attitudeUkfSample;
"""


def test_block_hands_its_inputs_and_parameters_over_in_their_order(block):
    """rumoca has no external C: the object is replaced by the values from which it is made, the
    function by one that shows what it was given.
    """
    name, many = block.name, len(block.start) + 1
    text = ukf_classes(block, PREFIX, "none.c", "none")[name].replace("\nprotected\n", "\n")
    values = ", ".join(f"p[{i + 1}]" for i in range(len(block.start)))
    text = text.replace(
        f"{name}Memory memory = {name}Memory(samplePeriod, p);",
        f"parameter Real memory[{many}] = {{{values}, samplePeriod}};",
    )
    bench = f"""model Bench
      {ECHO}
      {text}
      {name} ukf(samplePeriod=0.5, motionTolerance=0.25, useHeading=true, useSpeed=true);
      Real memory[{many}];
    equation
      memory = ukf.memory;
      ukf.gyro = {{0.01, 0.02, 0.03}};
      ukf.accel = {{0.04, 0.05, 0.06}};
      ukf.temperature = 0.07;
      ukf.heading = 0.08;
      ukf.headingVariance = 0.09;
      ukf.headingValid = true;
      ukf.headingAge = 0.11;
      ukf.speed = 0.13;
      ukf.speedVariance = 0.14;
      ukf.speedValid = false;
    end Bench;"""
    rows = simulated("Bench", 2.0, 0.5, bench)
    k = np.arange(5.0)
    want = 0.01 * np.arange(1, 19)
    want[[9, 11, 14, 15, 16, 17]] = 1, 0, 0, 0, 0, 0
    given = vector(rows, "ukf.shown", 21)
    np.testing.assert_array_equal(given[1:, :18], 1000 * k[1:, None] + want)
    assert not given[0, :18].any()
    np.testing.assert_array_equal(vector(rows, "ukf.q", 4), given[:, :4])
    np.testing.assert_array_equal(vector(rows, "ukf.std", 6), given[:, 10:16])
    np.testing.assert_array_equal(rows["ukf.nis"], given[:, 17])
    np.testing.assert_array_equal(rows["ukf.status"], np.full(5, 5))
    np.testing.assert_array_equal(rows["ukf.headingStd"], np.full(5, 0.5))
    np.testing.assert_array_equal(rows["ukf.atRest"], k - 2 > 0.5)
    p = block.start.copy()
    p[[v.name for v in block.parameters].index("motion_tolerance")] = 0.25
    np.testing.assert_array_equal(vector(rows, "memory", many)[-1], [*p, 0.5])
