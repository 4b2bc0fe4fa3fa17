"""What the numbers of a column say of its unit."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pyimu.recording.guess.gravity_turning import LIKE, turning_of_gravity
from pyimu.units import STANDARD_GRAVITY

SECONDS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9, "day": 86400.0}
"""Units in which clocks count, and the serial dates of spreadsheets."""

STATED = SECONDS | {"min": 60.0, "h": 3600.0}
"""And in which they may as well, where the header says so."""

USUAL = (8.0, 8000.0)
"""Hz; three decades, within which most inertial sensors are sampled: of units a factor of 1000
apart one fits where a clock is off by far."""

POSSIBLE = (4.0, 10000.0)
"""Hz; a clock that two units bring in here may be in either: 5 Hz in s are 5 kHz in ms."""

SLOWEST = 0.01
"""Hz; a unit in which a log would be slower is not worth a word."""

EPOCH = (946684800.0, 4102444800.0)
"""s since 1970 of the years 2000 and 2100: so large a time is a date, and tells its unit."""

TICK = 1e-7
TICKS = {62_135_596_800.0: ".NET's ticks", 11_644_473_600.0: "Windows' file times"}
"""s; in which some programs count, and how long before 1970 they begin."""

SERIAL = 25569.0
"""Days from the first of spreadsheets, 1899-12-30, to 1970."""

NEAR_GRAVITY = 0.1
"""By how much the size of gravity may be off where a sensor rests."""

LEAST_MIDDLE = 512.0
"""The middle of the numbers of a converter of ten bits."""

TURNED_MIDDLE = 0.25
"""By how much all three axes may be off the middle: gravity on one is a fifth of it, as on ADXL335
with OpenSignals' converter."""

FASTEST = 100.0
"""rad/s; hands, vehicles and robots do not turn as fast: larger numbers are degrees a second."""

FASTEST_SHOWN = 10_000.0
"""deg/s; the widest ranges of gyros are 4,000 (LSM6DSV, ICM-45686)."""

RATES = (("rad/s", 1.0), ("deg/s", np.pi / 180), ("mdps", np.pi / 180e3), ("mrad/s", 1e-3))
"""Units of rates and their rad/s; the last two of numbers that are no counts alone."""

WARM, WARM_K = (-40.0, 125.0), (233.15, 398.15)
"""degC and K within which electronics are specified to work."""

WARM_F = (65.0, 115.0)
"""degF; 18 to 46 degC. Electronics that heat themselves, as autopilots do, keep to 60 degC."""

WRAP = 0.05
"""How near to a whole turn a step of an angle must come to be one that is counted anew."""

SENSITIVITIES = {
    **dict.fromkeys((262.4, 131.0, 65.5, 32.8, 16.4), "InvenSense and Bosch"),
    **{1000 / mdps: f"ST, {mdps:g} mdps/LSB" for mdps in (4.375, 8.75, 17.5, 35.0, 70.0, 140.0)},
    **dict.fromkeys((10.0, 20.0, 25.0, 40.0, 50.0, 160.0), "Analog Devices"),
    100.0: "TSND151",
}
"""Counts a deg/s of gyros, and whose (data sheets of MPU-6050, BMI160, LSM6DSO, L3GD20, ADIS16405,
ADIS16448, ADIS16470, ADIS16480 and ADIS16495-1 to -3; TSND151)."""

COUNTS_A_G = {
    k: f" (Analog Devices, {1000 / k:g} mg/LSB)" for k in (800.0, 1200.0, 1250.0, 4000.0)
} | {10000.0: " (0.1 mg/LSB)", 9806.65: " (mm/s^2)"}
"""Counts a g of accelerometers beside powers of two, and whose (data sheets of ADIS16470,
ADIS16448, ADIS16480 and ADIS16495; TSND151)."""

WRITTEN = {1000 * np.pi / 180: "mrad/s", 1000.0: "mdeg/s"}
"""Whole numbers a deg/s of units that programs write."""

WRITTEN_FITS = 0.015
"""By how much these may be off: 17.45 is 6 % off the 16.4 that gyros have."""

GALS = 100 * STANDARD_GRAVITY
"""Gravity in cm/s^2, which is as near to the 1000 mg of a sensor with a usual bias as that is."""

FITS = 0.25
"""By how much a sensitivity may differ from what gravity's turning shows."""

CLEARLY = 2.0
"""How many times as far off, in logarithms, the next sensitivity must be for one to be taken."""

TURN = 361.0
"""deg; no pitch has more, however it is counted."""


