"""Shaping filters against the field's closed forms, and against the samples that the same effects
draw.
"""

from itertools import pairwise

import control
import numpy as np
import pytest
from noise_cases import CASES
from scipy.stats import chi2

from pyimu.characterization.allan import octave_clusters, overlapping_deviation
from pyimu.characterization.allan.law import allan_band, allan_laws
from pyimu.errors import UserError
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.kinds import OWN
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS, START
from pyimu.model.simulate import simulate
from pyimu.shaping import (
    NOISE_LIKE,
    allan_deviation,
    continuous_filter,
    describe,
    discretise,
    flicker_floor,
    gauss_markov_deviation,
    psd_two_sided,
    shaping_filter,
    spectral_factor,
    transfer_function,
    white_deviation,
)
from pyimu.shaping.continuous import has_filter

N = np.array([6.0e-5, 6.9e-5, 6.0e-5])
K = np.array([2.7e-6, 4.0e-6, 5.2e-6])
H = 0.01
NOISE = {"angle_random_walk": {"N": N}, "rate_random_walk": {"K": K}}
ALL = Sensor(
    "gyro",
    {
        **NOISE,
        "gauss_markov": {"q": [1e-5, 2e-5, 3e-5], "tau": [5.0, 50.0, 500.0]},
        "bias_instability": {"B": 4e-6},
        "rate_dependent_noise": {"k": 2e-4},
        "sampling_jitter": {"sj": 1e-3},
        "quantization": {"q": 1e-3},
        "angle_quantization": {"q": 1e-6},
        "rate_ramp": {"R": 3e-9},
    },
)
STOCHASTIC = [e.name for e in CATALOGUE.values() if e.stochastic]
POINT = {"at": 2.0, "slope": 0.5}
FALSE_ALARM = 1e-3


def sensor(kind="gyro"):
    return Sensor(kind, NOISE)


def noisy(name):
    """A sensor with the noise ``name``: of those above, or of the first case that has it."""
    if name in ALL.values:
        return ALL
    return Sensor(
        CATALOGUE[name].sensors[0], {name: next(c.values for c in CASES if c.effect == name)}
    )


# The field's forms


@pytest.mark.parametrize("axis", range(3))
def test_hidalgo_table_3_angle_random_walk_psd(axis):
    f = np.linspace(0.0, 0.5 / H, 50)
    system = shaping_filter(sensor(), "angle_random_walk", axis, H)
    assert system.nstates == 0
    np.testing.assert_allclose(psd_two_sided(system, f), N[axis] ** 2, rtol=1e-14)


@pytest.mark.parametrize("axis", range(3))
def test_hidalgo_table_3_rate_random_walk_psd(axis):
    """The sampled walk is (sinc)^-2 above the continuous form: K^2 h^2 / (4 sin^2(pi f h))."""
    system = shaping_filter(sensor(), "rate_random_walk", axis, H)
    assert system.nstates == 1
    f = np.geomspace(1e-5, 0.5 / H, 60)
    sampling = np.sinc(f * H) ** -2
    np.testing.assert_allclose(
        psd_two_sided(system, f), K[axis] ** 2 / (2 * np.pi * f) ** 2 * sampling, rtol=1e-9
    )
    assert psd_two_sided(system, 0.0) == np.inf


@pytest.mark.parametrize("tau", [0.01, 0.5, 30.0, 1000.0])
def test_hidalgo_table_3_allan_of_a_continuous_density(tau):
    white = allan_deviation(lambda f: np.full_like(f, N[0] ** 2), tau)
    walk = allan_deviation(lambda f: K[0] ** 2 / (2 * np.pi * f) ** 2, tau)
    np.testing.assert_allclose(white, N[0] / np.sqrt(tau), rtol=1e-9)
    np.testing.assert_allclose(walk, K[0] * np.sqrt(tau / 3), rtol=1e-9)


