"""The attitude filter's speed: a step against vqf and filterpy on the same log, and a four-hour log
from Python.

``python benchmarks/filter_speed.py [samples]``; needs vqf and filterpy, which the package itself
does not. The filter is the FMU's C (gcc -O3 for this processor, no fast-math, no contracted
multiply-adds), with vectors where the processor has AVX2, run by ``Block.run``; vqf its C++ through
its Python package, in one batch. They run by turns, and of each the round of the least processor
time counts, which is the one that others on the machine disturbed least.
"""

import sys
import time
from statistics import median

import casadi as ca
import numpy as np

import pyimu
from pyimu.attitude import attitude_ukf
from pyimu.attitude.filter.variables import MAG
from pyimu.block.compiled import compiler_command, flags

SAMPLES = 400_000
ROUNDS = 15
FILTERPY_STEPS = 1_000
FOUR_HOURS = 4 * 3600 * 976
GRAVITY = 9.80665
RATE = np.array([0.3, 0.2, 0.4])


def main(samples: int = SAMPLES, hours: int = FOUR_HOURS) -> None:
    try:
        from vqf import VQF
    except ImportError:
        print("vqf, the peer, is not installed: pip install vqf")
        return
    block = attitude_ukf(pyimu.part("imt30"))
    step = block.step
    rows = drive(samples)
    ways = {
        "propagate": (rows, settings(block, update=False), "0.9"),
        "propagate, gravity update": (rows, settings(block, update=True), "1.4"),
        "the same, scale factors": (rows, settings(block, update=True, scale_std=0.02), None),
        "at rest": (at_rest(rows), block.start, None),
        "with magnetometer": (with_magnetometer(rows), settings(block, update=True), None),
    }
    command = [*compiler_command(), *flags(compiler_command())]
    print(f"{samples} samples, fastest of {ROUNDS} rounds; {' '.join(command)}")
    best = {}
    for name, (u, p, goal) in ways.items():
        rounds = [measure(block, u, p, VQF) for _ in range(ROUNDS + 1)][1:]
        ours, theirs = (min(r[i] for r in rounds) for i in range(2))
        best[name] = ours
        aim = "" if goal is None else f"goal at most {goal}; "
        print(
            f"{name:28s}{ours:8.0f} ns a step, vqf {theirs:.0f}, {ours / theirs:.2f} of it ({aim}"
            f"median of the rounds' ratios {median(a / b for a, b in rounds):.2f}); "
            f"updated in {share_updated(block, u, p):.0%} of the steps"
        )
    against_filterpy(best["propagate, gravity update"])
    print(f"instructions of casadi's functions: {instructions(step)}")
    four_hours(block, ways["propagate, gravity update"][1], hours)


def drive(n: int) -> np.ndarray:
    """Inputs (n, 18) of a slow motion about all axes at 976 Hz, with white noise; no heading, no
    magnetometer, never called stationary.
    """
    rng, t = np.random.default_rng(1), np.arange(n) / 976.0
    u = np.zeros((n, 18))
    for i, (size, omega) in enumerate(((0.3, 0.5), (0.2, 0.7), (0.4, 0.3))):
        u[:, i] = size * np.sin(omega * t)
    u[:, 3:6] = [0.0, 0.0, GRAVITY]
    u[:, :6] += rng.standard_normal((n, 6)) * [0.002] * 6
    u[:, 6] = 25.0
    return u


def at_rest(rows: np.ndarray) -> np.ndarray:
    """The same inputs of a body that does not turn: the white noise of the gyro alone."""
    out = rows.copy()
    out[:, :3] = np.random.default_rng(2).standard_normal((len(rows), 3)) * 0.002
    return out


def with_magnetometer(rows: np.ndarray) -> np.ndarray:
    """The same inputs with a sample of a field of 45 uT at each step, and its white noise."""
    out = rows.copy()
    noise = np.random.default_rng(3).standard_normal((len(rows), 3)) * 2e-7
    out[:, MAG] = [0.0, 2e-5, -4e-5] + noise
    return out


def settings(block, update: bool, scale_std: float = 0.0) -> np.ndarray:
    """Parameters with a gravity update at each step, or at none: by tolerances that all pass, or
    that none does; and with a gyro that is calibrated, or whose scale factors are off.

    The bias is known well enough for the attitude not to be lost within the log, which would be
    bounded at each step.
    """
    at, p = {v.name: i for i, v in enumerate(block.parameters)}, block.start.copy()
    for name in ("gravity_tolerance", "motion_tolerance", "steady_tolerance"):
        p[at[name]] = 1e3 if update else 0.0
    if not update:  # else the mean force is measured as well, and then the velocity
        p[at["accel_std"]] = 0.0
    # A tilt that is not known has no velocity for a measurement of gravity.
    p[[at[f"std0[{i}]"] for i in (1, 2, 3)]] = 0.01 if update else 0.15
    p[[at[f"std0[{i}]"] for i in (4, 5, 6)]] = 1e-4
    p[at["scale_std"]] = scale_std
    return p