@dataclass(frozen=True)
class UnitGuess:
    """A unit and the reason for it; ``unit`` is None where the numbers do not tell.

    ``value`` is the size of one count in ``unit`` where the numbers are counts. ``sizes`` are those
    that it may have, in deg/s or g, and ``choices`` the units, where ``unit`` is None for there are
    several.
    """

    unit: str | None
    why: str
    value: float | None = None
    sizes: tuple[float, ...] = ()
    choices: tuple[str, ...] = ()

    @property
    def fits(self) -> bool:
        """Whether it is one of the vector's units, be it of several."""
        return self.unit is not None or bool(self.choices)


def time_unit(time: np.ndarray) -> UnitGuess:
    """The unit in which the times (n,) count.

    A date tells it; else the one in which alone the rate is possible (``POSSIBLE``). What else it
    may be is in the reason.
    """
    known = time[np.isfinite(time.astype(float))]
    step = np.diff(known)
    step = step[step > 0]
    if len(known) < 3 or not len(step):
        return UnitGuess(None, "the numbers do not rise")
    median, first = float(np.median(step)), float(known[0])
    rates = {unit: 1 / (median * size) for unit, size in SECONDS.items()}
    for unit, size in SECONDS.items():
        since, slowest = first * size, 1e-3
        if unit == "day":
            since, slowest = (first - SERIAL) * size, POSSIBLE[0]
        if EPOCH[0] < since < EPOCH[1] and slowest <= rates[unit] <= 1e6:
            return UnitGuess(unit, f"a date of {_year(since)}, at {rates[unit]:.4g} Hz")
    for before, whose in TICKS.items():
        since, hertz = first * TICK - before, 1 / (median * TICK)
        if EPOCH[0] < since < EPOCH[1] and hertz <= 1e6:
            why = f"a date of {_year(since)} in {whose} of 100 ns, at {hertz:.4g} Hz"
            return UnitGuess("s", why, TICK)
    if np.all(step == 1):
        return UnitGuess(None, "whole numbers one apart: a counter of samples, or times")
    possible = [unit for unit, rate in rates.items() if POSSIBLE[0] <= rate < POSSIBLE[1]]
    if len(possible) != 1:
        either = " or ".join(f"{rates[unit]:.4g} Hz in {unit}" for unit in possible)
        return UnitGuess(None, f"steps of {median:.4g} are {either or 'no usual rate in any unit'}")
    unit = possible[0]
    slower = [f"{r:.4g} Hz in {u}" for u, r in rates.items() if SLOWEST <= r < POSSIBLE[0]]
    other = f" ({slower[0]})" if slower else ""
    return UnitGuess(unit, f"steps of {median:.4g} are {rates[unit]:.4g} Hz then{other}")


def _year(since: float) -> int:
    """The year of a time s since 1970."""
    return int(1970 + since / 31556952)


def warmth_unit(warmth: np.ndarray) -> UnitGuess:
    """The unit of temperatures (n,) of electronics, degC or K, of which ``WARM`` and ``WARM_K``
    have nothing in common; whole numbers may be counts, and are in degC else. What would be hot in
    degC and as warm as a room or a case in degF is left open.
    """
    known = warmth[np.isfinite(warmth)]
    if len(known) and WARM_F[0] < (hot := float(np.median(known))) < WARM_F[1]:
        other = (hot - 32) / 1.8
        return UnitGuess(None, f"{hot:.3g} degC would be hot; in degF it is {other:.3g} degC")
    whole = bool(np.all(known == np.rint(known)))
    if len(known) and not counts(known):
        for unit, (least, most) in (("degC", WARM), ("K", WARM_K)):
            if least < known.min() and known.max() < most and not (whole and unit == "K"):
                return UnitGuess(unit, f"they are {known.min():.4g} to {known.max():.4g}")
    return UnitGuess(None, "degC or K?")


def are_counts_of_warmth(warmth: np.ndarray) -> bool:
    """Whether the temperatures (n,) are whole numbers that no unit of them has in electronics."""
    known = warmth[np.isfinite(warmth)]
    beyond = len(known) and (known.min() < -WARM[1] or known.max() > WARM_K[1])
    return bool(beyond and np.all(known == np.rint(known)))


def counts(values: np.ndarray) -> bool:
    """Whether all numbers are whole, and not few of them."""
    known = values[np.isfinite(values)]
    return len(known) >= 100 and bool(np.all(known == np.rint(known))) and float(np.ptp(known)) > 1


