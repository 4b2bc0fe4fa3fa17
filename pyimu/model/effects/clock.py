"""A sample that is not taken when its time says."""

from pyimu.model.effect import OWN_RATE, Confound, Environment, Law, Noise, Parameter, effect


@effect(
    stage="gain",
    term="clock skew",
    equation=r"y = x + \epsilon t \dot x",
    source="no source; first order in the time by which the clock is off, short against the motion",
    # The inverse of x + eps t dx/dt with a difference for dx/dt grows without bound once
    # eps t < -h / 2, and what a causal inverse lacks are the samples to come.
    invertible=False,
    clock=lambda eps: eps,
    confound=Confound(
        "a clock of the reference that runs at another rate",
        "one clock for sensor and reference",
    ),
)
def clock_skew(
    x,
    eps: Parameter(
        "1",
        (),
        description="relative error of the clock's rate; eps t must stay short against the motion",
    ),
    t: Environment("time"),
    slope: Environment(OWN_RATE),
):
    return x + eps * t * slope


@effect(
    stage="noise",
    term="sampling jitter",
    equation=r"y = x + s_j \dot x w",
    source="no source; first order in the jitter, one draw a sample for all axes",
    law=Law(
        white=lambda sj, slope, h: (sj * slope) ** 2 * h,
        transfer=r"s_j |\dot x| \sqrt{h}",
        psd=r"s_j^2\, \dot x^2\, h",
        allan=r"s_j |\dot x| \sqrt{\frac{h}{\tau}}",
        note="White from sample to sample, whatever the period; the same draw on all axes.",
    ),
)
def sampling_jitter(
    x,
    sj: Parameter(
        "s", (), minimum=0.0, description="standard deviation of the instant of sampling"
    ),
    slope: Environment(OWN_RATE),
    w: Noise(1),
):
    return x + sj * slope * w