def test_hidalgo_table_3_allan_of_flicker():
    """B^2 / (2 pi f) up to f0: far above 1 / f0 the floor (2 ln 2 / pi) B^2, less a share of order
    1 / (f0 tau)^2.
    """
    f0, tau = 10.0, 50.0
    flicker = allan_deviation(lambda f: np.where(f <= f0, 1 / (2 * np.pi * f), 0.0), tau)
    np.testing.assert_allclose(flicker**2, flicker_floor(1.0) ** 2, rtol=1 / (f0 * tau) ** 2)


@pytest.mark.parametrize("n", [1, 2, 7, 100, 5001, 200_000])
def test_allan_of_sampled_noise_is_exact(n):
    """Means of n samples: N^2 / tau, and for the sampled walk K^2 tau / 3 (1 + 1 / (2 n^2)), by
    summing its increments.
    """
    white = shaping_filter(sensor(), "angle_random_walk", 2, H)
    walk = shaping_filter(sensor(), "rate_random_walk", 2, H)
    tau = n * H
    np.testing.assert_allclose(
        allan_deviation(lambda f: psd_two_sided(white, f), tau, H) ** 2, N[2] ** 2 / tau, rtol=1e-10
    )
    np.testing.assert_allclose(
        allan_deviation(lambda f: psd_two_sided(walk, f), tau, H) ** 2,
        K[2] ** 2 * tau / 3 * (1 + 0.5 / n**2),
        rtol=1e-9,
    )


@pytest.mark.parametrize(
    "name",
    [
        n
        for n in (*STOCHASTIC, *NOISE_LIKE)
        if CATALOGUE[n].law.ramp is None and "markov" not in CATALOGUE[n].law.parts
    ],
)
def test_hidalgo_table_3_closed_forms_are_the_integral(name):
    model = describe(noisy(name), name, 1, H, **POINT)
    tau = H * np.array([1, 2, 7, 100, 5001])
    assert model.closed_allan is not None
    np.testing.assert_allclose(
        model.allan_deviation(tau), allan_deviation(model.psd_two_sided, tau, H), rtol=1e-9
    )


@pytest.mark.parametrize("angle", [1.0, 0.02, 1e-4, 1e-9])
@pytest.mark.parametrize("n", [1, 10, 4000])
def test_allan_of_a_markov_process_is_exact(n, angle):
    """A pole inside the circle: the autocovariance exp(-angle |k|), summed with the weights of two
    adjoining clusters.

    The weights sum to zero, so that expm1 may stand for exp: nothing cancels where the pole is
    close to the circle. The density is that of the process with one digit in sqrt(eps) of 1 - a,
    written with expm1 as well.
    """
    k = np.arange(2 * n)
    weights = np.where(k < n, 2 * n - 3 * k, k - 2 * n) / n**2
    want = np.sum(weights * np.expm1(-angle * k))

    def density(f):
        return (
            -H
            * np.expm1(-2 * angle)
            / (np.expm1(-angle) ** 2 + 4 * np.exp(-angle) * np.sin(np.pi * f * H) ** 2)
        )

    np.testing.assert_allclose(allan_deviation(density, n * H, H) ** 2, want, rtol=1e-9)


@pytest.mark.parametrize(
    "name", ["angle_random_walk", "rate_random_walk", "gauss_markov", "angle_quantization"]
)
def test_allan_deviation_is_the_mean_of_the_estimators_law(name):
    """Which comes by another way, from the autocovariance that a cosine transform makes of the
    density.
    """
    model, tau = describe(noisy(name), name, 0, H), H * octave_clusters(2**14)
    means = [law.mean for law in allan_laws(model.psd_two_sided, tau, 2**14, H)]
    np.testing.assert_allclose(means, model.allan_deviation(tau) ** 2, rtol=1e-9)


