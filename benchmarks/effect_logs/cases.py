"""The cases of the benchmark: one log, or two, with what its sensor has and its part lacks.

A case depends on its name, its number and the range of durations alone. It is called
``clean/rover``, ``one/8/gyro.g_sensitivity``, ``together/8/...``, ``pair/12/gyro``, ``size1/...``,
``unknown/30/...`` or ``strange/30/...``. A clean log holds gyro and accelerometer, one with an
effect the sensor that has it: what the other is blamed for is counted by the clean ones. In
``attitude/clean/tumble`` and ``attitude/30/gyro.coning`` the reference is an attitude with noise in
each sample, as cameras give it, and no rate; the accelerometer has no reference.
"""

from __future__ import annotations

import zlib
from dataclasses import dataclass, replace

import numpy as np
from generators import rotation
from generators.instrument import Sensor, any_sensor
from generators.motion import rover, shaker, static, table, thermal_cycle, tumble

from effect_logs import nameless, strange
from effect_logs.chain import NAMED, TERMS, Chain, NotShown, at_typical, size_of_all, tuned
from effect_logs.scene import HZ, new_scene
from effect_logs.term import Case, Term

TURNING = (rover, table, tumble, shaker)
MOTIONS = {m.__name__: m for m in (table, rover, tumble, shaker, static, thermal_cycle)}
SIZES = (8, 12, 30)
LEAST = 13.0
"""Sigmas of an effect of the consumer's size, at least; a sensor in which it is less is made
quieter."""

WITHIN, MOST_DRAWS = 0.05, 30
"""Share by which an effect's size may differ from the one that is wanted, and draws of a case until
it does not."""

MINUTES = (5.0, 20.0)
ATTITUDE_NOISE = tuple(np.radians([0.01, 0.2]))
"""rad; from the best to the worst of cameras."""

DIGITS = 12
"""Decimals of a simulated reference, as files hold it."""


@dataclass(frozen=True)
class Truth:
    """One effect that a sensor has and its part lacks: the catalogue's name of it (empty where it
    has none), its coefficient there, and its size in sigmas over the fitted rows.
    """

    kind: str
    term: str
    effect: str
    parameter: str
    value: np.ndarray | float
    size: float
    slow: bool
    form: dict


@dataclass(frozen=True)
class Made:
    """A case: the columns of its logs, its part's file, the form in which it is judged, the truth,
    its motions, by log and kind what the true model leaves (n, 3), the sensor that has the effects
    by log, and their cases by name.
    """

    logs: tuple[dict[str, np.ndarray], ...]
    part: str
    form: str
    truths: tuple[Truth, ...]
    motions: tuple[str, ...]
    left: tuple[dict[str, np.ndarray], ...]
    chains: tuple[Chain, ...]
    cases: dict[str, Case]


@dataclass(frozen=True)
class Wanted:
    """What a case's name says."""

    row: str
    sigmas: float
    kind: str
    terms: tuple[Term, ...]
    motions: tuple[str, ...]


def names(row: str) -> list[str]:
    """The names of the cases of one row of the table."""
    return {
        "clean": [f"clean/{m}" for m in MOTIONS],
        **{f"one_{s}": _of_effects(f"one/{s}", True) for s in SIZES},
        "together_8": _of_effects("together/8", True),
        "pair_12": ["pair/12/gyro", "pair/12/accel"],
        "size1": _of_effects("size1", False),
        "unknown_30": [f"unknown/30/{k}.{t.name}" for t in nameless.TERMS for k in t.sizes],
        "strange_30": [f"strange/30/{k}.{t.name}" for t in strange.TERMS for k in t.sizes],
        "attitude_clean": [f"attitude/clean/{m.__name__}" for m in TURNING],
        **{f"attitude_{s}": _beside_attitudes(s) for s in SIZES[1:]},
    }[row]


SINGLE = tuple(f"one_{s}" for s in SIZES)
ATTITUDES = ("attitude_clean", *(f"attitude_{s}" for s in SIZES[1:]))
ROWS = ("clean", *SINGLE, "together_8", "pair_12", "size1", "unknown_30", "strange_30", *ATTITUDES)


def _of_effects(before: str, by_size: bool) -> list[str]:
    chosen = [t for t in NAMED if t.by_size or not by_size]
    return [f"{before}/{kind}.{t.name}" for t in chosen for kind in t.sizes]


