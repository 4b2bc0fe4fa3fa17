"""Every noise that the FMU makes is inside the 99 % band of theory at every octave.

That is at two sample rates and over seeds.

Density: ordinates of the periodogram of white Gaussian noise at its Fourier frequencies are
independent and exactly S chi2(2) / 2, the mean of m of them S chi2(2 m) / (2 m). Each noise is
made white first by its own theory (``noise_cases``). Allan deviation: the law of the overlapping
estimator for the theory's density (``allan_band``).

The band is one for this whole file: a right noise fails anything here with a probability of at most
1 %, by Bonferroni over octaves, axes, rates, seeds and the two statistics. Seeds are fixed, so
that a test that passes goes on passing.
"""

from collections.abc import Callable
from functools import cache, partial
from itertools import pairwise

import casadi as ca
import numpy as np
import pytest
from noise_cases import (
    CASES,
    FORMS,
    WRITTEN,
    Case,
    cases,
    hindrance,
    law_of,
    noises,
    triads,
)
from scipy.stats import chi2, norm

from pyimu.characterization.allan import octave_clusters, overlapping_deviation
from pyimu.characterization.allan.law import allan_band, allan_laws
from pyimu.fmu import build_fmus, simulate
from pyimu.model.catalogue import CATALOGUE, add_effects
from pyimu.model.effect import Effect, Law, Noise, Parameter, SamplePeriod, State, effect
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.shaping import allan_deviation, describe

SAMPLES = 2**16
RATES = (100.0, 976.0)
SEEDS = (11, 12, 13)
RUNS = [(rate, seed) for rate in RATES for seed in SEEDS]
SHORT = ((100.0, 11), (976.0, 12))
SOME_LONG = [pytest.param(*r, marks=[pytest.mark.long] * (r not in SHORT)) for r in RUNS]
FALSE_ALARM = 1e-2
ONE = FALSE_ALARM / (2 * len(CASES) * len(RUNS) + 5)
"""Of that, for all octaves of one statistic of one noise in one run, and for each of the five tests
of another kind."""

TRIADS = triads()
VERSIONS = (2, 3)
KINDS = ("gyro", "accel")
STATIONARY = [c for c in CASES if "markov" in CATALOGUE[c.effect].law.parts]


# The runs


def sensor(kind: str, cases: list[Case], only_beside: bool = False) -> Sensor:
    """A triad with every noise, axis i as case i says.

    With ``only_beside`` it has no more than what stands beside the noise that is meant.
    """
    values = {e.name: e.start() for e in noises() if kind in e.sensors}
    for axis, case in enumerate(cases):
        meant = {} if only_beside else {case.effect: case.values}
        for name, given in {**meant, **case.beside}.items():
            for n, v in given.items():
                values[name][n][axis if values[name][n].ndim else ()] = v
    beside = {name for case in cases for name in case.beside}
    return Sensor(kind, {e: v for e, v in values.items() if not only_beside or e in beside})


def place(triad: int, seed: int) -> tuple[int, str]:
    """Which FMU run and which sensor a triad of cases goes to.

    That is by turns, over the seeds, either sensor, but for noises that only one sensor has.
    """
    kinds = TRIADS[triad][0].kinds
    if len(kinds) == 1:
        return len(TRIADS) + triad, kinds[0]
    return triad // 2, KINDS[(triad + seed) % 2]


@cache
def built(folder):
    """One FMU of each version with every noise on every axis, all of them off."""
    part = Part("noise", 100.0, gyro=sensor("gyro", []), accel=sensor("accel", []))
    return dict(zip(VERSIONS, build_fmus(part.block, folder, VERSIONS)))


@cache
def outputs(folder, group: int, rate: float, seed: int) -> np.ndarray:
    """Noise (SAMPLES, 6) of one run of an FMU: its output less that of Python without the noise."""
    placed = {kind: [] for kind in KINDS}
    for triad, members in enumerate(TRIADS):
        if place(triad, seed)[0] == group:
            placed[place(triad, seed)[1]] = members
    t = np.arange(1, SAMPLES + 2) / rate
    u = np.zeros((SAMPLES + 1, 7))
    for k, kind in enumerate(KINDS):
        for axis, case in enumerate(placed[kind]):
            u[:, 3 * k + axis] = case.start + case.slope * t
    # Groups share the names of the streams, so each has a seed of its own; versions take turns.
    own_seed = 100 * group + seed
    version = VERSIONS[(group + RUNS.index((rate, seed))) % 2]
    start = {v.name: v.start for kind in KINDS for v in sensor(kind, placed[kind]).variables}
    y = simulate(
        built(folder)[version], u, sample_period=1 / rate, start_values={**start, "seed": own_seed}
    )
    beside = Part(
        "beside", rate, **{kind: sensor(kind, placed[kind], only_beside=True) for kind in KINDS}
    )
    # Without the first sample: a rate of the motion is known from the second on.
    return (y[1:] - beside.block.run(u, seed=own_seed, sample_period=1 / rate)[0])[1:]