def test_ieee_952_gauss_markov_closed_form():
    """The printed form where it does not cancel, the integral everywhere, the random walk and the
    white noise that it tends to.
    """
    q, tau_c = 3.0, 20.0
    tau = tau_c * np.geomspace(1e-4, 1e3, 22)
    got, system = (
        gauss_markov_deviation(q, tau_c, tau),
        continuous_filter("gauss_markov", {"q": q, "tau": tau_c}),
    )
    np.testing.assert_allclose(
        got, allan_deviation(lambda f: psd_two_sided(system, f), tau), rtol=1e-8
    )
    z = tau[tau > tau_c / 10]
    printed = (
        q**2
        * tau_c**2
        / z
        * (1 - tau_c / (2 * z) * (3 - 4 * np.exp(-z / tau_c) + np.exp(-2 * z / tau_c)))
    )
    np.testing.assert_allclose(got[tau > tau_c / 10] ** 2, printed, rtol=1e-10)
    np.testing.assert_allclose(
        gauss_markov_deviation(q, tau_c, 1e-7 * tau_c), q * np.sqrt(1e-7 * tau_c / 3), rtol=1e-7
    )
    np.testing.assert_allclose(
        gauss_markov_deviation(q, tau_c, 1e7 * tau_c), q * tau_c / np.sqrt(1e7 * tau_c), rtol=1e-6
    )


@pytest.mark.parametrize("axis", range(3))
def test_gauss_markov_closed_form_is_below_the_samples_by_what_it_says(axis):
    """To the accuracy of 1 - exp(-h / tau_c), some eps tau_c / h, beside the integral's."""
    model, tau = describe(ALL, "gauss_markov", axis, H), H * 2.0 ** np.arange(18)
    q, tau_c = (float(ALL.values["gauss_markov"][n][axis]) for n in ("q", "tau"))
    excess = model.allan_deviation(tau) ** 2 / gauss_markov_deviation(q, tau_c, tau) ** 2 - 1
    assert np.all(excess > -1e-9)
    assert np.all(excess <= (H / (tau * np.sqrt(2)) + H / (tau_c * np.sqrt(12))) ** 2 + 1e-9)


# The filter of a step


def test_a_filter_of_one_effect_does_not_see_the_others():
    alone = shaping_filter(
        Sensor("accel", {"rate_random_walk": {"K": K}}), "rate_random_walk", 1, H
    )
    among = shaping_filter(sensor("accel").with_values("lag", wn=30.0), "rate_random_walk", 1, H)
    assert (
        np.array_equal(alone.A, among.A)
        and np.array_equal(alone.B, among.B)
        and np.array_equal(alone.C, among.C)
    )


def responses(one: Sensor, axis: int, steps: int) -> list[list[float]]:
    """What each normal that reaches the axis does to it in ``steps`` samples, after a first sample
    without noise.
    """
    u = START.copy()
    u[OWN[one.kind].start + axis] = POINT["at"]
    u[COLUMNS[one.output.own_rate].start + axis] = POINT["slope"]
    out = []
    for channel in range(len(one.noise)):
        course = []
        for size in (0.0, 1.0):
            state, y = one.chain.start, []
            for k in range(steps + 1):
                w = np.zeros(len(one.noise))
                w[channel] = size * (k == 1)
                state, sample = one.step(state, u, one.p, w, H)
                y.append(float(sample[axis]))
            course.append(np.array(y[1:]))
        if np.any(course[0] != course[1]):
            out.append(course[1] - course[0])
    return out


@pytest.mark.parametrize("name", STOCHASTIC)
def test_a_filter_answers_an_impulse_as_the_simulation_does(name):
    """Normal by normal, the response of the simulated effect is the filter's; to the rounding of
    outputs of the size of x.
    """
    for kind in CATALOGUE[name].sensors:
        start = Sensor(kind, {name: {}})
        one = start.with_p(np.linspace(0.5, 1.5, len(start.slots)))
        system = shaping_filter(one, name, 1, H, **POINT)
        powers = [system.D[0]] + [
            (system.C @ np.linalg.matrix_power(system.A, k) @ system.B)[0] for k in range(9)
        ]
        np.testing.assert_allclose(
            np.transpose(responses(one, 1, 10)), powers, rtol=1e-12, atol=2e-15
        )