def force_unit(force: np.ndarray) -> UnitGuess:
    """The unit of specific forces (n, 3), by the size of gravity in the quietest tenth."""
    size = resting_size(force)
    if size is None:
        return UnitGuess(None, "no quiet part of the log shows gravity")
    zero = middle(force)
    if zero is not None:
        why = f"whole numbers about {zero:.0f}, as counts without a sign: [scale] takes an offset"
        return UnitGuess(None, why)
    for unit, one in (("m/s^2", STANDARD_GRAVITY), ("g", 1.0), ("mg", 1000.0)):
        if abs(size / one - 1) < NEAR_GRAVITY:
            if unit == "mg" and _is_power(size) and counts(force.ravel()):
                continue
            if unit == "mg" and abs(size / GALS - 1) < min(WRITTEN_FITS, abs(size / one - 1)):
                why = f"gravity is {size:.4g}: mg of a sensor that is off by 2 %, or cm/s^2?"
                return UnitGuess(None, why, choices=("mg", "cm/s^2"))
            return UnitGuess(unit, f"gravity is {size:.4g} then")
    if counts(force.ravel()) and size > 100:
        return _counts_a_g(size)
    if not _has_gravity(force):
        return UnitGuess(None, f"its size is {size:.4g} where it is quiet: without gravity")
    return UnitGuess(None, f"gravity is {size:.4g}, in no usual unit (does the log hold it?)")


def _counts_a_g(size: float) -> UnitGuess:
    """The size of a count of which gravity is ``size``: that of the nearest sensitivity, where the
    next is clearly less near; else both. A maker's own beside a power of two is not told from that
    by where gravity lies: a bias of some 20 mg is as usual.
    """
    seen = f"gravity is {size:.5g} counts"
    sizes = {2.0 ** round(np.log2(size)): "", **COUNTS_A_G}
    near, *others = sorted(sizes, key=lambda k: abs(float(np.log(size / k))))
    if abs(size / near - 1) >= NEAR_GRAVITY:
        return UnitGuess(None, f"{seen}: see the data sheet for LSB/g")
    off, other = (abs(float(np.log(size / k))) for k in (near, others[0]))
    why = f"{seen}, {near:.0f} a g{sizes[near]}"
    rare = near in COUNTS_A_G and others[0] not in COUNTS_A_G and other < NEAR_GRAVITY
    doubted = rare or other < CLEARLY * off
    if other < NEAR_GRAVITY:
        why += f"{' or' if doubted else ', not'} {others[0]:.0f}{sizes[others[0]]}"
    if doubted:
        return UnitGuess(None, why, sizes=(1 / near, 1 / others[0]))
    return UnitGuess("g", why, 1 / near)


def middle(force: np.ndarray) -> float | None:
    """The power of two near which two axes or more lie and none has a sign, as counts (n, 3) of a
    converter have that begin at zero; None of any other numbers.
    """
    if not counts(force.ravel()) or not np.nanmin(force) > 0:
        return None
    middles = np.nanmedian(force, axis=0)
    powers = 2.0 ** np.rint(np.log2(middles))
    off = np.abs(middles / powers - 1)
    for power in powers[powers >= LEAST_MIDDLE]:
        own = off[powers == power]
        if np.count_nonzero(own < NEAR_GRAVITY) > 1 or len(own) == 3 and own.max() < TURNED_MIDDLE:
            return float(power)
    return None


def _is_power(size: float) -> bool:
    return abs(size - 1024) < 20


