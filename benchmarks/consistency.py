"""Is the attitude filter as good as it says? Normalised errors of many simulated drives against
their chi-square bands.

``python benchmarks/consistency.py [drives]`` prints one table: at ten instants fixed beforehand,
the mean over the drives of the normalised estimation error squared (six states; tilt, heading and
bias apart) and of the normalised innovation squared, each over its degrees of freedom. The model
is matched and the initial errors are drawn from the initial covariance, so every sum is chi-square
(Bar-Shalom, Li and Kirubarajan 2001, section 5.4); all bands together hold with 99 %. Where the
filter's model is wider than the noise, as for correlated noise in its few states, the mean only has
to stay below the upper end of its band. ``--sol [runs]`` does the same over 24.6 h at 100 Hz, each
in one run, and also looks at the definiteness of the covariance and the length of the quaternion.
``--smooth [drives]`` is the table of the smoothed estimates of the scenarios whose model is
matched: each instant is then estimated by all 120 s. The innovation stays the filter's.
"""

import sys
from dataclasses import dataclass

import numpy as np
from drives.attitude import (
    LATITUDE,
    STD0,
    WHITE,
    Drive,
    H,
    K,
    N,
    Noise,
    Scenario,
    part,
)
from scipy.spatial.transform import Rotation
from scipy.stats import chi2

from pyimu.attitude import attitude_ukf, run
from pyimu.attitude.filter.passed import AFTER
from pyimu.attitude.filter.smoother import MEAN, last_belief, smoother
from pyimu.attitude.filter.ukf import recorded_ukf
from pyimu.block.block import Run
from pyimu.recording.recording import Recording

FAMILY = 0.01
"""Probability that a right filter leaves any of the bands of a table."""

DRIVES, SOL_RUNS = 400, 6
SOL = 24.6 * 3600
INSTANTS = np.array([0.5, 1, 2, 5, 10, 20, 40, 60, 90, 120.0])
"""s; those of a sol are these times ``SOL`` / 120."""

SECOND_ORDER = 0.01
"""Relative difference that the variances of a resting body may have from those of a linear system.
"""

KINDS = {"state": 6, "tilt": 2, "heading": 1, "bias": 3, "innovation": 3}
"""Degrees of freedom of what is tested."""

OFTEN = 100
"""Samples after which the covariance's definiteness is looked at again."""

ERRORS = ("state", "tilt", "heading", "bias")
REST = Scenario("at rest, gravity alone", moving=False)
SCENARIOS = (
    Scenario("gravity alone"),
    Scenario("headings each second", every=1.0),
    Scenario("headings each second, 0.3 s late", every=1.0, late=0.3),
    REST,
    # A measured rate squared has its own noise in it, a percent of the noise that it stands for.
    Scenario(
        "relative rate noise, each axis by itself",
        every=1.0,
        noise=Noise(1e-4, 1e-6, relative=(5e-3, 0.0)),
    ),
    Scenario(
        "relative rate noise, over all axes",
        every=1.0,
        noise=Noise(1e-4, 1e-6, relative=(0.0, 5e-3)),
        fixed=WHITE | {"rate_noise": 5e-3},
    ),
    # White noise and a walk that are wider than the process: the filter has no state for it.
    Scenario(
        "gyro with Gauss-Markov noise",
        every=1.0,
        noise=Noise(1e-4, 1e-6, correlated=(2e-3, 10.0)),
        bounded=ERRORS,
    ),
    # White noise of the process' density at zero: above its corner there is less.
    Scenario(
        "acceleration of half a second",
        noise=Noise(force=(0.05, 0.5)),
        bounded=ERRORS,
        fixed=WHITE | {"accel_std": 0.05, "accel_correlation_time": 0.5},
    ),
    # The velocity of a sway is no white noise: what it has at low frequencies is less.
    Scenario("swaying", noise=Noise(sway=(4.0, 0.06)), bounded=ERRORS, fixed={}),
)

MATCHED = tuple(s for s in SCENARIOS if not s.bounded)
"""Those whose noise is what the filter's model says, no less and no more."""