def test_density_is_the_sum_over_the_inputs():
    """Against python-control's own response, and after a change of the states by which the poles
    are no longer on the diagonal.
    """
    system, f = shaping_filter(ALL, "bias_instability", 0, H), np.geomspace(1e-4, 0.5 / H, 20)
    assert system.nstates == system.ninputs == 6
    response = system(np.exp(2j * np.pi * f * H), squeeze=False)[0]
    np.testing.assert_allclose(
        psd_two_sided(system, f), H * np.sum(np.abs(response) ** 2, axis=0), rtol=1e-9
    )
    turn = np.linalg.qr(np.random.default_rng(1).standard_normal((6, 6)))[0]
    turned = control.ss(turn @ system.A @ turn.T, turn @ system.B, system.C @ turn.T, system.D, H)
    np.testing.assert_allclose(psd_two_sided(turned, f), psd_two_sided(system, f), rtol=1e-6)
    assert psd_two_sided(system, f.reshape(4, 5)).shape == (4, 5)


def test_noise_that_follows_the_motion_takes_its_size_from_the_operating_point():
    k, sj = 2e-4, 1e-3
    rest = describe(ALL, "rate_dependent_noise", 0, H)
    moving = describe(ALL, "rate_dependent_noise", 0, H, at=-2.0)
    assert rest.psd_two_sided(1.0) == 0 and moving.psd_two_sided(1.0) == pytest.approx(
        (2 * k) ** 2, rel=1e-12
    )
    np.testing.assert_allclose(
        psd_two_sided(moving.transfer_function, np.array([0.1, 1.0])), (2 * k) ** 2, rtol=1e-12
    )
    level = describe(
        Sensor("accel", {"rate_dependent_noise": {"k": k}}), "rate_dependent_noise", 2, H
    )
    assert level.psd_two_sided(1.0) == pytest.approx((9.80665 * k) ** 2, rel=1e-12)
    jitter = describe(ALL, "sampling_jitter", 0, H, slope=0.5)
    assert jitter.standard_deviation == pytest.approx(sj * 0.5, rel=1e-12)


# The continuous filters and Van Loan


AFTER_THE_UPDATE = {n for n in STOCHASTIC if "markov" in CATALOGUE[n].law.parts}
"""Effects whose output is the state that follows; the samples' law is the same, one sample earlier.
"""


@pytest.mark.parametrize("axis", range(3))
@pytest.mark.parametrize("name", [e.name for e in CATALOGUE.values() if has_filter(e.law)])
def test_van_loan_gives_the_jacobians_of_the_step(name, axis):
    model = describe(noisy(name), name, axis, H, **POINT)
    want, got = model.sampled, model.discrete()
    np.testing.assert_allclose(got.A, want.A, rtol=1e-14)
    q = got.B @ got.B.T
    np.testing.assert_allclose(q, want.B @ want.B.T, rtol=1e-13)
    after = name in AFTER_THE_UPDATE
    np.testing.assert_allclose(got.C @ got.A if after else got.C, want.C, rtol=1e-14)
    np.testing.assert_allclose(
        got.C @ q @ got.C.T if after else got.D @ got.D.T, want.D @ want.D.T, rtol=1e-13
    )
    f = np.geomspace(1e-4, 0.5 / H, 30)
    np.testing.assert_allclose(psd_two_sided(got, f), psd_two_sided(want, f), rtol=1e-9)


def mixed() -> control.StateSpace:
    """A lagged random walk beside white noise: a matrix that is not diagonal, with a pole at
    zero.
    """
    return control.ss(
        [[0.0, 0.0], [3.0, -3.0]], [[0.7, 0.0], [0.1, 0.0]], [[0.0, 1.0]], [[0.0, 0.02]]
    )