def _beside_attitudes(sigmas: int) -> list[str]:
    """The gyro's effects that a noisy attitude shows: a size in sigmas of those that are random is
    another, and a misalignment is its mounting as well.
    """
    chosen = [t for t in NAMED if t.by_size and t.gain is None and not t.known]
    chosen = [t for t in chosen if "gyro" in t.sizes and t.name != "misalignment"]
    return [f"attitude/{sigmas}/gyro.{t.name}" for t in chosen]


def make(name: str, number: int, minutes: tuple[float, float] = MINUTES) -> Made:
    """The case of a name and a number; ``minutes`` are the shortest and longest log.

    Where an effect's size jumps over the one that is wanted, or the log does not show it, all is
    drawn again; in the declared form, where no log shows it to a part that declares nothing, as a
    process that is no random walk for the short time of one.
    """
    rng = np.random.default_rng([zlib.crc32(name.encode()), number])
    form = _form(_wanted(name, np.random.default_rng(number)), number)
    for tried in dict.fromkeys((form, "declared")):
        for _ in range(MOST_DRAWS):
            try:
                return _drawn(_wanted(name, rng), tried, minutes, rng)
            except NotShown:
                continue
    raise NotShown(f"{name} {number}: no log of {MOST_DRAWS} shows it at its size")


def _drawn(wanted: Wanted, form: str, minutes, rng) -> Made:
    motions = wanted.motions if wanted.row == "together" else (str(rng.choice(wanted.motions)),)
    scenes = [new_scene(rng, MOTIONS[m], 60 * float(rng.uniform(*minutes))) for m in motions]
    sensor = any_sensor(rng)
    beside = wanted.row == "attitude"
    attitude = float(np.exp(rng.uniform(*np.log(ATTITUDE_NOISE)))) if beside else 0.0
    if not wanted.terms:
        chains = _chains(sensor, scenes, form, attitude, rng)
        return _made(wanted, form, motions, chains, {}, sensor, rng)
    made = _with_effects(wanted, form, motions, scenes, sensor, attitude, rng)
    if wanted.row != "size1" and any(not _near(t.size, wanted.sigmas) for t in made.truths):
        raise NotShown
    return made


def _near(size: float, sigmas: float) -> bool:
    return abs(np.log(size / sigmas)) < np.log(1 + WITHIN)


def _wanted(name: str, rng) -> Wanted:
    row, *more = name.split("/")
    if "clean" in (row, more[0]):
        return Wanted(row, 0.0, "", (), (more[-1],))
    if row == "pair":
        terms = _two_of(more[1], rng)
        shared = [m for m in terms[0].motions if m in terms[1].motions]
        return Wanted(row, float(more[0]), more[1], terms, tuple(shared))
    kind, term = more[-1].split(".")
    sigmas = LEAST if row == "size1" else float(more[0])
    motions = ("rover", "table") if row == "together" else TERMS[term].motions
    return Wanted(row, sigmas, kind, (TERMS[term],), motions)


def _two_of(kind: str, rng) -> tuple[Term, ...]:
    """Two effects of a kind of sensor that a log can show together, in the order of action."""
    able = [t for t in NAMED if kind in t.sizes and t.by_size and not t.known]
    able = [t for t in able if "undeclared" in t.forms]
    while True:
        i, j = sorted(rng.choice(len(able), 2, replace=False))
        pair = able[i], able[j]
        if {m for m in pair[0].motions} & {*pair[1].motions} and len({t.right for t in pair}) == 2:
            return pair


def _form(wanted: Wanted, number: int) -> str:
    """Declared and undeclared in turn, where the undeclared form lacks the effects."""
    both = all("undeclared" in t.forms for t in wanted.terms)
    return ("declared", "undeclared")[number % 2] if both else "declared"


def _chains(sensor: Sensor, scenes, form: str, attitude: float, rng) -> list[dict[str, Chain]]:
    """By log the chain of each kind of sensor; each log has a bias of its own."""
    out = []
    for scene in scenes:
        chains = {}
        for kind, spread in (("gyro", 0.01), ("accel", 0.2)):
            triad = replace(getattr(sensor, kind), bias=spread * rng.standard_normal(3))
            seed = int(rng.integers(2**32))
            chains[kind] = Chain(kind, scene, triad, seed, form == "undeclared", attitude)
        out.append(chains)
    return out