def resting_size(force: np.ndarray) -> float | None:
    """The median size of the specific force in the quietest tenth of blocks, None without one."""
    length = max(4, min(100, len(force) // 20))
    blocks = force[: len(force) // length * length].reshape(-1, length, 3)
    blocks = blocks[np.all(np.isfinite(blocks), axis=(1, 2))]
    if not len(blocks):
        return None
    spread = blocks.std(axis=1).sum(axis=1)
    quiet = blocks[spread <= np.quantile(spread, 0.1)].mean(axis=1)
    size = float(np.median(np.linalg.norm(quiet, axis=1)))
    return size if size > 0 else None


def rate_unit(rate: np.ndarray, force: np.ndarray | None, period: float | None) -> UnitGuess:
    """The unit of rates (n, 3): how gravity turns in the body shows their size.

    At rest in the world a force f turns by df/dt = -w x f; the slope of what is seen of it on what
    the numbers w make of it is one in rad/s, and pi/180 in deg/s.
    """
    largest = float(np.nanmax(np.abs(rate))) if np.isfinite(rate).any() else 0.0
    if force is not None and period is not None:
        slope = turning_of_gravity(rate, force, period)
        if slope is not None:
            whole = counts(rate.ravel())
            for unit, one in RATES[: 2 if whole else None]:
                if 1 / LIKE < slope / one < LIKE:
                    why = f"gravity turns {slope / one:.2f} times as fast as these say"
                    return UnitGuess(unit, why)
            why = f"gravity turns {slope:.3g} rad for 1 of these"
            if not whole:
                return UnitGuess(None, why)
            size = float(np.degrees(slope))
            return sensitivities(1 / size) or UnitGuess(None, why, sizes=(size,))
    if counts(rate.ravel()):  # no gyro is as coarse as 1 deg/s
        why = "whole numbers, as counts are: see the data sheet for LSB/(deg/s)"
        return UnitGuess(None, why, sizes=tuple(1 / k for k in SENSITIVITIES))
    if largest > FASTEST_SHOWN:
        why = f"{largest:.4g} deg/s would be more than any gyro shows"
        return UnitGuess(None, why, choices=("mdps", "deg/s"))
    if largest > FASTEST:
        return UnitGuess("deg/s", f"{largest:.4g} rad/s would be faster than anything turns")
    return UnitGuess(None, f"rad/s or deg/s? {_lacking(force, period)} to tell")


def _lacking(force: np.ndarray | None, period: float | None) -> str:
    """Why gravity does not tell the unit of rates."""
    if force is None:
        return "there is no accelerometer beside it"
    if period is None:
        return "there is no time of a known unit beside it"
    if not _has_gravity(force):
        return "there is no gravity in the accelerations beside it"
    return "it does not turn enough"


def _has_gravity(force: np.ndarray) -> bool:
    """Whether a force (n, 3) has some size where a body is quiet: that of a phone's linear
    acceleration is small there beside what it is elsewhere.
    """
    size = np.linalg.norm(force, axis=1)
    return (resting_size(force) or 0.0) > 0.5 * float(np.nanmedian(size))


def angle_unit(angles: np.ndarray) -> UnitGuess:
    """The unit of roll, pitch and yaw (n, 3): where one begins anew behind a whole turn, by that;
    else by their size, of which no pitch has more than a quarter of a turn. A yaw that runs on
    behind whole turns began near zero; larger numbers are of a smaller unit.
    """
    known = angles[np.isfinite(angles).all(axis=1)]
    if not len(known):
        return UnitGuess(None, "there are no angles")
    largest, steps = np.abs(known).max(axis=0), np.abs(np.diff(known, axis=0))
    if largest[1] > TURN or np.abs(known).min(axis=0).max() > 2 * TURN:
        return UnitGuess(None, f"they go to {largest.max():.5g}: in hundredths of a degree?")
    turns = (("deg", 360.0), ("rad", 2 * np.pi))
    for unit, turn in turns:
        if np.any(np.abs(steps / turn - 1) < WRAP) and largest.max() < 1.1 * turn:
            return UnitGuess(unit, f"an angle jumps by {turn:.4g}, a whole turn")
    if largest[1] > 1.01 * np.pi / 2 or largest.max() > 1.01 * 2 * np.pi:
        return UnitGuess("deg", f"they go to {largest.max():.4g}, more than angles in rad would")
    why = f"they go to {largest.max():.3g}; in deg it would turn no further than that"
    return UnitGuess("rad", why)


def sensitivities(lsb: float) -> UnitGuess | None:
    """The size of a count of which ``lsb`` seem to be a deg/s, None where no gyro's is near.

    Of two that fit the nearer is taken where that is clear, and the other is said; else both are.
    """
    own = {k: said for k, said in WRITTEN.items() if abs(lsb / k - 1) < WRITTEN_FITS}
    known = {**SENSITIVITIES, **own}
    off = {k: abs(float(np.log(lsb / k))) for k in known}
    near = sorted((k for k in off if abs(lsb / k - 1) < FITS), key=off.__getitem__)[:2]
    if not near:
        return None
    names = [f"{k:.4g} ({known[k]})" for k in near]
    why = f"gravity's turning shows {lsb:.3g} counts a deg/s: {' or '.join(names)}"
    if len(near) > 1 and off[near[1]] < CLEARLY * off[near[0]]:
        return UnitGuess(None, why, sizes=tuple(1 / k for k in near))
    why = why.replace(" or ", ", not ", 1)
    return UnitGuess("deg/s", why, 1 / near[0])