def test_two_steps_are_one_of_twice_the_length():
    one, two = discretise(mixed(), 0.05), discretise(mixed(), 0.1)
    q = one.B @ one.B.T
    np.testing.assert_allclose(two.A, one.A @ one.A, rtol=1e-13)
    np.testing.assert_allclose(two.B @ two.B.T, q + one.A @ q @ one.A.T, rtol=1e-12)
    np.testing.assert_allclose(two.D[0, -1], one.D[0, -1] / np.sqrt(2), rtol=1e-14)


def test_a_step_beyond_every_correlation_time_gives_the_stationary_covariance():
    """At |A| h = 6e7 Van Loan's exponential is far beyond what a double holds."""
    model = describe(ALL, "bias_instability", 0, H)
    far = model.discrete(1e7)
    np.testing.assert_allclose(
        far.B @ far.B.T,
        control.lyap(model.continuous.A, model.continuous.B @ model.continuous.B.T),
        rtol=1e-9,
    )


def test_an_input_that_drives_state_and_output_has_no_samples():
    with pytest.raises(ValueError, match="drives a state and the output"):
        discretise(control.ss([[-1.0]], [[1.0]], [[1.0]], [[1.0]]), H)


def test_poles_are_the_corner_rates():
    assert describe(ALL, "angle_random_walk", 0, H).poles.size == 0
    np.testing.assert_array_equal(describe(ALL, "rate_random_walk", 0, H).poles, [0.0])
    np.testing.assert_allclose(describe(ALL, "gauss_markov", 1, H).poles, [-1 / 50], rtol=1e-14)
    np.testing.assert_allclose(
        describe(ALL, "bias_instability", 1, H).poles,
        -2 * np.pi * np.geomspace(1e-5, 1.0, 6),
        rtol=1e-12,
    )


def test_spectral_factor_has_the_density_of_the_sum_and_no_zero_on_the_right():
    system = continuous_filter("bias_instability", {"B": 1.0, "f_low": 1e-5, "f_high": 1.0})
    one, f = transfer_function(system), np.geomspace(1e-7, 100.0, 60)
    np.testing.assert_allclose(psd_two_sided(one, f), psd_two_sided(system, f), rtol=1e-9)
    assert (
        np.all(one.zeros().real < 0)
        and np.all(one.poles().real < 0)
        and (one.ninputs, one.noutputs) == (1, 1)
    )
    assert psd_two_sided(spectral_factor([0.0, 0.0], [1.0, 2.0]), np.array([1.0])) == 0


def test_bode_is_the_root_of_the_density_with_the_phase_of_its_poles():
    f = np.geomspace(1e-6, 10.0, 30)
    for name, late in (
        ("angle_random_walk", 0.0),
        ("rate_random_walk", -90.0),
        ("gauss_markov", None),
        ("bias_instability", None),
    ):
        model = describe(ALL, name, 0, H)
        response = model.bode(f)
        np.testing.assert_allclose(
            np.ravel(response.magnitude) ** 2, psd_two_sided(model.continuous, f), rtol=1e-9
        )
        if late is not None:
            np.testing.assert_allclose(np.rad2deg(np.ravel(response.phase)), late, atol=1e-9)
    corner = describe(ALL, "gauss_markov", 0, H).bode([1 / (2 * np.pi * 5.0)])
    assert np.rad2deg(np.ravel(corner.phase)[0]) == pytest.approx(-45.0, abs=1e-9)


@pytest.mark.parametrize("name", [*STOCHASTIC, "quantization", "angle_quantization"])
def test_samples_have_the_continuous_density_far_below_nyquist(name):
    """Sampling multiplies it by at most (pi f h)^2 / sin^2(pi f h) and divides a difference's by
    it; adds a share (h / tau)^2 / 12.
    """
    model, f = describe(noisy(name), name, 0, H, **POINT), np.geomspace(1e-4, 0.01 / H, 20)
    ratio = model.psd_two_sided(f) / psd_two_sided(model.transfer_function, f)
    assert np.all(np.abs(ratio - 1) <= 1.01 * (np.pi * f * H) ** 2 / 3 + (2 * np.pi * H) ** 2 / 12)


