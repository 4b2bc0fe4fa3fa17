"""What the square-root form of the attitude filter buys and costs.

``python benchmarks/square_root.py [minutes]``; needs a C compiler. The filter of 13 sigma points
(``pyimu.attitude.filter.sigma_point_filter``) and its square-root form run over the same rows in
three arithmetics: double precision; double with the state rounded to single precision after every
sample, as a filter that keeps it so; and single precision throughout. Printed are, against the
square-root form in double precision, the share of samples whose covariance is not definite, the
largest relative error of a standard deviation, and the largest error of the attitude in standard
deviations, the last two after the first ten seconds. A run fails where a number is not finite, a
covariance is not definite, or a standard deviation is off by a tenth. Then the time of a step.
"""

import ctypes
import subprocess
import sys
import tempfile
import time
from functools import lru_cache
from pathlib import Path

import casadi as ca
import numpy as np
from drives.attitude import GRAVITY, LATITUDE, WHITE, Drive, H, Scenario
from scipy.spatial.transform import Rotation

from pyimu.attitude import attitude_ukf
from pyimu.attitude.filter.sigma_point_filter import sigma_point_filter
from pyimu.attitude.filter.square_root import square_root_filter
from pyimu.block.block import Block
from pyimu.block.compiled import compiler_command
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor

MINUTES = 30.0
SETTLED = round(10 / H)
"""Samples that are left out at the start."""

OFTEN = 10
"""Samples after which the definiteness is looked at again."""

LARGEST = 0.1
"""Relative error of a standard deviation from which on a run fails."""

FORMS = {"covariance": sigma_point_filter, "square root": square_root_filter}
ARITHMETICS = {"double": ("double", 0), "state in single": ("double", 1), "single": ("float", 0)}

LOOP = """
int run(long long n, double *state, const double *u, const double *p, double h, int round,
        double *y, double *kept, long long often) {
  static casadi_real s[NS], un[NU], pn[NP], hn, sn[NS], yn[NY], w[SZ_W];
  static casadi_int iw[SZ_IW];
  const casadi_real *arg[SZ_ARG] = {s, un, pn, 0, &hn};
  casadi_real *res[SZ_RES] = {sn, yn};
  hn = h;
  for (int i = 0; i < NS; i++) s[i] = state[i];
  for (int i = 0; i < NP; i++) pn[i] = p[i];
  for (long long k = 0; k < n; k++) {
    for (int i = 0; i < NU; i++) un[i] = u[k * NU + i];
    arg[0] = s, arg[1] = un, arg[2] = pn, arg[3] = 0, arg[4] = &hn;
    res[0] = sn, res[1] = yn;
    if (STEP(arg, res, iw, w, 0)) return 1;
    for (int i = 0; i < NS; i++) s[i] = round ? (casadi_real)(float)sn[i] : sn[i];
    for (int i = 0; i < NY; i++) y[k * NY + i] = yn[i];
    if (k % often == 0)
      for (int i = 0; i < 55; i++) kept[k / often * 55 + i] = s[i];
  }
  return 0;
}
"""


def main(minutes: float = MINUTES) -> None:
    if not compiler_command():
        print("no C compiler: CC names one")
        return
    n = round(minutes * 60 / H)
    print(
        f"{n} samples at {1 / H:g} Hz; not definite: share of each {OFTEN}th sample; std, attitude:"
        " largest error, relative and in standard deviations"
    )
    failures = {key: 0 for key in np.ndindex(len(FORMS), len(ARITHMETICS))}
    for name, case in CASES.items():
        failed = compare(name, *case(n))
        for key in failures:
            failures[key] += key in failed
    print(f"\nruns that fail, of {len(CASES)}")
    for i, form in enumerate(FORMS):
        counts = ", ".join(f"{a} {failures[i, j]}" for j, a in enumerate(ARITHMETICS))
        print(f"{form:14s}{counts}")
    cost()


# Cases


def part(n: float, k: float, n_accel: float) -> Part:
    gyro = Sensor("gyro", {"angle_random_walk": {"N": n}, "rate_random_walk": {"K": k}})
    return Part("made", 1 / H, gyro, Sensor("accel", {"angle_random_walk": {"N": n_accel}}))