def main(drives: int = DRIVES, smooth: bool = False) -> bool:
    print(
        f"{'smoothed, ' * smooth}{drives} drives of {INSTANTS[-1]:g} s at {1 / H:g} Hz; mean "
        f"squares over degrees of freedom, bands of {FAMILY:.0%} for all together"
    )
    scenarios = MATCHED if smooth else SCENARIOS
    bands = Bands(len(scenarios) * len(INSTANTS) * len(KINDS))
    right = True
    for scenario in scenarios:
        sums = (simulate_smoothed if smooth else simulate)(scenario, drives, INSTANTS)
        right &= table(scenario, INSTANTS, sums, bands)
    return right if smooth else right & rest_table()


# Statistics


@dataclass(frozen=True)
class Bands:
    """Chi-square bands of ``tests`` tests that hold all together with 1 - ``FAMILY``
    (Bonferroni).
    """

    tests: int

    def of(self, degrees: float) -> np.ndarray:
        outside = FAMILY / self.tests / 2
        return chi2.ppf([outside, 1 - outside], degrees) / degrees


@dataclass
class Sums:
    """Per instant and kind the sum of squares (m, kinds) and its degrees of freedom; the worst of
    the norm and of the covariance.
    """

    squares: np.ndarray
    degrees: np.ndarray
    heading_variance: np.ndarray
    vertical_bias_variance: np.ndarray
    norm: float = 0.0
    least_eigenvalue: float = np.inf


def outside(sums: Sums, bands: Bands, bounded: tuple[str, ...] = ()) -> list[tuple[int, str]]:
    """Instants and kinds whose mean leaves its band; of a scenario whose model stands for more,
    only the ``bounded`` kinds above it.
    """
    out = []
    for i, j in np.ndindex(sums.squares.shape):
        low, high = bands.of(sums.degrees[i, j])
        mean, kind = (
            sums.squares[i, j] / sums.degrees[i, j] if sums.degrees[i, j] else np.nan,
            list(KINDS)[j],
        )
        if mean >= high if bounded else not low < mean < high:
            out += [(i, kind)] if not bounded or kind in bounded else []
    return out


def table(scenario: Scenario, instants: np.ndarray, sums: Sums, bands: Bands) -> bool:
    bounded = " (not above: the filter's model is wider than the noise)" if scenario.bounded else ""
    print(f"\n{scenario.name}{bounded}\n{'t [s]':>9s}" + "".join(f"{kind:>26s}" for kind in KINDS))
    wrong = outside(sums, bands, scenario.bounded)
    for i, t in enumerate(instants):
        cells = []
        for j, kind in enumerate(KINDS):
            low, high = bands.of(sums.degrees[i, j])
            mark = "!" if (i, kind) in wrong else " "
            cells.append(
                f"{sums.squares[i, j] / max(sums.degrees[i, j], 1):9.3f}{mark}[{low:.3f}, "
                f"{high:.3f}]"
            )
        print(f"{t:9g}" + "".join(f"{cell:>26s}" for cell in cells))
    print(
        f"  {'every mean is inside its band' if not wrong else f'{len(wrong)} means outside'}; "
        f"norm of q within {sums.norm:.1e} of 1, "
        f"least eigenvalue of the scaled covariance each {OFTEN} samples "
        f"{sums.least_eigenvalue:.2e}"
    )
    return not wrong


def rest_table() -> bool:
    """At rest nothing is learnt of heading and vertical bias: s^2 + N^2 t + K^2 t^3/3 + s_b^2 t^2,
    and s_b^2 + K^2 t.

    To second order of the heading's standard deviation, which is 0.36 rad at the end; the Earth's
    rate tells a little, too.
    """
    sums = simulate(REST, 1, INSTANTS)
    heading, bias = expected_at_rest(INSTANTS)
    off = [
        np.abs(got / want - 1)
        for got, want in ((sums.heading_variance, heading), (sums.vertical_bias_variance, bias))
    ]
    print(
        "\nat rest without a heading, variance over N^2 t + K^2 t^3/3 + s_b^2 t^2 + s^2: off by "
        f"at most {off[0].max():.1e}; "
        f"vertical bias over s_b^2 + K^2 t: off by at most {off[1].max():.1e} (goal "
        f"{SECOND_ORDER:g})"
    )
    return max(o.max() for o in off) < SECOND_ORDER