def _with_effects(wanted, form, motions, scenes, sensor: Sensor, attitude, rng) -> Made:
    """Each effect is brought to its size alone, and the quietest sensor that any of them asks for
    is taken for all.
    """
    drawn = [(t, t.direction(rng), t.form(rng, scenes[0])) for t in wanted.terms]
    chains = _chains(sensor, scenes, form, attitude, rng)
    for _ in range(4):
        before = chains[0][wanted.kind].triad.n
        effects = {}
        for term, direction, shape in drawn:
            chains, effects[term.name] = _sized(wanted, chains, term, direction, shape)
        if np.array_equal(before, chains[0][wanted.kind].triad.n):
            break
    quiet = chains[0][wanted.kind].triad
    own = replace(getattr(sensor, wanted.kind), n=quiet.n, k=quiet.k)
    declared = replace(sensor, **{wanted.kind: own})
    return _made(wanted, form, motions, chains, effects, declared, rng)


def _sized(wanted: Wanted, chains, term: Term, direction, shape):
    """The chains, as quiet as the effect needs them, and its case in the first log.

    Of several logs together the effect has its size over all of them.
    """
    kind = wanted.kind
    make_case = at_typical if wanted.row == "size1" else tuned
    own = [c[kind] for c in chains]
    quieter, case = make_case(own, term, direction, shape, wanted.sigmas)
    return [c | {kind: q} for c, q in zip(chains, quieter, strict=True)], case


def _moved(case, chain: Chain):
    return chain.case(case.c, case.form)


def _made(wanted: Wanted, form, motions, chains, effects, sensor: Sensor, rng) -> Made:
    needs = {n for t in wanted.terms for n in t.needs}
    for extra in (("supply",), ("mag",), ("ref_q", "latitude", "ref_velocity")):
        # Velocities without noise beside attitudes with it are no reference that anybody has.
        if rng.random() < 0.25 and not (wanted.row == "attitude" and "ref_q" in extra):
            needs |= {*extra}
    logs, left = [], []
    for one in chains:
        measured = {}
        beside = one["gyro"].attitude
        for kind in (wanted.kind,) if effects and not beside else tuple(one):
            own = {n: _moved(e, one[kind]) for n, e in effects.items() if kind == wanted.kind}
            measured[kind] = one[kind].measure(own)
        logs.append(_columns(one["gyro"], measured, needs))
        # In the band of attitudes no residual is that of the samples.
        compared = {} if beside else measured
        left.append({kind: _left(one[kind], effects, y) for kind, y in compared.items()})
    truths = tuple(_truth(wanted.kind, TERMS[n], e, chains) for n, e in effects.items())
    part = sensor.part_file(HZ)
    own = tuple(one[wanted.kind] for one in chains) if effects else ()
    return Made(tuple(logs), part, form, truths, tuple(motions), tuple(left), own, effects)


def _left(chain: Chain, effects, measured: np.ndarray) -> np.ndarray:
    """What the true model leaves (n, 3) of what is measured: the noise, with that of the effects
    that are random.
    """
    fixed = {n: _moved(e, chain) for n, e in effects.items() if TERMS[n].gain is None}
    if len(fixed) == len(effects):
        return chain.noise()
    return measured - chain.measure(fixed) + chain.noise()


def _truth(kind: str, term: Term, case, chains) -> Truth:
    value = np.asarray(term.told(case.c), dtype=float)
    return Truth(
        kind,
        term.name,
        term.right,
        term.parameter,
        value,
        size_of_all([c[kind] for c in chains], term, case),
        term.slow,
        case.form,
    )


def _columns(gyro: Chain, measured, needs) -> dict[str, np.ndarray]:
    scene = gyro.scene
    rounded = {"temperature": scene.warmth} | _reference(gyro)
    known = {
        "supply": lambda: scene.supply,
        "mag": lambda: scene.mag,
        "ref_q": lambda: scene.attitude,
        "latitude": lambda: np.full(len(scene.time), scene.latitude),
        "ref_velocity": lambda: scene.velocity,
    }
    also = {n: make() for n, make in known.items() if n in needs and n not in rounded}
    return {"time": scene.time, **measured, **rounded, **also}


def _reference(gyro: Chain) -> dict[str, np.ndarray]:
    """Rate and force as they are, or attitudes with noise."""
    scene = gyro.scene
    if not gyro.attitude:
        own = {"ref_rate": scene.rate, "ref_force": scene.force}
        return {name: np.round(values, DIGITS) for name, values in own.items()}
    rng = np.random.default_rng([gyro.seed, 11])
    wrong = gyro.attitude * rng.standard_normal((len(scene.time), 3))
    return {"ref_q": rotation.product(scene.attitude, rotation.from_vector(wrong))}