def measure(block, rows, p, peer) -> tuple[float, float]:
    """ns a step in one round, of this filter and of the peer, which takes the same sensors."""
    sensors = [np.ascontiguousarray(rows[:, at]) for at in (slice(0, 3), slice(3, 6), MAG)]
    if not sensors[2].any():
        del sensors[2]
    filter_ = peer(block.sample_period)
    theirs = busy(lambda: filter_.updateBatch(*sensors))
    ours = busy(lambda: block.run(rows, p=p))
    return ours / len(rows) * 1e9, theirs / len(rows) * 1e9


def share_updated(block, rows, p) -> float:
    y, _ = block.run(rows, p=p)
    return float(np.mean(y[:, [v.name for v in block.outputs].index("nis")] > 0))


def clock(call) -> float:
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def busy(call) -> float:
    """s of processors that a call takes."""
    start = time.process_time()
    call()
    return time.process_time() - start


def against_filterpy(ours: float) -> None:
    """filterpy's filter of six states and three measurements: with this filter's models, and with
    models that do nothing.
    """
    try:
        from filterpy.kalman import MerweScaledSigmaPoints, UnscentedKalmanFilter
    except ImportError:
        print("filterpy, the slow peer, is not installed: pip install filterpy")
        return
    for title, fx, hx in (
        ("these models in numpy", turned_error, gravity_seen),
        ("models that do nothing", lambda x, dt: x, lambda x: x[:3]),
    ):
        points = MerweScaledSigmaPoints(6, 0.1, 2.0, -3.0)
        peer = UnscentedKalmanFilter(dim_x=6, dim_z=3, dt=1 / 976, fx=fx, hx=hx, points=points)
        peer.P, peer.Q, peer.R, z = (
            np.eye(6) * 1e-4,
            np.eye(6) * 1e-9,
            np.eye(3),
            np.array([0, 0, GRAVITY]),
        )

        def steps(peer=peer, z=z):
            for _ in range(FILTERPY_STEPS):
                peer.predict()
                peer.update(z)

        theirs = min(busy(steps) for _ in range(5)) / FILTERPY_STEPS * 1e9
        print(
            f"{'filterpy':28s}{theirs:8.0f} ns a step with {title}: {theirs / ours:.0f} times ours "
            "with its update" + (" (goal at least 1000)" if fx is turned_error else "")
        )


def product(a, b):
    return np.array(
        [
            a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
            a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
            a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
            a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
        ]
    )


def from_rodrigues(p):
    square = p @ p
    return np.concatenate([[16 - square], 8 * p]) / (16 + square)


def exponential(angle):
    size = np.sqrt(angle @ angle) / 2
    return np.concatenate([[np.cos(size)], np.sinc(size / np.pi) / 2 * angle])


def turned_error(x, h):
    """A sigma point of attitude error and bias after a turn, as
    ``pyimu.attitude.filter.sigma_point_filter.propagate`` has it.
    """
    left = product(
        product(exponential(-RATE * h), from_rodrigues(x[:3])), exponential((RATE - x[3:]) * h)
    )
    return np.concatenate([4 * left[1:] / (1 + left[0]), x[3:]])


def gravity_seen(x):
    """The force at rest in body axes for a sigma point."""
    q = from_rodrigues(-x[:3])
    return product(product(q, np.array([0, 0, 0, GRAVITY])), q * [1, -1, -1, -1])[1:]


def instructions(step: ca.Function) -> str:
    """Instructions of the functions that the step calls: that of the constants once for many
    samples, always that which chooses the row, one of the rows, and one of the updates.
    """
    counted = {f.name(): f.n_instructions() for f in step.find_functions() if f.is_a("SXFunction")}
    return ", ".join(f"{name} {n}" for name, n in counted.items())


def four_hours(block, p: np.ndarray, n: int) -> None:
    """The whole of ``pyimu.attitude.run``, alignment included, on a recording in memory."""
    chunk, times = drive(min(n, 976_000)), -(-n // 976_000)
    gyro, accel = (np.tile(chunk[:, at], (times, 1))[:n] for at in (slice(0, 3), slice(3, 6)))
    log = pyimu.Recording.from_arrays(
        time=np.arange(n) / 976.0, gyro=gyro, accel=accel, temperature=np.full(n, 25.0)
    )
    settings = {
        v.name: value for v, value in zip(block.parameters, p, strict=True) if "tolerance" in v.name
    }
    one = {}
    for smooth in (False, True):
        found, before = [], time.process_time()

        def whole(smooth=smooth, found=found):
            part = pyimu.part("imt30")
            found.append(pyimu.attitude.run(log, part, settings=settings, smooth=smooth))

        seconds = clock(whole)
        taken = time.process_time() - before
        one[smooth] = taken
        print(
            f"{n} samples at 976 Hz ({n / 976 / 3600:.2g} h) by pyimu.attitude.run"
            f"{', smoothed' * smooth}: {seconds:.1f} s, {taken:.1f} s of processors, "
            + (
                f"{taken / one[False]:.2f} of the filter's (goal at most 3)"
                if smooth
                else f"an update in {np.mean(found[0].nis > 0):.0%} of the steps (goal 10 s for "
                f"{FOUR_HOURS})"
            )
        )


if __name__ == "__main__":
    main(*(int(a) for a in sys.argv[1:]))