def test_stationary_covariance_solves_both_lyapunov_equations():
    for name in ("gauss_markov", "bias_instability"):
        model = describe(ALL, name, 2, H)
        p = model.stationary_covariance
        np.testing.assert_allclose(
            p,
            control.lyap(model.continuous.A, model.continuous.B @ model.continuous.B.T),
            rtol=1e-8,
            atol=1e-30,
        )
        np.testing.assert_allclose(model.standard_deviation, np.sqrt(p.sum()), rtol=1e-12)
    q, tau = 3e-5, 500.0
    np.testing.assert_allclose(
        describe(ALL, "gauss_markov", 2, H).stationary_covariance, q**2 * tau / 2, rtol=1e-10
    )
    for name in ("rate_random_walk", "rate_ramp"):
        model = describe(ALL, name, 0, H)
        assert model.stationary_covariance is None and model.standard_deviation == np.inf
    white = describe(ALL, "angle_random_walk", 0, H)
    assert white.stationary_covariance.shape == (
        0,
        0,
    ) and white.standard_deviation == pytest.approx(N[0] / np.sqrt(H), rel=1e-14)


# Flicker


QUARTER = 10**0.025
"""0.25 dB as a ratio of powers."""


@pytest.mark.parametrize("low, high", [(1e-5, 1.0), (1e-4, 10.0), (1e-3, 1.0), (1e-3, 0.1)])
def test_flicker_keeps_to_its_density_within_a_quarter_of_a_decibel(low, high):
    """f S(f) from f_low to f_high, at the defaults and in narrower bands; less than 0.5 dB from top
    to bottom.
    """
    f = np.geomspace(low, high, 4001)
    one = Sensor("gyro", {"bias_instability": {"B": 1.0, "f_low": low, "f_high": high}})
    flat = 2 * np.pi * f * psd_two_sided(describe(one, "bias_instability", 0, H).continuous, f)
    assert 1 / QUARTER < flat.min() and flat.max() < QUARTER


@pytest.mark.parametrize("tau", [1.0, 10.0, 100.0, 1e3, 1e4])
def test_flicker_has_the_allan_floor_of_its_density(tau):
    """The density's tolerance on the part in the band; beyond its ends the density is between zero
    and B^2 / (2 pi f) with that tolerance.

    Of a 1/f density the share 3 / (8 pi^3 (f_high tau)^2 2 ln 2 / pi) is above f_high at the most
    (sin^4 counted with its mean there), and at most pi (f_low tau)^2 / (2 ln 2 / pi) below f_low.
    """
    f_low, f_high, floor = 1e-5, 1.0, flicker_floor(1.0) ** 2
    model = describe(Sensor("gyro", {"bias_instability": {"B": 1.0}}), "bias_instability", 0, H)
    ends = (3 / (8 * np.pi**3 * (f_high * tau) ** 2) + np.pi * (f_low * tau) ** 2) / floor
    assert (
        1 / QUARTER - ends < model.allan_deviation(np.array([tau]))[0] ** 2 / floor < QUARTER + ends
    )


# Noise that is none


def rounding_error(name: str, q: float, samples: int) -> np.ndarray:
    """Error (samples,) of a part that rounds alone, under white noise of one step (of the angle:
    one step a sample).
    """
    size = q if name == "quantization" else q / H
    rate = np.zeros((samples, 3))
    rate[:, 0] = size * np.random.default_rng(5).standard_normal(samples)
    gyro, _ = simulate(
        Part("rounds", 1 / H, gyro=Sensor("gyro", {name: {"q": q}})), rate, np.zeros((samples, 3))
    )
    return (gyro - rate)[1:, 0]