def expected_at_rest(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Variances (n,) of heading and vertical bias after ``t`` s of rest (Crassidis and Markley
    2003, eq. 27, summed).
    """
    bias = STD0[5] ** 2
    return STD0[2] ** 2 + N**2 * t + K**2 * t**3 / 3 + bias * t**2, bias + K**2 * t


# Simulation


def start_of(block, scenario: Scenario, drive: Drive) -> np.ndarray:
    """The parameters with which the filter of a drive starts."""
    q0 = drive.q0.as_quat(scalar_first=True)
    return parameters(block, q0=q0, std0=STD0, latitude=LATITUDE, **scenario.fixed)


def simulate(scenario: Scenario, drives: int, instants: np.ndarray, first_seed: int = 0) -> Sums:
    """Squares summed over ``drives``, whose motion, noise and initial error all follow from their
    seed.
    """
    block, stops = attitude_ukf(part(scenario.noise)), np.round(instants / H).astype(int)
    sums = no_sums(len(stops))
    for seed in range(first_seed, first_seed + drives):
        drive = Drive(scenario, seed)
        steps = Run(block, stops[-1], p=start_of(block, scenario, drive))
        for i, rows in enumerate(np.diff(stops, prepend=0)):
            for u, truth, bias in drive.rows(rows):
                for start in range(0, len(u), OFTEN):
                    y = steps.advance(u[start : start + OFTEN])
                    sums.norm = max(sums.norm, np.abs(np.linalg.norm(y[:, :4], axis=1) - 1).max())
                    sums.least_eigenvalue = min(
                        sums.least_eigenvalue, least_eigenvalue(steps.state)
                    )
            score(sums, i, steps.state, y[-1, 17], truth, bias)
    return sums


def no_sums(instants: int) -> Sums:
    return Sums(
        *(np.zeros((instants, len(KINDS))) for _ in range(2)),
        np.zeros(instants),
        np.zeros(instants),
    )


def simulate_smoothed(scenario: Scenario, drives: int, instants: np.ndarray) -> Sums:
    """The same of the smoothed estimates: each instant by all samples up to the last one."""
    block, stops = recorded_ukf(part(scenario.noise)), np.round(instants / H).astype(int)
    sums = no_sums(len(stops))
    for seed in range(drives):
        drive = Drive(scenario, seed)
        pieces = [list(drive.rows(count)) for count in np.diff(stops, prepend=0)]
        u = np.vstack([u for several in pieces for u, _, _ in several])
        rows, _ = block.run(u, p=start_of(block, scenario, drive))
        for i, state in smoothed_states(rows, stops):
            _, truth, bias = pieces[i][-1]
            sums.norm = max(sums.norm, abs(np.linalg.norm(state[:4]) - 1))
            sums.least_eigenvalue = min(sums.least_eigenvalue, least_eigenvalue(state))
            score(sums, i, state, rows[stops[i] - 1, 17], truth, bias)
    return sums


def smoothed_states(rows: np.ndarray, stops: np.ndarray):
    """Number, and smoothed q (4), bias (3) and packed covariance (21), of each of the ``stops``.

    ``rows`` are those of the recorded filter.
    """
    belief = np.array(last_belief()(rows[-1, AFTER])).ravel()
    back = Run(smoother(), len(rows), state=belief)
    for i in reversed(range(len(stops))):
        after = rows[stops[i] - 1, AFTER]
        yield i, smoothed_state(after, back.state)
        back.advance(rows[stops[i - 1] if i else 0 : stops[i]][::-1])


def smoothed_state(after: np.ndarray, belief: np.ndarray) -> np.ndarray:
    """A filter's estimate ``after`` a sample with what a smoother knows of its error."""
    q, size = Rotation.from_quat(after[:4], scalar_first=True), np.linalg.norm(belief[:3])
    error = belief[:3] * (4 * np.arctan(size / 4) / size if size else 1)
    up = q.as_matrix()[2]
    axes, covariance = np.eye(6), np.zeros((9, 9))
    # The vertical is turned along, and the covariance with it.
    axes[:3, :3] = Rotation.from_rotvec(error - up * (up @ error)).as_matrix().T
    covariance[np.triu_indices(9)] = belief[MEAN:]
    covariance += np.triu(covariance, 1).T
    turned = axes @ covariance[:6, :6] @ axes.T
    q = (q * Rotation.from_rotvec(error)).as_quat(scalar_first=True)
    return np.concatenate([q, after[4:7] + belief[3:6], turned[np.triu_indices(6)]])


def aligned(scenario: Scenario, drives: int, instants: np.ndarray, **more) -> np.ndarray:
    """Squares (m, 6) of ``run``'s errors over its standard deviations, attitude and bias in body
    axes, summed over ``drives``.

    It aligns itself in the rest that each starts with; of the start it is told the heading, and in
    ``more`` what the recordings have beside.
    """
    rows, squares = np.round(instants / H).astype(int) - 1, np.zeros((len(instants), 6))
    for seed in range(drives):
        drive = Drive(scenario, seed)
        pieces = [drive.rows(count) for count in np.diff(rows + 1, prepend=0)]
        u, truth, bias = zip(*[piece for several in pieces for piece in several], strict=True)
        u = np.vstack(u)
        recording = Recording.from_arrays(
            time=H * np.arange(len(u)), gyro=u[:, :3], accel=u[:, 3:6], **more
        )
        found = run(
            recording,
            part(scenario.noise),
            latitude=LATITUDE,
            heading0=drive.attitude.as_euler("ZYX")[0],
            settings=scenario.fixed,
        )
        error = (
            Rotation.from_quat(found.q[rows], scalar_first=True).inv() * Rotation.concatenate(truth)
        ).as_rotvec()
        squares += (
            np.hstack([error, np.array(bias) - found.gyro_bias[rows]]) / found.std[rows]
        ) ** 2
    return squares


def parameters(block, **values) -> np.ndarray:
    at, p = {v.name: i for i, v in enumerate(block.parameters)}, block.start.copy()
    for name, value in values.items():
        names = [name] if np.ndim(value) == 0 else [f"{name}[{i + 1}]" for i in range(len(value))]
        p[[at[n] for n in names]] = value
    return p


def score(
    sums: Sums, i: int, state: np.ndarray, nis: float, truth: Rotation, bias: np.ndarray
) -> None:
    """Add one drive at instant ``i``: its errors normalised by the filter's own covariance."""
    estimate = Rotation.from_quat(state[:4], scalar_first=True)
    covariance = covariance_of(state)
    error = np.concatenate([(estimate.inv() * truth).as_rotvec(), bias - state[4:7]])
    axes = np.eye(6)
    axes[:3, :3] = estimate.as_matrix()
    world = axes @ covariance @ axes.T
    error = axes @ error
    groups = {
        "state": slice(0, 6),
        "tilt": slice(0, 2),
        "heading": slice(2, 3),
        "bias": slice(3, 6),
    }
    squares = [error[g] @ np.linalg.solve(world[g, g], error[g]) for g in groups.values()] + [nis]
    sums.squares[i] += squares
    sums.degrees[i] += [*(KINDS[g] for g in groups), KINDS["innovation"] * (nis > 0)]
    up = estimate.as_matrix()[2]
    sums.heading_variance[i], sums.vertical_bias_variance[i] = (
        world[2, 2],
        up @ covariance[3:, 3:] @ up,
    )


def least_eigenvalue(state: np.ndarray) -> float:
    """Of the covariance scaled to a diagonal of ones: above zero where it is definite."""
    covariance = covariance_of(state)
    scale = np.sqrt(np.diag(covariance))
    return float(np.linalg.eigvalsh(covariance / np.outer(scale, scale)).min())


def covariance_of(state: np.ndarray) -> np.ndarray:
    p = np.zeros((6, 6))
    p[np.triu_indices(6)] = state[7:28]
    return p + np.triu(p, 1).T


def sol(runs: int = SOL_RUNS) -> bool:
    instants = INSTANTS * SOL / INSTANTS[-1]
    scenario = Scenario("headings each minute", every=60.0)
    print(
        f"{runs} sols of {SOL / 3600:g} h, {round(SOL / H)} steps each in one run; bands of "
        f"{FAMILY:.0%} for all together"
    )
    sums = simulate(scenario, runs, instants)
    right = table(scenario, instants, sums, Bands(len(instants) * len(KINDS)))
    return right and sums.norm < 1e-12 and sums.least_eigenvalue > 0


if __name__ == "__main__":
    numbers = [int(a) for a in sys.argv[1:] if not a.startswith("--")]
    smoothed = {"smooth": True} if "--smooth" in sys.argv else {}
    sys.exit(not (sol if "--sol" in sys.argv else main)(*numbers, **smoothed))
