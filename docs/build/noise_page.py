"""The page ``docs/noise.md``: every noise of the catalogue with its theory, and what an FMU makes
of it.

``python docs/build/noise_page.py`` writes the text and, by ``noise_pictures``, the pictures whose
numbers have changed.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import pi
from pathlib import Path

import numpy as np
from pages import DOCS, write_changed

from pyimu.model.catalogue import CATALOGUE
from pyimu.model.sensor import Sensor
from pyimu.model.typical import magnitudes
from pyimu.shaping import NoiseModel, describe

SAMPLE_PERIOD, SAMPLES, AXIS = 0.01, 2**17, 0
"""Of the FMU's run, s, and the axis that is shown."""

HEAD = """# Noise

Written by `make generate` from `pyimu/shaping` and `docs/build/noise_page.py`; do not edit.

Every noise of the catalogue as a filter on white noise. Densities are two-sided: white noise N has
the density $N^2$ at every frequency of either sign, and what a spectrum analyser shows, one-sided,
is twice as much. $w$ is white noise of density 1, or in a sampled equation a standard normal; $h$
is the sample period, $n = \\tau / h$ the samples in a cluster. The density and the Allan deviation
are those of the samples; far below the Nyquist frequency $1 / (2 h)$ the density is
$|H(j 2 \\pi f)|^2$ of the transfer function. `pyimu.shaping.describe` gives all of it for a
sensor's own coefficients:

```python
import numpy as np, pyimu
from pyimu.shaping import describe

part = pyimu.part("stim300")
h = part.sample_period
f, tau = np.geomspace(1e-4, 0.5 / h), h * 2 ** np.arange(20)
model = describe(part.gyro, "bias_instability", 0, h)
model.poles, model.psd_two_sided(f), model.allan_deviation(tau)
model.stationary_covariance, model.bode(f), model.discrete(h)
```

Each picture: a gyro of typical tactical size, {samples} samples every {period:g} s out of an FMU
(FMI 2.0, run by fmpy). Black: the theory of the samples; dashed: the continuous form where it is
another; points: the FMU; shaded: where all points of all pictures lie together with a probability
of 99 % if the theory is right.
"""


@dataclass(frozen=True)
class Entry:
    """One noise on the page: the effect, its formulae, and the conditions of its picture.

    ``form`` replaces coefficients that would not fit the length of the run; ``at`` [rad/s] and
    ``slope`` [rad/s^2] are the true rate and its growth; ``dither`` is the white noise, in steps
    per sample, that rounding needs.
    """

    effect: str
    transfer: str
    poles: str
    psd: str
    allan: str
    note: str = ""
    form: Mapping[str, float] = field(default_factory=dict)
    at: float = 0.0
    slope: float = 0.0
    dither: float = 0.0

    @property
    def coefficients(self) -> dict[str, float]:
        """In SI: the typical figures of a tactical gyro, and ``form``."""
        figure = magnitudes(self.effect, "gyro")["tactical"]
        return {figure.parameter: figure.si, **figure.beside_si, **self.form}

    @property
    def sensor(self) -> Sensor:
        return Sensor("gyro", {self.effect: self.coefficients})

    @property
    def model(self) -> NoiseModel:
        return describe(self.sensor, self.effect, AXIS, SAMPLE_PERIOD, at=self.at, slope=self.slope)


ENTRIES = (
    Entry(
        "angle_quantization",
        r"Q \sqrt{h}\, s,\quad Q = q / \sqrt{12}",
        "none",
        r"\frac{4 Q^2}{h} \sin^2(\pi f h) \approx (2 \pi f)^2 Q^2 h",
        r"\frac{\sqrt 3\, Q}{\tau}",
        "The angle's rounding error is independent from sample to sample where other noise turns "
        "the sensor by half a step a sample or more. The picture shows the error alone, the FMU's "
        "output less that of the same noise unrounded.",
        dither=1.0,
    ),
    Entry(
        "quantization",
        r"q \sqrt{h / 12}",
        "none",
        r"\frac{q^2 h}{12}",
        r"q \sqrt{\frac{h}{12\, \tau}}",
        "Rounding of the rate is white noise where other noise exceeds half a step. The picture "
        "shows the error alone.",
        dither=1.0,
    ),
    Entry("angle_random_walk", "N", "none", "N^2", r"\frac{N}{\sqrt\tau}"),
    Entry(
        "bias_instability",
        r"c\, \frac{\prod_{k=1}^{5} (s + z_k)}{\prod_{k=1}^{6} (s + a_k)},\quad "
        r"|H|^2 = \sum_k \frac{g_k^2}{a_k^2 + \omega^2}",
        r"-a_k = -2 \pi f_{low} (f_{high} / f_{low})^{(k - 1) / 5}",
        r"\approx \frac{B^2}{2 \pi f} \quad (f_{low} \le f \le f_{high})",
        r"\approx \sqrt{\tfrac{2 \ln 2}{\pi}}\, B = 0.664\, B",
        "A sum of six Gauss-Markov processes stands for the density. From $f_{{low}}$ to "
        "$f_{{high}}$ it departs from $B^2 / (2 \\pi f)$ by {ripple} dB; the line of the Allan "
        "deviation is the integral of the sum's density.",
    ),
    Entry(
        "rate_random_walk",
        r"\frac{K}{s}",
        "0",
        r"\frac{K^2 h^2}{4 \sin^2(\pi f h)} \approx \frac{K^2}{(2 \pi f)^2}",
        r"K \sqrt{\frac{\tau}{3} \left(1 + \frac{1}{2 n^2}\right)}",
    ),
    Entry(
        "rate_ramp",
        r"\text{none: no random process}",
        "none",
        r"\frac{R^2}{(2 \pi f)^3}\ \text{(a formal label)}",
        r"\frac{R \tau}{\sqrt 2}",
        "A ramp has no density: the label of the field's tables has a divergent Allan integral, "
        "and only the Allan deviation can be compared.",
    ),
    Entry(
        "gauss_markov",
        r"\frac{q}{s + 1 / \tau_c}",
        r"-1 / \tau_c",
        r"\frac{q^2 h\, (1 - a^2)\, \tau_c / 2}{1 - 2 a \cos(2 \pi f h) + a^2} \approx "
        r"\frac{q^2 \tau_c^2}{1 + (2 \pi f \tau_c)^2},\quad a = e^{-h / \tau_c}",
        r"q \tau_c \sqrt{\tfrac{1}{\tau} \left[1 - \tfrac{\tau_c}{2 \tau} "
        r"\left(3 - 4 e^{-\tau / \tau_c} + e^{-2 \tau / \tau_c}\right)\right]}",
        "The closed form is the continuous one (IEEE Std 952-2020, annex C); samples lie above, in "
        "the variance by at most $\\left(h / (\\sqrt{{2}}\\, \\tau) + "
        "h / (\\sqrt{{12}}\\, \\tau_c)\\right)^2$ of it. The coefficient `tau` is the correlation "
        "time $\\tau_c$; $\\tau$ alone is the cluster time.",
        form={"tau": 10.0},
    ),
    Entry(
        "rate_dependent_noise",
        r"k\, |x|",
        "none",
        "k^2 x^2",
        r"\frac{k |x|}{\sqrt\tau}",
        "White noise as large as the rate is fast; the picture is at 100 deg/s.",
        at=100 * pi / 180,
    ),
    Entry(
        "sampling_jitter",
        r"s_j |\dot x| \sqrt{h}",
        "none",
        r"s_j^2\, \dot x^2\, h",
        r"s_j |\dot x| \sqrt{\frac{h}{\tau}}",
        "White from sample to sample, whatever the period; the same draw on all axes. The picture "
        "is at 1 rad/s^2.",
        slope=1.0,
    ),
)