@pytest.mark.parametrize("name", ["quantization", "angle_quantization"])
def test_rounding_has_its_density_where_noise_exceeds_half_a_step(name):
    """Octaves of the periodogram, S chi2(2 m) / (2 m); what one step of noise leaves correlated is
    exp(-2 pi^2) = 3e-9.
    """
    error = rounding_error(name, 1e-3, 2**14 + 1)
    model = describe(Sensor("gyro", {name: {"q": 1e-3}}), name, 0, H)
    f, power = np.fft.rfftfreq(len(error), H), np.abs(np.fft.rfft(error)) ** 2 * H / len(error)
    edges = 2 ** np.arange(5, 14)
    for low, high in pairwise(edges):
        m = high - low
        ratio = np.mean(power[low:high] / model.psd_two_sided(f[low:high]))
        limits = chi2.ppf(
            [FALSE_ALARM / (4 * len(edges)), 1 - FALSE_ALARM / (4 * len(edges))], 2 * m
        ) / (2 * m)
        assert limits[0] <= ratio <= limits[1]


@pytest.mark.parametrize("name", ["quantization", "angle_quantization"])
def test_hidalgo_table_3_rounding_allan(name):
    error = rounding_error(name, 1e-3, 2**14 + 1)
    model, m = (
        describe(Sensor("gyro", {name: {"q": 1e-3}}), name, 0, H),
        octave_clusters(len(error) // 8),
    )
    low, high = allan_band(model.psd_two_sided, m * H, len(error), H, 1 - FALSE_ALARM / 2)
    got = overlapping_deviation(error, m)
    assert np.all((low <= got) & (got <= high))


def test_hidalgo_table_3_rate_ramp():
    """R tau / sqrt(2), to rounding; no filter, no covariance, and a density in name only."""
    model, n = describe(ALL, "rate_ramp", 0, H), 4096
    gyro, _ = simulate(
        Part("ramp", 1 / H, gyro=Sensor("gyro", {"rate_ramp": {"R": 3e-9}})),
        np.zeros((n, 3)),
        np.zeros((n, 3)),
    )
    m = octave_clusters(n)
    np.testing.assert_allclose(
        overlapping_deviation(gyro[:, 0], m), model.allan_deviation(m * H), rtol=1e-9
    )
    assert model.sampled is None and model.transfer_function is None and model.poles.size == 0
    np.testing.assert_allclose(model.psd_two_sided(2.0), 9e-18 / (4 * np.pi) ** 3, rtol=1e-14)
    with pytest.raises(UserError, match="rate_ramp has no transfer function"):
        model.bode([1.0])


# Users


def test_a_model_says_what_it_is():
    text = repr(describe(ALL, "gauss_markov", 0, H))
    assert (
        text.startswith("NoiseModel(gyro.gauss_markov, axis x, every 0.01 s")
        and "-0.2" in text
        and "rad/s" in text
    )
    assert describe(ALL, "gauss_markov", 0, H) == describe(ALL, "gauss_markov", 0, H)


def test_errors_name_the_effect():
    with pytest.raises(UserError, match="gyro has no effect lag"):
        shaping_filter(sensor(), "lag", 0, H)
    with pytest.raises(UserError, match="gyro.scale_factor draws no noise"):
        shaping_filter(Sensor("gyro", {"scale_factor": {"s": 0.1}}), "scale_factor", 0, H)
    with pytest.raises(UserError, match="gyro.g_sensitivity draws no noise"):
        describe(Sensor("gyro", {"g_sensitivity": {}}), "g_sensitivity", 0, H)
    with pytest.raises(UserError, match="quantization has no continuous filter"):
        describe(ALL, "quantization", 0, H).discrete()
    with pytest.raises(UserError, match="sampling_jitter has no continuous"):
        continuous_filter("sampling_jitter", {})
    with pytest.raises(ValueError, match="multiples of the sample period"):
        allan_deviation(lambda f: f, 0.015, H)
    with pytest.raises(ValueError, match="multiples of the sample period"):
        describe(ALL, "angle_random_walk", 0, H).allan_deviation([0.015])
    with pytest.raises(ValueError, match="positive"):
        allan_deviation(lambda f: f, 0.0)


def test_white_deviation_is_read_at_one_second():
    assert white_deviation(2.0, 1.0) == 2.0
