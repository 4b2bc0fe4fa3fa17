"""Is the attitude filter as good as it says? Normalised errors of many simulated drives against
their chi-square bands.

``python benchmarks/consistency.py [drives]`` prints one table: at ten instants fixed beforehand,
the mean over the drives of the normalised estimation error squared (six states; tilt, heading and
bias apart) and of the normalised innovation squared, each over its degrees of freedom. The model
is matched and the initial errors are drawn from the initial covariance, so every sum is chi-square
(Bar-Shalom, Li and Kirubarajan 2001, section 5.4); all bands together hold with 99 %.  Where the
filter's model stands for the noise from above, as for correlated noise in its few states, the mean
is only held below its band's upper end. ``--sol [runs]`` does the same over 24.6 h at 100 Hz, each
in one run, and reports the covariance's definiteness and the norm.
"""

import sys
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from scipy.signal import lfilter
from scipy.spatial.transform import Rotation
from scipy.stats import chi2

from pyimu.attitude import attitude_ukf, run
from pyimu.block.block import Run
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.recording.recording import Recording

H, GRAVITY, LATITUDE = 0.01, 9.80665, 0.8
EARTH = 7.292115e-5 * np.array([0, np.cos(LATITUDE), np.sin(LATITUDE)])
N, K, N_ACCEL = 1e-3, 2e-5, 1e-2
STD0 = np.array([0.03, 0.03, 0.05, 0.003, 0.003, 0.003])
HEADING_STD = 0.02
FAMILY = 0.01
"""Probability that a right filter leaves any of the bands of a table."""

DRIVES, SOL_RUNS = 400, 6
SOL = 24.6 * 3600
INSTANTS = np.array([0.5, 1, 2, 5, 10, 20, 40, 60, 90, 120.0])
"""s; those of a sol are these times ``SOL`` / 120."""

SECOND_ORDER = 0.01
"""Relative difference that the variances of a resting body may have from those of a linear system.
"""

CHUNK = 200_000
KINDS = {"state": 6, "tilt": 2, "heading": 1, "bias": 3, "innovation": 3}
"""Degrees of freedom of what is tested."""


WHITE = {"accel_std": 0.0, "accel_correlation_time": 0.0, "mean_time": 0.0}
"""Settings under which a sample of specific force is gravity and white noise, and nothing else is
used."""

OFTEN = 100
"""Samples after which the covariance's definiteness is looked at again."""


@dataclass(frozen=True)
class Noise:
    """What the sensors and the motion add: ``n``, ``k`` of the gyro's random walks; of a
    Gauss-Markov process in it the standard deviation in rad/s and the s that it is ``correlated``;
    ``relative`` root densities of the rate's relative error, one axis by itself and over all axes;
    of the body's acceleration the same as of the gyro's, ``force`` m/s^2 and s, and of a ``sway``
    the m/s^2 and velocity over acceleration in s.
    """

    n: float = N
    k: float = K
    correlated: tuple[float, float] = (0.0, 1.0)
    relative: tuple[float, float] = (0.0, 0.0)
    force: tuple[float, float] = (0.0, 1.0)
    sway: tuple[float, float] = (0.0, 1.0)


@dataclass(frozen=True)
class Scenario:
    """``moving``: the body turns in place, after a ``rest`` of some s, else it rests level;
    ``every`` s between headings (0: none), ``late`` s old.

    ``fixed`` are settings of the filter; ``bounded`` are the kinds of which it claims no more than
    it knows, where that is all it claims.
    """

    name: str
    moving: bool = True
    rest: float = 0.0
    every: float = 0.0
    late: float = 0.0
    fixed: dict = field(default_factory=lambda: WHITE)
    noise: Noise = Noise()
    bounded: tuple[str, ...] = ()


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
    # The scatter of all axes counts for each, and the mean of a sway over a second falls to less.
    Scenario("swaying, mean force alone", noise=Noise(sway=(4.0, 0.06)), bounded=ERRORS, fixed={}),
)


def main(drives: int = DRIVES) -> bool:
    print(
        f"{drives} drives of {INSTANTS[-1]:g} s at {1 / H:g} Hz; mean squares over degrees of "
        f"freedom, bands of {FAMILY:.0%} for all together"
    )
    bands = Bands(len(SCENARIOS) * len(INSTANTS) * len(KINDS))
    right = True
    for scenario in SCENARIOS:
        sums = simulate(scenario, drives, INSTANTS)
        right &= table(scenario, INSTANTS, sums, bands)
    right &= rest_table()
    return right


# Statistics


@dataclass(frozen=True)
class Bands:
    """Chi-square bands of ``tests`` tests that hold all together with 1 - ``FAMILY``
    (Bonferroni).
    """

    tests: int

    def of(self, degrees: float) -> np.ndarray:
        tail = FAMILY / self.tests / 2
        return chi2.ppf([tail, 1 - tail], degrees) / degrees


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


def part(noise: Noise = Noise()) -> Part:
    effects = {"angle_random_walk": {"N": noise.n}, "rate_random_walk": {"K": noise.k}}
    std, tau = noise.correlated
    if std:
        effects["gauss_markov"] = {"q": std * np.sqrt(2 / tau), "tau": tau}
    if noise.relative[0]:
        effects["rate_dependent_noise"] = {"k": noise.relative[0]}
    return Part(
        "matched",
        1 / H,
        Sensor("gyro", effects),
        Sensor("accel", {"angle_random_walk": {"N": N_ACCEL}}),
    )


