"""The page ``docs/noise.md``: every noise of the catalogue, its theory and what an FMU makes of it.

``python docs/build/noise_page.py`` writes the text and, by ``noise_pictures``, the pictures whose
numbers have changed. Both follow from the ``law`` of each effect; none is named here.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from pages import DOCS, write_changed

from pyimu import units
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.effect import Effect
from pyimu.model.kinds import KINDS
from pyimu.model.law import Law
from pyimu.model.sensor import Sensor
from pyimu.model.typical import magnitudes
from pyimu.shaping import NoiseModel, describe

SAMPLE_PERIOD, SAMPLES, AXIS = 0.01, 2**17, 0
"""Of the FMU's run, s, and the axis that is shown."""

FAST = {"gyro": (100, "deg/s"), "accel": (2, "g")}
"""The input of a sensor whose noise depends on it."""

GROWTH = 1.0
"""The rate of the input where the noise depends on that, in the sensor's own unit a second."""

HEAD = """# Noise

Written by `make generate` from the laws in `pyimu/model/effects` and from `pyimu/shaping`; do not
edit.

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
of at least 99 % if the theory is right.
"""


@dataclass(frozen=True)
class Entry:
    """One noise on the page: an effect that has a law, and the conditions of its picture."""

    effect: Effect

    @property
    def name(self) -> str:
        return self.effect.name

    @property
    def law(self) -> Law:
        return self.effect.law

    @property
    def kind(self) -> str:
        """The sensor of the picture: a gyro, but for a noise that no gyro has."""
        return next(kind for kind in KINDS if kind in self.effect.sensors)

    @property
    def sensor(self) -> Sensor:
        """With the typical figures of a tactical part, and those that the law wants shown."""
        figure = magnitudes(self.name, self.kind)["tactical"]
        typical = {figure.parameter: figure.si, **figure.beside_si}
        return Sensor(self.kind, {self.name: {**typical, **self.law.shown}})

    @property
    def coefficients(self) -> dict[str, float]:
        """Of the axis that is shown, in SI."""
        return self.sensor.of_axis(self.name, AXIS)

    @property
    def at(self) -> float:
        """The true input at the start, in SI."""
        value, unit = FAST[self.kind]
        return value * units.parse(unit).factor if self.law.needs("x") else 0.0

    @property
    def slope(self) -> float:
        """The growth of the true input, in SI a second."""
        # Of a noise that depends on the input as well, growth would make a changing noise.
        return GROWTH if self.law.needs("slope") and not self.law.needs("x") else 0.0

    @property
    def rounds(self) -> bool:
        """Whether it draws nothing and makes noise of other noise."""
        return not self.effect.stochastic and self.law.ramp is None

    @property
    def model(self) -> NoiseModel:
        return describe(self.sensor, self.name, AXIS, SAMPLE_PERIOD, at=self.at, slope=self.slope)


def entries() -> tuple[Entry, ...]:
    """The noises in the order of the catalogue."""
    return tuple(Entry(e) for e in CATALOGUE.values() if e.law is not None)


def documentation(folder: str = "noise") -> str:
    """The page's text; pictures are linked as ``folder/EFFECT.png``."""
    head = HEAD.format(samples=SAMPLES, period=SAMPLE_PERIOD)
    return head + "".join(_section(e, folder) for e in entries())


def _section(entry: Entry, folder: str) -> str:
    effect, law = entry.effect, entry.law
    rows = [
        ("equation", f"${effect.equation}$"),
        ("transfer function $H(s)$", _formula(entry, "transfer")),
        ("poles [1/s]", "none" if law.poles == "none" else f"${law.poles}$"),
        ("two-sided PSD $S(f)$", _formula(entry, "psd")),
        ("Allan deviation $\\sigma(\\tau)$", _formula(entry, "allan")),
        ("in the picture", "; ".join(_shown(entry))),
        ("source", effect.source),
    ]
    table = "\n".join(f"| {name} | {text.replace('|', chr(92) + 'vert ')} |" for name, text in rows)
    title = f"{effect.term[0].upper()}{effect.term[1:]}: `{entry.name}`"
    legend = f"{effect.term}: density and Allan deviation, theory and FMU"
    return (
        f"\n## {title}\n\n| | |\n| --- | --- |\n{table}\n\n"
        + (f"{law.note}\n\n" if law.note else "")
        + f"![{legend}]({folder}/{entry.name}.png)\n"
    )


def _formula(entry: Entry, name: str) -> str:
    """A formula of the law. Raises ValueError where it is not written."""
    text = getattr(entry.law, name)
    if not text:
        raise ValueError(f"effect {entry.name}: its law lacks {name}=, a formula for docs/noise.md")
    return f"${text}$"


def _shown(entry: Entry) -> Iterable[str]:
    """The coefficients of the picture, its conditions, and what follows from them."""
    unit_of = {slot.parameter: slot.unit for slot in entry.sensor.slots}
    for name, value in entry.coefficients.items():
        yield f"{name} = {value:.4g} {unit_of[name]}"
    if entry.at:
        value, unit = FAST[entry.kind]
        yield f"at {value} {unit}"
    if entry.slope:
        yield f"at {entry.slope:g} {entry.sensor.unit('{y}/s')}"
    if entry.rounds:
        yield "the error alone, under white noise of one step"
    model = entry.model
    if len(model.poles) and model.poles.any():
        yield f"poles {', '.join(f'{p:.4g}' for p in model.poles)} 1/s"
    if np.isfinite(model.standard_deviation):
        yield f"standard deviation {model.standard_deviation:.4g} {model.unit}"


def write(folder: Path | str) -> list[Path]:
    """Write ``noise.md`` and ``noise/*.png`` to a folder; gives the paths of those that changed.

    Where a picture has changed an FMU is built and run, which takes a compiler and 10 s a picture.
    """
    from noise_pictures import draw  # matplotlib and fmpy, which the text does without

    folder = Path(folder)
    page = folder / "noise.md"
    (folder / "noise").mkdir(parents=True, exist_ok=True)
    written = [page] if write_changed(page, documentation()) else []
    return written + draw(folder / "noise", entries())


if __name__ == "__main__":
    for path in write(DOCS):
        print(path)
