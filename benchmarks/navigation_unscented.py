"""The position filter beside its unscented form: ``python benchmarks/navigation_unscented.py
[runs] [first seed]``.

The same errors, mechanisation, noise, measurements and gates, but the covariance through points of
the error state (Julier and Uhlmann 2004, with the spread of a normal distribution's fourth moment)
in place of its derivative.
Printed is, for the drive of ``benchmarks/navigation.py`` with declared rests, how far the two paths
lie apart in standard deviations of the linear one (root mean square, at most and when, at the end),
the error of each at the end in m, and how their standard deviations at the end compare.
"""

import sys
from dataclasses import replace

import casadi as ca
import numpy as np
from navigation import MORE, PART
from navigation_consistency import known, logged

from pyimu.ins import run
from pyimu.ins.filter import ins_block, prediction, updates
from pyimu.ins.filter.layout import BASE, State
from pyimu.rover.trajectory import Drive, motion, stop_times
from pyimu.symbolic import quaternion

SPREAD = 3.0
"""Squared distance of a point in standard deviations."""


class Unscented:
    """The filter of a layout by points; ``position`` and ``std`` (n, 3) are of a run."""

    def __init__(self, layout, p, h):
        self.layout, self.p, self.h, self.n = layout, p, h, layout.errors
        self.step = ins_block._predict(layout)
        self.moved, self.between, self.rate = _functions(layout, p)
        rest = SPREAD - self.n
        self.mean_weights = np.full(2 * self.n + 1, 0.5 / SPREAD)
        self.weights = self.mean_weights.copy()
        self.mean_weights[0] = rest / SPREAD
        # of the point in the middle as in the scaled form, whose covariance is never too small
        self.weights[0] = rest / SPREAD + 3 - SPREAD / self.n

    def points(self, x, covariance):
        root = np.linalg.cholesky(covariance * SPREAD)
        errors = np.column_stack([np.zeros(self.n), root, -root])
        return np.array(
            self.moved.map(errors.shape[1])(np.tile(x[:, None], errors.shape[1]), errors)
        )

    def gathered(self, points, noise):
        """The mean of the points and the covariance of their errors about it."""
        count, x = points.shape[1], points[:, 0]
        for _ in range(2):
            off = np.array(self.between.map(count)(np.tile(x[:, None], count), points))
            x = np.array(self.moved(x, off @ self.mean_weights)).ravel()
        off = np.array(self.between.map(count)(np.tile(x[:, None], count), points))
        covariance = (off * self.weights) @ off.T + noise
        return x, (covariance + covariance.T) / 2

    def predicted(self, x, covariance, memory, u):
        """The estimate a sample later, the memory, and the rate of the sample."""
        points = self.points(x, covariance)
        count = points.shape[1]
        none = np.zeros((self.layout.packed - self.layout.nominal, count))
        state = np.vstack([points, none, np.tile(memory[:, None], count)])
        packed, kept, rate, *_ = self.step.map(count)(state, u, self.p, self.h)
        packed = np.array(packed)
        noise = _unpacked(packed[self.layout.nominal :, 0], self.n)
        x, covariance = self.gathered(packed[: self.layout.nominal], noise)
        return x, covariance, np.array(kept)[:, 0], np.array(rate)[:, 0]

    def corrected(self, x, covariance, measure, z, noise):
        points = self.points(x, covariance)
        count = points.shape[1]
        off = np.array(self.between.map(count)(np.tile(x[:, None], count), points))
        shown = np.array(measure(points))
        mean = shown @ self.mean_weights
        spread = shown - mean[:, None]
        own = (spread * self.weights) @ spread.T + np.diag(noise)
        cross = (off * self.weights) @ spread.T
        innovation = z - mean
        nis = innovation @ np.linalg.solve(own, innovation)
        shrink = min(1.0, updates.gate(3) / max(nis, 1e-30))
        gain = np.linalg.solve(own, cross.T).T
        covariance = covariance - shrink * gain @ own @ gain.T
        x = np.array(self.moved(x, shrink * gain @ innovation)).ravel()
        return x, (covariance + covariance.T) / 2

    def run(self, log, block, settings):
        layout, n = self.layout, len(log.time)
        state = np.array(block.initial(block.start_inputs, self.p)[0]).ravel()
        white = np.array(ca.evalf(settings.gyro.white)).ravel() ** 2 / self.h + 1e-16
        zupt = np.full(3, float(settings.scalar["zupt_std"]) ** 2)
        u = np.tile(block.start_inputs, (n, 1))
        u[:, :3], u[:, 3:6], u[:, 7] = log.gyro, log.accel, log.stationary
        memory = state[layout.packed :]
        position, std = np.zeros((n, 3)), np.zeros((n, 3))
        for k in range(n):
            if k == 0:
                packed, kept, *_ = self.step(state, u[0], self.p, self.h)
                packed = np.array(ins_block._first(layout)(packed, kept, self.p)).ravel()
                x, memory = packed[: layout.nominal], np.array(kept).ravel()
                covariance = _unpacked(packed[layout.nominal :], self.n) + 1e-12 * np.eye(self.n)
                continue
            x, covariance, memory, rate = self.predicted(x, covariance, memory, u[k])
            if log.stationary[k] > 0.5:
                level = self._level(x)
                x, covariance = self.corrected(x, covariance, level, np.zeros(3), zupt)
                x, covariance = self.corrected(x, covariance, self.rates, rate, white)
            position[k], std[k] = x[7:10], np.sqrt(np.diag(covariance)[6:9])
        return position, std

    def _level(self, x):
        """The velocity in the axes of the body, which the attitude error does not touch."""
        return lambda points: self.rate[0].map(points.shape[1])(points)

    def rates(self, points):
        return self.rate[1].map(points.shape[1])(points)


