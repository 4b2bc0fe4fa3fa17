"""Noise as a filter on white noise: shaping filters, power spectral densities and Allan deviations.

A stochastic effect is a linear system driven by standard normals. It is had in two ways, which the
tests hold against each other: ``shaping_filter`` takes the Jacobians of the effect's own step, so
that the spectrum that is drawn is the spectrum of what is simulated, its sampling included;
``continuous_filter`` is the field's filter on continuous white noise, which ``discretise`` samples
by Van Loan's method. ``describe`` puts both together in a ``NoiseModel``::

    model = describe(part.gyro, "gauss_markov", 0, part.sample_period)
    model.poles, model.psd_two_sided(f), model.allan_deviation(tau), model.stationary_covariance

Densities here are two-sided: white noise N has the density N^2 at every frequency of either sign.
Each name is loaded when it is first used: what needs only a closed form does without
python-control, which takes as long to load as an Allan deviation of a million samples.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submod_attrs={
        "allan": ["allan_deviation"],
        "closed": [
            "angle_quantization_deviation",
            "flicker_floor",
            "gauss_markov_deviation",
            "ramp_deviation",
            "random_walk_deviation",
            "white_deviation",
        ],
        "continuous": [
            "continuous_filter",
            "discretise",
            "spectral_factor",
            "transfer_function",
        ],
        "model": ["NOISE_LIKE", "NoiseModel", "describe"],
        "sampled": ["psd_two_sided", "shaping_filter"],
    },
)