@pytest.fixture(scope="module")
def noise(tmp_path_factory):
    """``noise(case, rate, seed)``: the noise (SAMPLES,) of one case in one run."""
    folder = tmp_path_factory.mktemp("fmus")

    def of(case: Case, rate: float, seed: int) -> np.ndarray:
        triad = next(i for i, t in enumerate(TRIADS) if case in t)
        group, kind = place(triad, seed)
        return outputs(folder, group, rate, seed)[
            :, 3 * KINDS.index(kind) + TRIADS[triad].index(case)
        ]

    yield of
    outputs.cache_clear()
    built.cache_clear()


# The FMU against theory


def octaves(n: int) -> list[slice]:
    """Bins of the periodogram of n samples by octaves, from the first to the last below Nyquist."""
    last = (n + 1) // 2
    return [
        slice(a, min(b, last))
        for a, b in pairwise(2 ** np.arange(last.bit_length() + 1))
        if a < last
    ]


def assert_white(z: np.ndarray, alpha: float) -> float:
    """Assert that every octave of z (n,) has the density of unit white noise.

    Gives the relative half width of the tightest band.
    """
    power, bands = np.abs(np.fft.rfft(z)) ** 2 / len(z), octaves(len(z))
    narrowest = np.inf
    for band in bands:
        m = band.stop - band.start
        low, high = chi2.ppf([alpha / len(bands) / 2, 1 - alpha / len(bands) / 2], 2 * m) / (2 * m)
        ratio = np.mean(power[band])
        where = f"{band.start / len(z):.4g} to {band.stop / len(z):.4g} of the sample rate"
        assert low <= ratio <= high, (
            f"{where}: {ratio:.4f} of the theory is not in {low:.4f} to {high:.4f}"
        )
        narrowest = min(narrowest, (high - low) / 2)
    return narrowest


@pytest.mark.parametrize("rate, seed", SOME_LONG)
@pytest.mark.parametrize("case", CASES, ids=lambda c: c.name)
def test_psd_is_inside_the_band_of_theory(noise, case, rate, seed):
    z = case.law.whiten(noise(case, rate, seed), 1 / rate)
    assert abs(len(z) - SAMPLES) <= 1
    assert assert_white(z, ONE) < 0.05