def _unpacked(column, n):
    out = np.zeros((n, n))
    out[np.triu_indices(n)] = column
    return out + np.triu(out, 1).T


def _functions(layout, p):
    """``x, error -> x``, ``x, x -> error``, and what a zero velocity and a zero rate measure."""
    ends = np.cumsum([0, 4, 3, 3, 3, 3, len(layout.gains), 2 * layout.nhc, 0, 0, 3]).tolist()
    settings = prediction.settings_of(layout, ca.SX(ca.DM(p)))

    def state(column):
        return State(*ca.vertsplit(column, ends), ca.SX(layout.errors, layout.errors))

    a, b = (ca.SX.sym(name, layout.nominal) for name in "ab")
    error = ca.SX.sym("e", layout.errors)
    values = tuple(vars(updates.changed(layout, state(a), error)).values())[:-1]
    moved = ca.Function("moved", [a, error], [ca.densify(ca.vertcat(*values))])
    x, y = state(a), state(b)
    turn = quaternion.product(y.q, quaternion.conjugate(x.q))
    size = ca.norm_2(turn[1:] + 1e-150)
    angle = 2 * ca.atan2(size, ca.fabs(turn[0])) / size * ca.sign(turn[0]) * turn[1:]
    axes, about = quaternion.to_matrix(x.q), ca.vertcat(0, 0, -angle[2])
    off = [
        angle,
        quaternion.rotate(quaternion.conjugate(turn), y.velocity) - x.velocity,
        quaternion.rotate(quaternion.exponential(about), y.position) - x.position,
        axes @ (y.gyro_bias - x.gyro_bias),
        axes @ (y.resting - x.resting),
        y.gains - x.gains,
        y.mounting - x.mounting,
    ]
    between = ca.Function("between", [a, b], [ca.densify(ca.vertcat(*off))])
    back = quaternion.conjugate(x.q)
    earth = quaternion.rotate(back, settings.earth)
    rate = earth + layout.matrix(x.gains, "gyro") @ earth + x.gyro_bias
    own = ca.Function("own", [a], [quaternion.rotate(back, x.velocity)])
    return moved, between, (own, ca.Function("rate", [a], [ca.densify(rate)]))


def main(runs, first):
    drive = Drive(**MORE)
    truth = motion(drive)
    still = np.zeros(len(truth.time))
    for start, stop in stop_times(drive):
        still[(truth.time > start) & (truth.time < stop)] = 1.0
    own = known(PART, calibrated=True)
    print(f"{'apart [std]':8}{'RMS':>6}{'most':>9}{'at, s':>8}{'at the end':>12}", end="")
    print(f"{'end, linear':>12}{'unscented':>12}{'std':>8}")
    for seed in range(first, first + runs):
        log = replace(logged(own, truth, seed), stationary=still)
        found = run(log, own, method="filter")
        linear, std = found.filter.vector("position"), found.filter.vector("position_std")
        layout = ins_block.Layout(_part_of(log, own))
        block = ins_block.ins_of_log(layout)
        p = np.array([found.settings[v.name] for v in block.parameters])
        settings = prediction.settings_of(layout, ca.SX(ca.DM(p)))
        position, wide = Unscented(layout, p, log.sample_period).run(log, block, settings)
        apart = np.abs(position - linear)[:, :2] / np.maximum(std[:, :2], 1e-3)
        far = int(np.argmax(apart.max(axis=1)))
        rms = np.sqrt(np.mean(apart**2))
        place = np.column_stack([log.ref_east, log.ref_north])[-1]
        ends = [np.linalg.norm(x[-1, :2] - place) for x in (linear, position)]
        ratio = np.mean(wide[-1, :2] / std[-1, :2])
        print(
            f"seed {seed:4}{rms:9.2f}{apart.max():9.2f}{log.time[far]:8.1f}{apart[-1].max():12.2f}"
            f"{ends[0]:12.3f}{ends[1]:12.3f}{ratio:8.2f}",
            flush=True,
        )


def _part_of(log, part):
    """The part as the run takes it."""
    from pyimu.ins.known import known_part
    from pyimu.ins.stops import clean_of, rest_at_start
    from pyimu.units import STANDARD_GRAVITY

    return known_part(part, log, rest_at_start(clean_of(log, part), part, STANDARD_GRAVITY))


assert BASE == 15  # the errors that are taken apart above


if __name__ == "__main__":
    main(
        int(sys.argv[1]) if len(sys.argv) > 1 else 3,
        int(sys.argv[2]) if len(sys.argv) > 2 else 0,
    )
