"""What is taken for a rest of bodies that creep, or are pushed so gently that no window shows it:
``python benchmarks/navigation_creeps.py [runs] [first seed] [live|auto]``.

Drives on a level floor without vibration, four to seven legs with stops between, half of them with
a turn on the spot, by a consumer unit of which nothing is told. A creep goes at 1 to 3 cm/s for 5
to 20 s, begun and ended within 0.2 to 2 s; a drive at 0.3 to 1 m/s; a gentle one is pushed or
braked, or both, by 0.02 to 0.04 m/s^2 for 10 to 50 s. Of one kind of log a third of the legs are
drives and the others creeps; one has drives alone and shakes twice as much, at rest, too.
Printed are, of the unit's detector (``live``) or that of a log (``auto``): the seconds that move at
above 5 mm/s and count as rest, and of how many they are; the share of the true rests that was
found, median and least; the error at the end, median and largest; its size over its standard
deviation, root mean square and largest, and the mean of its normalised square (1 is right).
"""

import sys

import numpy as np

from pyimu import Recording
from pyimu.ins import run
from pyimu.units import STANDARD_GRAVITY

RUNS, FIRST = 20, 8300
H = 0.01
RATE, FORCE, WALK, WANDER = 8e-4, 0.03, 3e-5, 1e-4
"""rad/s and m/s^2 of white noise of a sample at 100 Hz; rad/s/sqrt(s) and m/s^2/sqrt(s)."""

GAIN, ASKEW = 0.01, 0.01
"""Scale factors, 1, and misalignments, rad."""

MOVES = 0.005
"""m/s; less is how a body settles."""

KINDS = ("creeps", "creeps, some drives", "gentle drives", "drives", "drives, shaken rests")


def bell(gain, seconds):
    """m/s^2; what gains so many m/s within some seconds."""
    count = max(2, round(seconds / H))
    shape = 1 - np.cos(2 * np.pi * (np.arange(count) + 0.5) / count)
    return gain * shape / shape.sum() / H


def push(gain, size):
    """m/s^2; what gains so many m/s by so much, that comes and goes within a second."""
    count = max(4, round(gain / size / H))
    ramp = np.clip(np.arange(count) * H + 0.5 * H, None, 1.0)
    shape = np.minimum(ramp, ramp[::-1])
    return gain * shape / shape.sum() / H


def none(seconds):
    return np.zeros(round(seconds / H))


def leg(kind, rng):
    """m/s^2 (n,) along the body, of a leg from rest to rest."""
    if kind == "creeps, some drives":
        kind = "drives" if rng.random() < 1 / 3 else "creeps"
    if kind == "creeps":
        speed, lasts = rng.uniform(0.01, 0.03), rng.uniform(5, 20)
        begin, end = bell(speed, rng.uniform(0.2, 2)), bell(-speed, rng.uniform(0.2, 2))
    elif kind == "gentle drives":
        size, long = rng.uniform(0.02, 0.04, 2), rng.uniform(10, 50)
        speed, lasts, which = size[0] * long, rng.uniform(2, 20), rng.integers(3)
        quick = rng.uniform(1, 3, 2)
        begin = push(speed, size[0]) if which != 1 else bell(speed, quick[0])
        end = -push(speed, size[1]) if which != 0 else bell(-speed, quick[1])
    else:
        speed, lasts = rng.uniform(0.3, 1.0), rng.uniform(3, 15)
        begin, end = (bell(s * speed, rng.uniform(1, 3)) for s in (1, -1))
    return np.concatenate([begin, none(lasts), end])