def simulate(scenario: Scenario, drives: int, instants: np.ndarray, first_seed: int = 0) -> Sums:
    """Squares summed over ``drives``, whose motion, noise and initial error all follow from their
    seed.
    """
    block, stops = attitude_ukf(part(scenario.noise)), np.round(instants / H).astype(int)
    sums = Sums(
        *(np.zeros((len(stops), len(KINDS))) for _ in range(2)),
        np.zeros(len(stops)),
        np.zeros(len(stops)),
    )
    for seed in range(first_seed, first_seed + drives):
        drive = Drive(scenario, seed)
        steps = Run(
            block,
            stops[-1],
            p=parameters(
                block,
                q0=drive.q0.as_quat(scalar_first=True),
                std0=STD0,
                latitude=LATITUDE,
                **scenario.fixed,
            ),
        )
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


class Drive:
    """One drive, made in pieces: the truth in closed form, the sensors' noise, and the error that
    the filter starts with.
    """

    def __init__(self, scenario: Scenario, seed: int) -> None:
        self.scenario, self.rng, self.sample = scenario, np.random.default_rng(seed), 0
        self.omega = self.rng.uniform(0.1, 0.8, (3, 2))
        self.size = scenario.moving * self.rng.uniform(0.1, 0.4, (3, 2))
        self.phase = self.rng.uniform(0, 2 * np.pi, (3, 2))
        error = STD0 * self.rng.standard_normal(6)
        self.bias = error[3:]
        self.attitude = self.at(np.zeros(1))[0]
        self.q0 = self.attitude * Rotation.from_rotvec(error[:3]).inv()
        std, slowness = scenario.noise.sway
        self.sway = (
            std * np.sqrt(2),
            self.rng.uniform(0.8, 1.25, 3) / slowness,
            self.rng.uniform(0, 2 * np.pi, 3),
        )
        self.slow = np.zeros((2, 3))

    def at(self, t: np.ndarray) -> Rotation:
        """The attitude (n) at ``t`` (n,) s: yaw, pitch and roll each of two sines, yaw turning on;
        at rest level.
        """
        t = np.maximum(t - self.scenario.rest, 0)
        angles = np.sum(self.size * np.sin(self.omega * t[:, None, None] + self.phase), axis=2)
        angles[:, 0] += self.scenario.moving * 0.2 * t
        return Rotation.from_euler("ZYX", angles)

    def rows(self, n: int) -> Iterator[tuple[np.ndarray, Rotation, np.ndarray]]:
        """Inputs (m, 12) of the next ``n`` samples in pieces, and attitude and bias (3,) at the end
        of each.
        """
        for start in range(0, n, CHUNK):
            yield self._piece(min(CHUNK, n - start))

    def _piece(self, n: int) -> tuple[np.ndarray, Rotation, np.ndarray]:
        k, own = self.sample + np.arange(n + 1), self.scenario.noise
        attitude = self.at(H * k)
        before, after = attitude[:-1], attitude[1:]
        rate = (before.inv() * after).as_rotvec() / H + before.apply(EARTH, inverse=True)
        noise = self.rng.standard_normal((3, n, 3))
        bias = self.bias + own.k * np.sqrt(H) * np.cumsum(noise[0], axis=0)
        # Of a bias that walks within a period the mean counts, and its noise is that of N; the
        # filter's Q has both.
        mean = np.vstack([self.bias, bias[:-1]]) / 2 + bias / 2
        u = np.zeros((n, 12))
        slow = self._correlated(0, n, *own.correlated)
        u[:, :3] = (
            rate
            + mean
            + slow
            + np.hypot(own.n / np.sqrt(H), own.k * np.sqrt(H / 12)) * noise[1]
            + self._relative(rate)
        )
        acceleration = self._correlated(1, n, *own.force) + self._swaying(H * k[1:])
        u[:, 3:6] = (
            after.apply(acceleration + [0, 0, GRAVITY], inverse=True)
            + N_ACCEL / np.sqrt(H) * noise[2]
        )
        u[:, 6] = 25.0
        self._headings(u, k[1:])
        self.sample, self.bias = self.sample + n, bias[-1]
        return u, after[-1], self.bias + slow[-1]

    def _correlated(self, which: int, n: int, std: float, tau: float) -> np.ndarray:
        """The next ``n`` samples (n, 3) of a Gauss-Markov process, which starts at zero as the
        initial bias error is drawn apart.
        """
        if not std:
            return np.zeros((n, 3))
        keep = np.exp(-H / tau)
        driven = std * np.sqrt(1 - keep**2) * self.rng.standard_normal((n, 3))
        out = lfilter([1.0], [1.0, -keep], driven, axis=0, zi=keep * self.slow[which][None])[0]
        self.slow[which] = out[-1]
        return out

    def _relative(self, rate: np.ndarray) -> np.ndarray:
        one, all_axes = self.scenario.noise.relative
        if not one and not all_axes:
            return np.zeros_like(rate)
        size = np.hypot(one * rate, all_axes * np.linalg.norm(rate, axis=1, keepdims=True))
        return size / np.sqrt(H) * self.rng.standard_normal(rate.shape)

    def _swaying(self, t: np.ndarray) -> np.ndarray:
        size, omega, phase = self.sway
        return size * np.sin(omega * t[:, None] + phase)

    def _headings(self, u: np.ndarray, k: np.ndarray) -> None:
        if not self.scenario.every:
            return
        late = round(self.scenario.late / H)
        told = (k % round(self.scenario.every / H) == 0) & (k > late)
        yaw = self.at(H * (k[told] - late)).as_euler("ZYX")[:, 0]
        u[told, 7] = yaw + HEADING_STD * self.rng.standard_normal(told.sum())
        u[told, 8], u[told, 9], u[told, 10] = HEADING_STD**2, 1, late * H


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
    numbers = [int(a) for a in sys.argv[1:] if a != "--sol"]
    sys.exit(not (sol if "--sol" in sys.argv else main)(*numbers))