def made(known: Part, moving: bool, n: int, std0, settings: dict, spoilt: float = 0.0):
    """Part, inputs (n, 12) and settings of a body whose sensors have the noise of ``known``.

    ``spoilt`` in m/s^2 is an acceleration for two seconds of ten.
    """
    scenario = Scenario("", moving=moving)
    truth = Drive(scenario, 1)
    k = np.arange(n + 1)
    attitude = truth.at(H * k)
    rng = np.random.default_rng(7)
    before, after = attitude[:-1], attitude[1:]
    earth = 7.292115e-5 * np.array([0, np.cos(LATITUDE), np.sin(LATITUDE)])
    rate = (before.inv() * after).as_rotvec() / H + before.apply(earth, inverse=True)
    n_gyro, n_accel = (
        float(np.ravel(s.values["angle_random_walk"]["N"])[0]) for s in (known.gyro, known.accel)
    )
    u = np.zeros((n, 12))
    u[:, :3] = rate + std0[3] + n_gyro / np.sqrt(H) * rng.standard_normal((n, 3))
    pushed = spoilt * ((H * k[1:, None]) % 10 < 2) * np.array([1.0, 0.0, 0.0])
    force = after.apply(np.array([0, 0, GRAVITY]) + pushed, inverse=True)
    u[:, 3:6] = force + n_accel / np.sqrt(H) * rng.standard_normal((n, 3))
    u[:, 6] = 25.0
    start = attitude[0] * Rotation.from_rotvec([std0[0], -std0[1], 0.0]).inv()
    given = {"q0": start.as_quat(scalar_first=True), "std0": np.asarray(std0, dtype=float)}
    return known, u, settings | given | {"latitude": LATITUDE}


KNOWN = [0.01, 0.01, 0.001, 1e-3, 1e-3, 1e-3]
UNKNOWN = [0.3, 0.3, 0.001, 0.1, 0.1, 0.1]
NOTHING = [0.3, 0.3, 1.5, 0.3, 0.3, 0.3]
CONSUMER, TACTICAL, EXACT = (1e-3, 2e-4, 1e-2), (6e-5, 3e-6, 5e-4), (1e-7, 1e-10, 1e-6)
CASES = {
    "consumer part, drive with pushes": lambda n: made(part(*CONSUMER), True, n, KNOWN, {}, 0.5),
    "consumer part, tilt and bias unknown": lambda n: made(part(*CONSUMER), True, n, UNKNOWN, {}),
    "consumer part, nothing known": lambda n: made(part(*CONSUMER), True, n, NOTHING, {}),
    "tactical part, drive": lambda n: made(part(*TACTICAL), True, n, KNOWN, {}),
    "tactical part at rest, no motion": lambda n: made(part(*TACTICAL), False, n, KNOWN, WHITE),
    "tactical part, tilt and bias unknown": lambda n: made(part(*TACTICAL), True, n, UNKNOWN, {}),
    "nearly exact part, drive": lambda n: made(part(*EXACT), True, n, KNOWN, {}),
    "nearly exact part, no motion": lambda n: made(part(*EXACT), True, n, KNOWN, WHITE),
    "nearly exact part, tilt and bias unknown": lambda n: made(
        part(*EXACT), True, n, UNKNOWN, WHITE
    ),
}


# Runs


def compare(name: str, known: Part, u: np.ndarray, settings: dict) -> set:
    """Print a case; gives the runs that fail, as places of form and arithmetic."""
    print(f"\n{name}\n{'':32s}{'not definite':>13s}{'std':>10s}{'attitude':>10s}")
    failed, root = set(), square_root_filter(known)
    p = parameters(root, settings)
    reference, _ = run(root, u, p, *ARITHMETICS["double"])
    for i, (form, filter_of) in enumerate(FORMS.items()):
        block = filter_of(known)
        for j, (arithmetic, way) in enumerate(ARITHMETICS.items()):
            y, kept = run(block, u, p, *way)
            share, std, attitude = errors(y, reference, kept, form)
            bad = not std <= LARGEST or share > 0
            failed |= {(i, j)} if bad else set()
            print(
                f"  {form:12s} {arithmetic:17s}{share:12.2%} {std:9.1e} {attitude:9.1e}"
                f"{'  fails' if bad else ''}"
            )
    return failed


def parameters(block: Block, values: dict) -> np.ndarray:
    """Start values of the block's parameters with some replaced, scalars or vectors by name."""
    at, p = {v.name: i for i, v in enumerate(block.parameters)}, block.start.copy()
    for name, value in values.items():
        names = [name] if np.ndim(value) == 0 else [f"{name}[{i + 1}]" for i in range(len(value))]
        p[[at[n] for n in names]] = value
    return p