@cache
def limits(case: Case, rate: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Cluster sizes and the band of all their deviations."""
    m, h = octave_clusters(SAMPLES), 1 / rate
    return m, *allan_band(lambda f: case.law.psd(f, h), m * h, SAMPLES, h, 1 - ONE)


def assert_deviations(x: np.ndarray, m: np.ndarray, low, high, rate: float) -> None:
    """Assert that the Allan deviations of x (n,) are inside the band at clusters of m (t,)."""
    for size, value, a, b in zip(m, overlapping_deviation(x, m), low, high):
        assert a <= value <= b, f"tau = {size / rate:g} s: {value:.4g} is not in {a:.4g} to {b:.4g}"


@pytest.mark.parametrize("rate, seed", SOME_LONG)
@pytest.mark.parametrize("case", CASES, ids=lambda c: c.name)
def test_allan_deviation_is_inside_the_band_of_theory(noise, case, rate, seed):
    m, low, high = limits(case, rate)
    assert 1.0 < (high / low)[0] < 1.06
    assert_deviations(noise(case, rate, seed), m, low, high, rate)


def test_every_noise_of_the_catalogue_has_a_case():
    tested = {case.effect for case in CASES}
    missing = [hindrance(e) for e in noises() if e.name not in tested]
    assert not missing, "\n".join(missing)


@pytest.mark.parametrize("rate, seed", SOME_LONG)
def test_noises_axes_sensors_and_runs_are_independent(noise, rate, seed):
    """Correlations of independent white series are normal with variance 1 / n.

    That is to terms of order 1 / n^2.
    """
    white = np.array(
        [case.law.whiten(noise(case, rate, seed), 1 / rate)[-SAMPLES + 1 :] for case in CASES]
    )
    r = np.corrcoef(white)[np.triu_indices(len(white), 1)]
    assert np.abs(r).max() * np.sqrt(white.shape[1]) < norm.isf(ONE / len(RUNS) / 2 / len(r))


# The theory against other theory


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize("case", [c for c in CASES if c.effect in FORMS], ids=lambda c: c.name)
def test_hidalgo_table_3(case, rate):
    """Far below Nyquist and over many samples the sampled law is the continuous one, PSD and Allan.

    At a twentieth of the sample rate and below, aliases and the sine for its angle change a density
    by at most (pi / 20)^2 / 3 = 0.8 %, over twenty samples a variance by less.
    """
    h = 1 / rate
    closed = FORMS[case.effect](h, **case.values)
    f = np.geomspace(max(closed.frequencies[0], 1e-4), min(closed.frequencies[1], rate / 20), 40)
    np.testing.assert_allclose(case.law.psd(f, h), closed.psd(f), rtol=0.0083 + closed.ripple)
    m = np.unique(
        np.geomspace(max(20, closed.times[0] / h), min(2000, closed.times[1] / h), 8).astype(int)
    )
    sampled = allan_deviation(lambda f: case.law.psd(f, h), m * h, h) ** 2
    np.testing.assert_allclose(sampled, closed.allan(m * h), rtol=0.0083 + closed.ripple)


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize("case", CASES, ids=lambda c: c.name)
def test_the_shaping_filter_has_the_law_of_the_tests(case, rate):
    """Density and Allan deviation of ``describe`` are those of the case.

    It takes the filter from the effect's own step.
    """
    f, m, h = np.geomspace(1e-3, rate / 2, 50), octave_clusters(SAMPLES)[::3], 1 / rate
    want = np.sqrt(
        [law.mean for law in allan_laws(lambda f: case.law.psd(f, h), m * h, SAMPLES, h)]
    )
    for kind in case.kinds:
        model = describe(sensor(kind, [case]), case.effect, 0, h, at=case.start, slope=case.slope)
        np.testing.assert_allclose(model.psd_two_sided(f), case.law.psd(f, h), rtol=1e-7)
        np.testing.assert_allclose(model.allan_deviation(m * h), want, rtol=1e-7)


@pytest.mark.parametrize(
    "case", [c for c in WRITTEN if not hindrance(CATALOGUE[c.effect])], ids=lambda c: c.name
)
def test_the_law_of_a_definition_is_the_one_written_by_hand(case):
    """A noise without a case of its own is tested against its definition's law."""
    f, x = np.geomspace(1e-3, 50.0, 30), np.random.default_rng(1).standard_normal(100)
    law = law_of(CATALOGUE[case.effect], case.values, case.start, case.slope)
    np.testing.assert_allclose(law.psd(f, 0.01), case.law.psd(f, 0.01), rtol=1e-12)
    np.testing.assert_allclose(law.whiten(x, 0.01), case.law.whiten(x, 0.01), rtol=1e-9)


# What has no density


def started(case: Case) -> np.ndarray:
    """First samples (400 x 3 of each sensor,) of a noise, over axes and sensors and seeds."""
    part = Part(
        "start",
        100.0,
        **{kind: Sensor(kind, {case.effect: dict(case.values)}) for kind in case.kinds},
    )
    columns = [3 * KINDS.index(kind) + axis for kind in case.kinds for axis in range(3)]
    return np.concatenate(
        [part.block.run(np.zeros((1, 7)), seed=seed)[0][0, columns] for seed in range(400)]
    )


@pytest.mark.parametrize("case", STATIONARY, ids=lambda c: c.name)
def test_the_first_sample_is_drawn_from_the_stationary_state(case):
    """The whitening of one sample divides by the stationary standard deviation."""
    z = np.array([case.law.whiten(np.array([x]), 0.01)[0] for x in started(case)])
    side = ONE / (2 * len(STATIONARY))
    assert chi2.ppf(side, len(z)) <= np.sum(z**2) <= chi2.isf(side, len(z))


@pytest.mark.parametrize("version, rate", list(zip(VERSIONS, RATES, strict=True)))
def test_hidalgo_table_3_rate_ramp_allan(tmp_path, version, rate):
    """R tau / sqrt(2), to the rounding of the sums; a ramp has no density."""
    R = np.array([0.3, -0.2, 0.1])
    part = Part("ramp", rate, **{kind: Sensor(kind, {"rate_ramp": {"R": R}}) for kind in KINDS})
    (path,) = build_fmus(part.block, tmp_path, (version,))
    y = simulate(path, np.zeros((4096, 7)), sample_period=1 / rate)[1:, :6]
    m = octave_clusters(len(y))
    want = np.abs(np.tile(R, 2)) * m[:, None] / rate / np.sqrt(2)
    np.testing.assert_allclose(overlapping_deviation(y, m), want, rtol=1e-9)


# A noise of one's own


@pytest.fixture
def added():
    """``added(effect)``: the case of a noise that is in the catalogue for one test."""
    names = []

    def add(noise: Effect) -> Case:
        add_effects(noise)
        names.append(noise.name)
        return cases()[-1]

    yield add
    CATALOGUE.remove(*names)


def define(law: Law | None, sensors=("gyro", "accel")) -> Callable[[Callable], Effect]:
    return effect(
        stage="noise", equation="y", source="none", term="made up", sensors=sensors, law=law
    )


def hum(factor: float) -> Effect:
    """White noise that grows with the input, and what its law says times ``factor``."""

    @define(Law(white=lambda N, k, x: factor * (N**2 + (k * x) ** 2)), sensors=("accel",))
    def hum_of_a_test(
        x,
        N: Parameter("{Y}/sqrt(s)", minimum=0.0),
        k: Parameter("sqrt(s)", (), minimum=0.0),
        w: Noise(6),
        h: SamplePeriod(),
    ):
        return x + (N * w[:3] + k * x * w[3:]) / ca.sqrt(h)

    return hum_of_a_test


def drift(factor: float) -> Effect:
    """A random walk, and what its law says times ``factor``."""

    @define(Law(walk=lambda K: factor * K**2))
    def drift_of_a_test(
        x, K: Parameter("{y}/sqrt(s)", minimum=0.0), b: State("{y}"), w: Noise(), h: SamplePeriod()
    ):
        return x + b, {"b": b + K * ca.sqrt(h) * w}

    return drift_of_a_test


def wander(factor: float) -> Effect:
    """A Gauss-Markov process, and what its law says times ``factor``."""

    @define(Law(markov=lambda s, T: [(factor * s**2, T)], shown={"T": 2.0}))
    def wander_of_a_test(
        x,
        s: Parameter("{y}", minimum=0.0),
        T: Parameter("s", (), 5.0, form=True, minimum=1e-6),
        b: State("{y}"),
        started: State("1", ()),
        w: Noise(),
        h: SamplePeriod(),
    ):
        kept = started * ca.exp(-h / T)
        b = kept * b + ca.sqrt(1 - kept**2) * s * w
        return x + b, {"b": b, "started": 1}

    return wander_of_a_test


def made(case: Case, rate: float, n: int) -> np.ndarray:
    """Noise (n,) of a case out of Python."""
    (kind, *_) = case.kinds
    part = Part("own", rate, **{kind: Sensor(kind, {case.effect: dict(case.values)})})
    u, column = np.zeros((n + 1, 7)), 3 * KINDS.index(kind)
    u[:, column] = case.start + case.slope * np.arange(n + 1) / rate
    return (part.block.run(u, seed=1)[0][:, :6] - u[:, :6])[1:, column]


@pytest.mark.parametrize("noise_of", [hum, drift, wander])
def test_a_new_noise_is_tested_by_its_law_alone(added, noise_of):
    case, rate, n = added(noise_of(1.0)), 100.0, 2**14
    assert case.effect == f"{noise_of.__name__}_of_a_test"
    x, m = made(case, rate, n), octave_clusters(n)
    assert_white(case.law.whiten(x, 1 / rate), ONE / 6)
    psd = partial(case.law.psd, h=1 / rate)
    assert_deviations(x, m, *allan_band(psd, m / rate, n, 1 / rate, 1 - ONE / 6), rate)
    for kind in case.kinds:
        model = describe(
            Sensor(kind, {case.effect: dict(case.values)}), case.effect, 0, 1 / rate, at=case.start
        )
        f = np.geomspace(1e-3, rate / 2, 20)
        np.testing.assert_allclose(model.psd_two_sided(f), psd(f), rtol=1e-7)


@pytest.mark.parametrize("noise_of", [hum, drift, wander])
def test_a_law_that_is_not_that_of_the_noise_is_found(added, noise_of):
    """A fifth of the density is ten standard deviations of its mean over the highest octave."""
    case = added(noise_of(1.2))
    with pytest.raises(AssertionError, match="of the theory is not in"):
        assert_white(case.law.whiten(made(case, 100.0, 2**14), 0.01), ONE)


def lawless(law: Law | None, **parameters: Parameter) -> Effect:
    """A noise whose law makes no case."""

    def lawless(x, N, w):
        return x + N * w

    lawless.__annotations__ = {"N": Parameter("{y}"), "w": Noise(), **parameters}
    return define(law)(lawless)


@pytest.mark.parametrize(
    "law, parameters, says",
    [
        (None, {}, "lawless draws noise and has no law: give its definition one"),
        (
            Law(white=lambda N: N, walk=lambda N: N),
            {},
            "lawless has a law of white and walk, not of one of white, walk, markov: add a Case",
        ),
        (Law(), {}, "lawless has a law of nothing, not of one of white, walk, markov: add a Case"),
        (
            Law(white=lambda N: N),
            {"N": Parameter("{y}", (3, 3))},
            "lawless has coefficients that are not one an axis, N: add a Case",
        ),
    ],
)
def test_a_noise_without_a_case_is_named_in_one_line(law, parameters, says):
    line = hindrance(lawless(law, **parameters))
    assert line.startswith(says) and "\n" not in line


def test_rounding_needs_noise_that_its_law_does_not_say():
    assert hindrance(CATALOGUE["quantization"]).startswith("quantization makes its noise of other")
