"""How well the sensor's motion behind a filter explains a reference."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np
from scipy.ndimage import gaussian_filter1d

from pyimu.identification.fit.columns import band_segments, band_time, in_band
from pyimu.identification.fit.damping import slopes
from pyimu.identification.fit.interpolated import delayed
from pyimu.identification.fit.most_white import least_density
from pyimu.identification.fit.sample_noise import rest_noise
from pyimu.identification.fit.trial import Trial
from pyimu.identification.fit.whiten import Autoregressive
from pyimu.identification.reference.moving import moving_rows
from pyimu.model.kinds import OWN
from pyimu.recording.reference.filters import turned_by

SHARE = 0.5
"""Of the rows that must be left by the filters that are judged."""

SURE = 3.0
"""Standard errors by which a filter must explain more than the sensor's noise that it smooths."""

TOLD = 1e-3
"""Rows by which a clock is off that is put right."""


class Judge:
    """Of filters what each leaves of a trial's reference, by one noise.

    Rows that the filter that reaches furthest does not know are left out for all; one that leaves
    less than ``SHARE`` of them is not judged. A filter that is None leaves the motion as it is.
    """

    def __init__(self, trial: Trial, filters: Sequence) -> None:
        self.whole, self.known, self.of_sensor = trial, {}, {}
        self.made: dict = {}
        reaches = [r for r in {f.reach(trial.h) for f in filters} if self._is_short(r)]
        self.reach = max(reaches, default=0)
        inner = [(a + self.reach, b - self.reach) for a, b in trial.segments]
        self.trial = replace(trial, segments=[(a, b) for a, b in inner if b > a])
        self.time, self.segments = band_time(self.trial), band_segments(self.trial)
        self.noise: list[Autoregressive] = []
        if reaches:
            self._settle([f for f in filters if self._reaches(f)])

    @property
    def any_short(self) -> bool:
        """Whether any of the filters is short enough for the trial to be judged."""
        return bool(self.noise)

    def left(self, one) -> float:
        """Power of what a filter leaves of the reference, in units of its noise, less what the
        sensor's own noise has of it; inf where the filter reaches too far.
        """
        return self._judged(one)[0]

    def gain(self, one) -> float:
        """By how much a filter leaves less than none does, less what the noise of the sensor may
        make of that by chance, which a filter smooths.
        """
        lost = max(self._own(None) - self._own(one), 0.0) if self._reaches(one) else 0.0
        rows = len(self.time) * len(self.noise)
        # Of its squares, as they are and as they were drawn, and of its products with all else.
        chance = 2.0 * lost / np.sqrt(max(rows, 1)) + 2.0 * np.sqrt(lost)
        return self.left(None) - self.left(one) - SURE * chance

    def alike(self, one) -> float:
        """That part of it which looks like what filters take away: what the motion's second, fourth
        and sixth derivatives explain, and what other axes turn an axis by, to second order and to
        fourth, less what these explain of noise.
        """
        return self._judged(one)[1]

    def _reaches(self, one) -> bool:
        return one is None or one.reach(self.whole.h) <= self.reach

    def _is_short(self, reach: int) -> bool:
        lengths = [b - a for a, b in self.whole.segments]
        return sum(max(n - 2 * reach, 0) for n in lengths) >= SHARE * sum(lengths)

    def _settle(self, filters: Sequence) -> None:
        """The noise: that of the filter which leaves least as it stands."""
        self.made = {f: self._columns(f) for f in filters}
        rest = [self._rest(columns) for columns in self.made.values()]
        best = min(rest, key=lambda r: float(np.sum(np.square(r))))
        self.noise = [Autoregressive.fit([(column, self.time, self.segments)]) for column in best.T]
        period = self.whole.h * self.whole.band.stride
        most = least_density(best, self.segments, period) / self.whole.h
        self.most = np.full(3, np.inf)
        self.most[list(self.trial.axes)] = np.sqrt(most)

    def _rest(self, columns: Sequence[np.ndarray]) -> np.ndarray:
        """What the columns (m, c) of each axis leave of it (m, k)."""
        each = zip(columns, self.shown.T, strict=True)
        return np.stack([y - explained(x, y) for x, y in each], axis=1)

    def _judged(self, one) -> tuple[float, float]:
        if not self.noise or not self._reaches(one):
            return np.inf, np.inf
        if one not in self.known:
            columns = self.made.pop(one) if one in self.made else self._columns(one)
            power, alike = -self._own(one), 0.0
            for i, noise in enumerate(self.noise):
                y, x, more = self._white(noise, self.shown[:, [i]], columns[i], self._taken[i])
                y, more = y - explained(x, y), more - explained(x, more)
                more = more / np.maximum(np.linalg.norm(more, axis=0), 1e-300)
                power += float(np.sum(y**2))
                alike += float(np.sum(explained(more, y) ** 2)) - more.shape[1]
            self.known[one] = power, alike
        return self.known[one]

    def _own(self, one) -> float:
        """Power of the sensor's white noise behind a filter, in units of the noise: little beside
        that of a camera's attitudes, and most of what a star tracker's or positions leave.
        """
        if one not in self.of_sensor:
            drawn = np.array(self._drawn)
            if one is not None:
                for a, b in self.whole.segments:
                    drawn[a:b] = one.seen(drawn[a:b], self.whole.h, None)
            seen = in_band(self.trial, self._as_reference(drawn))
            each = zip(self.noise, seen.T[..., None], strict=True)
            power = [np.sum(self._white(noise, column)[0] ** 2) for noise, column in each]
            self.of_sensor[one] = float(sum(power))
        return self.of_sensor[one]

    @cached_property
    def _drawn(self) -> np.ndarray:
        """A draw (n, 3) of the sensor's white noise, no more than is left of the reference."""
        std = np.fmin(np.nan_to_num(rest_noise(self.whole)), self.most)
        return std * np.random.default_rng(1).standard_normal(self.whole.y.shape)

    def _as_reference(self, values: np.ndarray) -> np.ndarray:
        """Values (n, 3) of the sensor's that are kept beside the reference, of the axes that are
        judged: of a rate all.
        """
        return values[:, list(self.trial.axes)]

    def _white(self, noise: Autoregressive, *columns: np.ndarray) -> list[np.ndarray]:
        """Columns beside white noise, less the rows on which samples without information weigh."""
        white = noise.whiten(np.column_stack(columns), self.time, self.segments)
        if self._bad.any():
            memory = np.ones(len(noise.coefficients) + 1)
            white = white[np.convolve(self._bad, memory)[: len(self._bad)] == 0.0]
        return np.split(white, np.cumsum([c.shape[1] for c in columns])[:-1], axis=1)

    @cached_property
    def _bad(self) -> np.ndarray:
        """Marks (m,) of the rows on which samples without information weigh."""
        return ~moving_rows(self.trial)

    def _columns(self, one) -> list[np.ndarray]:
        """A bias, the motion behind the filter and what a clock makes of it (m, 7), for each axis
        the same.
        """
        moved = self._behind(one)
        x = self._with_slopes(moved)
        # A clock that was measured beside the filter is a little off.
        found = np.linalg.lstsq(x, self.shown)[0]
        turn, late = found[1:4], found[4:7]
        power = float(np.sum(turn * turn))
        lead = float(np.sum(turn * late)) / power / self.whole.h if power > 0.0 else 0.0
        return [self._with_slopes(self._led(moved, lead))] * len(self.trial.axes)

    def _led(self, moved: np.ndarray, lead: float) -> np.ndarray:
        """Values (n, k) so many rows earlier, as far as the rows that are judged know them."""
        if TOLD < abs(lead) < self.reach:
            for a, b in self.whole.segments:
                moved[a:b] = delayed(moved[a:b], -lead)
        return moved

    def _behind(self, one) -> np.ndarray:
        trial, moved = self.whole, np.array(self.whole.y)
        if one is not None:
            for a, b in trial.segments:
                turned = self._turned[a] if self._turned else None
                moved[a:b] = one.seen(moved[a:b], trial.h, turned)
        return moved

    @cached_property
    def shown(self) -> np.ndarray:
        """What the reference shows (m, k), in the band."""
        trial = self.trial
        return in_band(trial, trial.u[:, OWN[trial.kind]][:, list(trial.axes)])

    @cached_property
    def _turned(self) -> dict[int, np.ndarray]:
        """By what the body has turned in a segment, by its first row, beside an attitude."""
        trial = self.whole
        if trial.reference != "attitude":
            return {}
        return {a: turned_by(trial.y[a:b], trial.h) for a, b in trial.segments}

    def _with_slopes(self, moved: np.ndarray) -> np.ndarray:
        columns = np.column_stack([moved, slopes(self.whole, moved)])
        x = in_band(self.trial, columns)
        return np.column_stack([np.ones(len(x)), x])

    @cached_property
    def _taken(self) -> list[np.ndarray]:
        """What filters take away (m, 5), of each axis."""
        rate = self._slow(self.whole.y)
        product = np.cross(rate, self._slope(rate, 1))
        columns = [self._slope(rate, times) for times in (2, 4, 6)]
        return self._by_axis([*columns, product, self._slope(product, 2)])

    def _slow(self, values: np.ndarray) -> np.ndarray:
        """Values (n, k) of the sensor's without what is far above the band."""
        trial, out = self.whole, np.zeros(values.shape)
        width = 0.1 / (trial.band_hz * trial.h)
        for a, b in trial.segments:
            out[a:b] = gaussian_filter1d(values[a:b], width, axis=0)
        return out

    def _slope(self, values: np.ndarray, times: int) -> np.ndarray:
        return self._slope(slopes(self.whole, values), times - 1) if times else values

    def _by_axis(self, columns: Sequence[np.ndarray]) -> list[np.ndarray]:
        """Values (n, 3) each, in the band: those (m, c) of each axis."""
        axes = self.whole.axes
        return [in_band(self.trial, np.stack([c[:, i] for c in columns], axis=1)) for i in axes]


def explained(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """What columns x (m, c) explain of y (m, k)."""
    return x @ np.linalg.lstsq(x, y)[0]
