"""Effects that no log of the benchmark's kind tells apart, and why: said beforehand.

Where the loop names the one, its alternatives name the other, and the other is the truth, that
counts as right.
"""

from __future__ import annotations

CONFOUNDS: dict[frozenset[str], str] = {
    frozenset({"lag", "time_delay"}): (
        "below a third of its bandwidth a second-order lag is a delay by 2 zeta / wn"
    ),
    frozenset({"first_order_lag", "time_delay"}): (
        "below a third of its bandwidth a single pole is a delay by tau"
    ),
    frozenset({"lag", "first_order_lag"}): (
        "below a third of their bandwidths both are one delay, where tau is 2 zeta / wn"
    ),
    frozenset({"time_delay", "clock_skew"}): (
        "over a short part of a log a clock that runs late is a delay; apart only by its growth"
    ),
    frozenset({"rate_ramp", "ageing"}): (
        "ageing of the bias alone is a ramp: (a + t) kb with kb = R, a in the turn-on bias"
    ),
    frozenset({"warm_up", "rate_ramp"}): (
        "a warm-up is a ramp as long as the log is short against its time constant"
    ),
    frozenset({"misalignment", "scale_factor"}): (
        "turned about one axis alone, one column is all that a log shows of both"
    ),
    frozenset({"scale_factor", "scale_factor_asymmetry"}): (
        "turned in one sense alone, x and |x| are the same up to their sign"
    ),
    frozenset({"scale_factor_asymmetry", "scale_factor_nonlinearity"}): (
        "at turns of one speed, to and fro, |x| and x^2 are in one proportion"
    ),
    frozenset({"scale_factor_cubic", "saturation"}): (
        "a ceiling that is hardly reached bends the largest inputs as a cubic does"
    ),
    frozenset({"cross_axis_nonlinearity", "scale_factor_nonlinearity"}): (
        "where gravity acts alone the squares of the three forces add up to g^2, a bias"
    ),
    frozenset({"cross_axis_nonlinearity", "misalignment"}): (
        "near level the vertical force is g, and its square and its products with the others are "
        "linear in the forces"
    ),
    frozenset({"vibropendulous", "misalignment"}): (
        "near level the vertical force is g, and its products with the others are linear in those"
    ),
    frozenset({"bias_asymmetry", "dead_zone"}): (
        "beyond its threshold d a dead zone is a bias of -d sign x; apart only by inputs between "
        "zero and the bias"
    ),
    frozenset({"size_effect", "angular_acceleration"}): (
        "a lever's parts across an axis answer to angular acceleration as its coefficients do; "
        "apart only by the products of rates, the less of it where turns are short"
    ),
    frozenset({"g_sensitivity", "magnetic_sensitivity"}): (
        "without acceleration, turned about the vertical alone, gravity and field keep their angle"
    ),
    frozenset({"heading_locked", "magnetic_sensitivity"}): (
        "an error that the heading takes once round has no name of its own: the field turns so in "
        "the axes of a level body, and whatever else keeps its direction in the world"
    ),
    frozenset({"g_sensitivity", "g2_sensitivity"}): (
        "near level the vertical force is g, and its products with the others are linear in those"
    ),
    frozenset({"temperature_rate", "thermal_bias"}): (
        "a thermometer that is tau seconds late shows kT (T + tau T') for kT T, and how late it is "
        "no log of one sensor says"
    ),
    frozenset({"thermal_hysteresis", "thermal_bias"}): (
        "a play is late on each way of the temperature, as a thermometer may be"
    ),
    frozenset({"quantization", "angle_quantization"}): (
        "a rounded integral makes a comb of the samples, too; apart only by the spectrum of what "
        "rounding leaves, which a step far below the noise does not show"
    ),
    frozenset({"gauss_markov", "bias_instability"}): (
        "in one log flicker noise is a Gauss-Markov process over the decades that it shows"
    ),
    frozenset({"second_gauss_markov", "bias_instability"}): (
        "the second Gauss-Markov process is the first's equation, and flicker noise as near to it"
    ),
    frozenset({"gauss_markov", "second_gauss_markov"}): (
        "one equation: of a single process nothing says whether it is the first or the second"
    ),
    frozenset({"gauss_markov", "rate_random_walk"}): (
        "a process whose correlation time is as long as the log is a random walk"
    ),
    frozenset({"sampling_jitter", "rate_dependent_noise"}): (
        "swung at one frequency, rate and angular acceleration are equally large on the whole"
    ),
    frozenset({"vibration_rectification", "g2_sensitivity"}): (
        "vibration much faster than a second has the mean square that it rectifies"
    ),
}

FINDINGS: dict[str, tuple[str, str]] = {
    "clock_skew": (
        "reference_clock",
        "against one reference, a clock that runs fast is the sensor's or the reference's",
    ),
}
"""Effects that are as well a fault of the reference: the finding that names it, and why. Where
nothing else is named, that finding is right."""


def confounded(one: str, other: str) -> bool:
    """Whether two effects are in the list."""
    return frozenset({one, other}) in CONFOUNDS