def motion(kind, rng):
    """Acceleration along the body and turn rate (n,), and whether it rests, from rest to rest."""
    parts = [(none(rng.uniform(8, 15)), 0.0, True)]
    for _ in range(rng.integers(4, 8)):
        parts.append((leg(kind, rng), 0.0, False))
        parts.append((none(rng.uniform(4, 15)), 0.0, True))
        if rng.random() < 0.5:
            turn, seconds = rng.choice([-1, 1]) * rng.uniform(0.5, 2.5), rng.uniform(2, 5)
            parts.append((none(seconds), bell(turn, seconds), False))
            parts.append((none(rng.uniform(4, 15)), 0.0, True))
    along = np.concatenate([a for a, _, _ in parts])
    turn = np.concatenate([np.zeros(len(a)) + t for a, t, _ in parts])
    return along, turn, np.concatenate([np.full(len(a), r) for a, _, r in parts])


def drive(kind, seed):
    """A log, the true speeds (n,), whether it rests, and where it is at the end (2,)."""
    rng = np.random.default_rng([seed, KINDS.index(kind)])
    along, turn, rests = motion(kind, rng)
    n = len(along)
    speed, heading = np.cumsum(along) * H, np.cumsum(turn) * H
    speed[rests] = 0.0
    course = np.column_stack([np.cos(heading), np.sin(heading)])
    # by trapezoids, as a filter integrates
    mean = np.convolve(along, [0.5, 0.5])[:n] * H
    v = np.cumsum(mean)
    place = np.sum(course * ((v + np.append(0, v[:-1])) / 2 * H)[:, None], axis=0)
    white = rng.standard_normal((4, n, 3))
    louder = 2.0 if kind == KINDS[-1] else 1.0
    walks = np.cumsum(white[:2], axis=1) * np.sqrt(H)
    axes = [
        np.eye(3) + GAIN * np.diag(rng.standard_normal(3)) + ASKEW * rng.standard_normal((3, 3))
        for _ in range(2)
    ]
    rates = np.column_stack([np.zeros((n, 2)), turn])
    forces = np.column_stack([along, speed * turn, np.full(n, STANDARD_GRAVITY)])
    gyro = rates @ axes[0].T + 0.01 * rng.standard_normal(3) + WALK * walks[0]
    accel = forces @ axes[1].T + 0.2 * rng.standard_normal(3) + WANDER * walks[1]
    log = Recording.from_arrays(
        time=H * np.arange(n), gyro=gyro + RATE * white[2], accel=accel + louder * FORCE * white[3]
    )
    return log, speed, rests, place


def judged(kind, seed, zupt):
    """What a run makes of a log: false rest and motion, s; share of the rests; error, m; its square
    over its variance per axis.
    """
    log, speed, rests, place = drive(kind, seed)
    found = run(log, method="filter", zupt=zupt, heading0=0.0)
    track = found.tracks["filter"]
    off, std = track.position[-1, :2] - place, track.position_std[-1, :2]
    both = track.correlation[-1] * std[0] * std[1]
    square = off @ np.linalg.solve([[std[0] ** 2, both], [both, std[1] ** 2]], off) / 2
    moves = np.abs(speed) > MOVES
    false = np.sum(found.still & moves) * H
    return false, np.sum(moves) * H, np.mean(found.still[rests]), np.linalg.norm(off), square


def main(runs, first, zupt):
    print(
        f"{runs} logs of each: false rest, of; rests found, least; end, largest; off, largest, "
        "square"
    )
    for kind in KINDS:
        rows = np.array([judged(kind, seed, zupt) for seed in range(first, first + runs)])
        false, moves, share, end, square = rows.T
        print(
            f"{kind:22} {false.sum():7.1f} {moves.sum():7.0f} s {100 * np.median(share):5.0f} "
            f"{100 * share.min():4.0f} % {np.median(end):8.3g} {end.max():8.3g} m "
            f"{np.sqrt(square.mean()):6.2f} {np.sqrt(square.max()):6.1f} {square.mean():8.2f}",
            flush=True,
        )


if __name__ == "__main__":
    main(
        int(sys.argv[1]) if len(sys.argv) > 1 else RUNS,
        int(sys.argv[2]) if len(sys.argv) > 2 else FIRST,
        sys.argv[3] if len(sys.argv) > 3 else "live",
    )