def documentation(folder: str = "noise") -> str:
    """The page's text; pictures are linked as ``folder/EFFECT.png``."""
    return HEAD.format(samples=SAMPLES, period=SAMPLE_PERIOD) + "".join(
        _section(e, folder) for e in ENTRIES
    )


def _section(entry: Entry, folder: str) -> str:
    effect = CATALOGUE[entry.effect]
    rows = [
        ("equation", f"${effect.equation}$"),
        ("transfer function $H(s)$", f"${entry.transfer}$"),
        ("poles [1/s]", _maths(entry.poles)),
        ("two-sided PSD $S(f)$", f"${entry.psd}$"),
        ("Allan deviation $\\sigma(\\tau)$", f"${entry.allan}$"),
        ("in the picture", _shown(entry)),
        ("source", effect.source),
    ]
    table = "\n".join(f"| {name} | {text.replace('|', chr(92) + 'vert ')} |" for name, text in rows)
    note = entry.note.format(ripple=_ripple(entry)) if entry.note else ""
    title = f"{effect.term[0].upper()}{effect.term[1:]}: `{entry.effect}`"
    legend = f"{effect.term}: density and Allan deviation, theory and FMU"
    return (
        f"\n## {title}\n\n| | |\n| --- | --- |\n{table}\n\n"
        + (f"{note}\n\n" if note else "")
        + f"![{legend}]({folder}/{entry.effect}.png)\n"
    )


def _maths(text: str) -> str:
    return text if text == "none" else f"${text}$"


def _shown(entry: Entry) -> str:
    """The coefficients of the picture and what follows from them."""
    sensor, model = entry.sensor, entry.model
    units = {slot.parameter: slot.unit for slot in sensor.slots}
    forms = {
        n: q.start
        for n, q in CATALOGUE[entry.effect].parameters.items()
        if n not in entry.coefficients
    }
    parts = [
        f"{name} = {value:.4g} {units[name]}"
        for name, value in {**entry.coefficients, **forms}.items()
    ]
    if len(model.poles) and model.poles.any():
        parts.append(f"poles {', '.join(f'{p:.4g}' for p in model.poles)} 1/s")
    if np.isfinite(model.standard_deviation):
        parts.append(f"standard deviation {model.standard_deviation:.4g} {model.unit}")
    return "; ".join(parts)


def _ripple(entry: Entry) -> str:
    """Lowest and highest departure in dB of f S(f) from B^2 / (2 pi), for the effect's defaults."""
    if entry.effect != "bias_instability":
        return ""
    c = {
        **{n: q.start for n, q in CATALOGUE[entry.effect].parameters.items()},
        **entry.coefficients,
    }
    f = np.geomspace(c["f_low"], c["f_high"], 4001)
    level = 10 * np.log10(
        2 * pi * f * np.abs(entry.model.bode(f).magnitude.ravel()) ** 2 / c["B"] ** 2
    )
    return f"{level.min():.2f} to {level.max():+.2f}"


def write(folder: Path | str) -> list[Path]:
    """Write ``noise.md`` and ``noise/*.png`` to a folder; gives the paths of those that changed.

    Where a picture has changed an FMU is built and run, which takes a compiler and 10 s a picture.
    """
    from noise_pictures import draw  # matplotlib and fmpy, which the text does without

    folder = Path(folder)
    page = folder / "noise.md"
    (folder / "noise").mkdir(parents=True, exist_ok=True)
    written = [page] if write_changed(page, documentation()) else []
    return written + draw(folder / "noise")


if __name__ == "__main__":
    for path in write(DOCS):
        print(path)