def run(block: Block, u: np.ndarray, p: np.ndarray, real: str, rounded: int):
    """Outputs (n, ny), and each ``OFTEN``-th estimate (m, 55), in that arithmetic."""
    step, n = block.step, len(u)
    generator = ca.CodeGenerator("step.c", {"casadi_real": real})
    generator.add(step)
    sizes = {"NS": block.n_state, "NU": u.shape[1], "NP": len(p), "NY": len(block.outputs)}
    sizes |= {"SZ_ARG": step.sz_arg() + 5, "SZ_RES": step.sz_res() + 2, "STEP": step.name()}
    sizes |= {"SZ_W": step.sz_w() + 1, "SZ_IW": step.sz_iw() + 1}
    text = "".join(f"#define {k} {v}\n" for k, v in sizes.items())
    y, kept = np.empty((n, len(block.outputs))), np.empty((-(-n // OFTEN), 55))
    state = np.array(block.initial(block.start_inputs, p)[0], dtype=float).ravel()
    given = [np.ascontiguousarray(a) for a in (state, u, p)]
    compiled(generator.dump() + text + LOOP)(
        ctypes.c_int64(n),
        *[ctypes.c_void_p(a.ctypes.data) for a in given],
        ctypes.c_double(H),
        rounded,
        *[ctypes.c_void_p(a.ctypes.data) for a in (y, kept)],
        ctypes.c_int64(OFTEN),
    )
    return y, kept


@lru_cache
def compiled(source: str):
    """The loop of a C text; parts with the same effects have the same."""
    with tempfile.TemporaryDirectory() as folder:
        file, library = Path(folder, "run.c"), Path(folder, "run.so")
        file.write_text(source)
        flags = ["-O2", "-ffp-contract=off", "-fPIC", "-shared", "-w"]
        flags += ["-DCASADI_SYMBOL_EXPORT=static"]
        subprocess.run([*compiler_command(), *flags, file, "-o", library, "-lm"], check=True)
        return ctypes.CDLL(str(library)).run


def errors(y: np.ndarray, reference: np.ndarray, kept: np.ndarray, form: str):
    """Share of the samples without a definite covariance, largest errors of std and attitude.

    The covariance is that of attitude and bias: a body without motion has no variance of velocity.
    """
    upper = np.zeros((len(kept), 6, 6))
    upper[:, *np.triu_indices(6)] = kept[:, 7:28]
    lower = upper.transpose(0, 2, 1)
    if form == "square root":
        pivots = np.diagonal(lower, axis1=1, axis2=2)
        definite = np.isfinite(lower).all(axis=(1, 2)) & (pivots > 0).all(axis=1)
    else:
        whole = np.nan_to_num(upper + np.tril(lower, -1))
        std = np.sqrt(np.maximum(np.diagonal(whole, axis1=1, axis2=2), 1e-300))
        scaled = whole / (std[:, :, None] * std[:, None, :])
        definite = np.linalg.eigvalsh(scaled)[:, 0] > 0
    q, there = y[SETTLED:, :4], np.isfinite(y).all()
    if not there or np.abs(np.linalg.norm(q, axis=1) - 1).max() > 1e-3:
        return 1 - definite.mean(), np.nan, np.nan
    ours, theirs = y[SETTLED:, 10:16], reference[SETTLED:, 10:16]
    std_off = np.max(np.abs(ours / theirs - 1))
    turned = Rotation.from_quat(reference[SETTLED:, :4], scalar_first=True).inv()
    off = (turned * Rotation.from_quat(q, scalar_first=True)).as_rotvec()
    return 1 - definite.mean(), std_off, np.max(np.abs(off) / theirs[:, :3])


# Time


def cost(n: int = 60_000, rounds: int = 5) -> None:
    """Time of a step of each form, and of the fast filter, by turns."""
    known, u, settings = CASES["tactical part, drive"](n)
    blocks = {name: f(known) for name, f in {**FORMS, "fast filter": attitude_ukf}.items()}
    best = {}
    for _ in range(rounds + 1):
        for name, block in blocks.items():
            p = parameters(block, settings)
            start = time.perf_counter()
            block.run(u, p=p)
            best[name] = min(best.get(name, np.inf), time.perf_counter() - start)
    print("\ntime of a step, double precision, fastest of some rounds")
    for name, seconds in best.items():
        ratio = seconds / best["covariance"]
        print(f"{name:14s}{seconds / n * 1e9:8.0f} ns, {ratio:.2f} of the covariance form")


if __name__ == "__main__":
    main(*(float(a) for a in sys.argv[1:]))
