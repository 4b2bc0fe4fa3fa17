"""Close the loop.

Recordings in; out what the model lacks, named and added, and the error before and after.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from importlib.resources import files
from pathlib import Path

import numpy as np

from pyimu.display.silent import silent
from pyimu.errors import Finding, UserError
from pyimu.identification.conclude import conclude, weightless
from pyimu.identification.fit.keys import Key
from pyimu.identification.fit.trial import Trial
from pyimu.identification.fit.trials import accel_trial, gyro_trial
from pyimu.identification.formula.constancy import less_inconstant
from pyimu.identification.formula.effect import forget
from pyimu.identification.formula.memory import less_than_memory, remembered
from pyimu.identification.formula.search import Look, look
from pyimu.identification.found.made_with import called
from pyimu.identification.logs.findings import about, joined_with, of_trials
from pyimu.identification.logs.given import logs_of, nothing_to_compare, references_of
from pyimu.identification.logs.thermometer import late_thermometers
from pyimu.identification.logs.trials import Together, aligned_trials, clocks_of, prepared
from pyimu.identification.logs.vibration import lines, vibrations
from pyimu.identification.model.left_to_data import left_to_data, prior_of_structure, shown
from pyimu.identification.reference.align import in_band_of
from pyimu.identification.reference.belongs import misfit
from pyimu.identification.reference.gravity import rest_trials
from pyimu.identification.reference.mirrored import mirrored
from pyimu.identification.reference.of_itself import made_of_it, rate_made_of_it
from pyimu.identification.reference.place import is_differentiated
from pyimu.identification.reference.same_output import own_output
from pyimu.identification.reference.told import told
from pyimu.identification.reference.turned import with_rest_of_turn, with_turned_force
from pyimu.identification.reference.turns import turn_trials
from pyimu.identification.reference.unfiltered import (
    unfiltered_logs,
    unplayed_logs,
    with_sharp_places,
)
from pyimu.identification.reference.upright import with_upright_places
from pyimu.identification.result import Closed
from pyimu.identification.rivals.clock_or_effect import likelier_clock, on_their_clocks
from pyimu.identification.rivals.gain_or_scale import (
    held_shares,
    let_go,
    names_gain,
    with_scale_held,
)
from pyimu.identification.rivals.instead import (
    formula_less_than_noise,
    less_than_noise,
    less_than_rounding,
)
from pyimu.identification.search.ceiling import CEILING
from pyimu.identification.search.forward import investigate
from pyimu.identification.search.investigation import Investigation
from pyimu.model.part import Part
from pyimu.model.part_file import part as find_part
from pyimu.model.part_file import part_names
from pyimu.model.part_reader import parse_part
from pyimu.model.sensor import Sensor
from pyimu.numerics.threads import on_one_thread
from pyimu.recording.log import Given
from pyimu.recording.quality.false_force import check_force
from pyimu.recording.quality.gyro_axes import gyro_axes
from pyimu.recording.quality.inspect import beyond_range, inspect, of_reading, rate_of_part
from pyimu.recording.recording import Recording
from pyimu.recording.reference.held import held_apart

Say = Callable[[str], None]


@on_one_thread
def close(
    recordings: Sequence[Given] | Given,
    part: Part | str | Path | None = None,
    holdout: Sequence[Given] | Given | None = None,
    *,
    reference: Sequence[Given] | Given | None = None,
    latitude: float | None = None,
    say: Say = silent,
) -> Closed:
    """Find what a sensor's model lacks to explain measured logs, and what it is worth.

    ``recordings`` are Recordings, paths or data frames; ``part`` is a Part, the name of a built-in
    one, a TOML path, or None for the baseline structure with every coefficient estimated. Without
    ``holdout`` 30 % of each log are held out, the last of it where these do not have nearly all
    that an axis is turned by. ``reference`` are references in recordings, files or data frames of
    their own, at their own rate and on their own clock: one for each log in order, then one for
    each log of ``holdout``; a log without one has its own. ``latitude`` [rad] adds the Earth's rate
    to a reference rate derived from an attitude. Raises UserError for logs that cannot be read, are
    too short, do not overlap their reference, or do not excite what the part asks to be estimated.
    """
    own = references_of(reference)
    logs, others = logs_of(recordings, holdout, own)
    made_with = called(
        "close",
        {
            "recordings": [r.path or r.name for r in logs],
            "part": part,
            "holdout": [r.path or r.name for r in others] or None,
            "reference": [r.path or r.name for r in own] or None,
            "latitude": latitude,
        },
        [*(r.path for r in (*logs, *others, *own)), *_file_of(part)],
    )
    declared = None if part is None else find_part(part)
    start = declared or undeclared(logs[0].sample_rate)
    say("quality of the raw samples")
    quality = _quality([*logs, *others], declared)
    forget()
    left_out = weightless(quality)
    logs, others = (
        [replace(r, accel=None) if r.name in left_out else r for r in some]
        for some in (logs, others)
    )
    logs, others, turning = _on_time(start.gyro, logs, others, latitude)
    found, looks, more = _investigated(
        start, declared is not None, logs, others, latitude, say, turning, quality
    )
    quality = joined_with(quality, more)
    if not found:
        raise UserError(nothing_to_compare(logs))
    return conclude(start, declared, logs, others, found, tuple(quality), say, made_with, looks)


def _quality(logs: list[Recording], declared: Part | None) -> list[Finding]:
    """What the raw samples show, of each log; raises UserError for forces in another unit."""
    for r in logs:
        if r.accel is not None:
            check_force(r)
    found: list[Finding] = []
    for r in logs:
        seen = [*of_reading(r), *inspect(r), *gyro_axes(r), *vibrations(r), *lines(r)]
        if declared is not None:
            seen += [*rate_of_part(r, declared.sample_rate), *beyond_range(r, _ranges(declared))]
        found += [about(r.name, f) for f in seen]
    return found


def _on_time(
    sensor: Sensor, logs: list[Recording], others: list[Recording], latitude: float | None
) -> tuple[list[Recording], list[Recording], Together]:
    """The logs with references behind the play of gears, that do not lag and are not smoothed, at
    samples of their own where rows hold these, and the gyro's trials of them.
    """
    logs, others = list(map(held_apart, logs)), list(map(held_apart, others))
    made = partial(aligned_trials, sensor, gyro_trial, latitude=latitude)
    turning = made(logs, others)
    for undone in (unplayed_logs, partial(unfiltered_logs, sensor=sensor, made=made)):
        found = undone(turning, (logs, others))
        if found is not None:
            logs, others = found
            turning = made(logs, others)
    clocks, both = clocks_of(turning), [*turning[0], *turning[1]]
    placed = (
        [with_sharp_places(with_upright_places(r, both), clocks, latitude) for r in some]
        for some in (logs, others)
    )
    return *placed, turning


def _investigated(
    start: Part,
    declared: bool,
    logs: list[Recording],
    others: list[Recording],
    latitude: float | None,
    say: Say,
    turning: Together,
    axes: Sequence[Finding],
) -> tuple[dict[str, Investigation], dict[str, Look], list[Finding]]:
    """What was found of each sensor that has a reference, and what making its trials found;
    ``turning`` are the gyro's, ``axes`` the findings that may say something against its axes.
    """
    found: dict[str, Investigation] = {}
    looks: dict[str, Look] = {}
    quality: list[Finding] = []
    gyros = [*turning[0], *turning[1]]
    own = told(gyros) or made_of_it(gyros, [*logs, *others]) or mirrored(gyros, axes)
    for kind, make in (("accel", accel_trial), ("gyro", gyro_trial)):
        known, given = {}, (logs, others)
        if kind == "accel":
            known = clocks_of(turning)
            given = tuple([with_turned_force(r, gyros) for r in some] for some in given)
            were = {id(r) for r in (*logs, *others)}
            make = with_rest_of_turn(
                make, {r.name for some in given for r in some if id(r) not in were}
            )
        made = partial(aligned_trials, start.sensor(kind), make, *given, latitude, known=known)
        trials, held = prepared(*(turning if kind == "gyro" else made()), bool(others))
        if kind == "accel" and not any(map(is_differentiated, trials)):
            at_rest = rest_trials(start.accel, logs, others, latitude)
            trials, held = at_rest or (trials, held)
        elif not trials:
            turned = turn_trials(start.gyro, logs, others, found.get("accel"))
            trials, held = turned or (trials, held)
        if trials:
            by_attitude = kind == "gyro" or any(map(is_differentiated, trials))
            rate = rate_made_of_it([*trials, *held]) if kind == "gyro" else ""
            unfit = (own if by_attitude else "") or own_output([*logs, *others], kind) or rate
            examine = partial(_examined, start, declared, say, unfit)
            remade = partial(_remade, examine, made, bool(others))
            looks[kind] = likelier_clock(
                examine(trials, held), partial(remade, [*trials, *held], lines=False)
            )
            looks[kind] = on_their_clocks(looks[kind], partial(remade, may_be_late=False))
            found[kind] = looks[kind].investigation
            trials, held = list(found[kind].before.trials), list(found[kind].held)
            quality += late_thermometers(found[kind])
        quality += of_trials([*trials, *held])
    return {k: found[k] for k in ("gyro", "accel") if k in found}, looks, quality


def _remade(
    examine: Callable[..., Look],
    made: Callable[..., Together],
    others: bool,
    in_bands_of: Sequence[Trial] = (),
    **differently: bool,
) -> Look:
    """What is found in trials that are ``made`` anew, in the bands of others of the same logs."""
    return examine(*_in_bands_of(in_bands_of, prepared(*made(**differently), others)))


def _in_bands_of(
    trials: Sequence[Trial], others: tuple[list[Trial], list[Trial]]
) -> tuple[list[Trial], list[Trial]]:
    """The ``others``, fitted and held, each in the band of the trial of the same log."""
    by_name = {t.name: t for t in trials}
    fitted, held = ([in_band_of(by_name.get(t.name, t), t) for t in some] for some in others)
    return fitted, held


def _examined(
    start: Part,
    declared: bool,
    say: Say,
    own: str,
    trials: list[Trial],
    held: list[Trial],
) -> Look:
    """What was found of one sensor in its trials; ``own`` says why their reference was computed
    from it, if it was.
    """
    kind = trials[0].kind
    free = left_to_data(start, declared, start.sensor(kind), trials)
    trials = shown(start, declared, free, trials)
    prior = prior_of_structure(start.sensor(kind), free)
    unfit = own or misfit(trials)
    again = partial(investigate, start.sensor(kind), free, say=say, prior=prior, unfit=unfit)
    looked = partial(_looked, prior=prior, random=_random(start, kind), say=say)
    shares = {} if unfit else held_shares(start.sensor(kind), free, trials)
    if shares:
        known = ([with_scale_held(t, shares) for t in some] for some in (trials, held))
        found = looked(again(*known))
        if names_gain(found.investigation):
            return replace(found, investigation=let_go(found.investigation, shares))
        if found.formula is not None:
            forget()
    return looked(again(trials, held))


def _looked(
    inv: Investigation, prior: Mapping[Key, float], random: frozenset[str], say: Say
) -> Look:
    """What was made of what an investigation left, less what noise would explain as well; the
    kinds ``random`` of noise are left to the data.
    """
    if inv.unfit:
        return Look(inv)
    say(f"{inv.after.sensor.kind}: is what was found noise")
    inv = less_than_rounding(less_than_noise(inv, random))
    found = look(inv, partial(_again, inv, prior), say)
    if formula_less_than_noise(inv, found, random):
        found = Look(inv)
    if inv.after.is_reduced:
        return found
    if found.formula is not None:
        constant = less_inconstant(found.investigation, found.formula.name)
        memory = None
    else:
        constant = less_inconstant(less_than_memory(found.investigation))
        memory = remembered(constant.investigation.after)
    left, inconstant = constant.investigation, constant.unexplained
    return replace(found, investigation=left, memory=memory, inconstant=inconstant)


def _random(start: Part, kind: str) -> frozenset[str]:
    """The kinds of noise that a part leaves to the data."""
    return frozenset(e for k, e, _ in start.estimate if k == kind)


def _again(
    inv: Investigation,
    prior: Mapping[Key, float],
    sensor: Sensor,
    free: frozenset[Key],
    believed: bool = False,
    lags: bool = True,
) -> Investigation:
    """The investigation once more, with a formula in the model from the start, or the noise of the
    reference ``believed``; ``lags`` as of ``investigate``.
    """
    trials, held = list(inv.before.trials), list(inv.held)
    believed = believed or inv.believed
    return investigate(sensor, free, trials, held, prior=prior, believed=believed, lags=lags)


def _file_of(part: Part | str | Path | None) -> list[Path]:
    """The file that a part is read from, where it is one."""
    return [Path(part)] if isinstance(part, (str, Path)) and part not in part_names() else []


def _ranges(part: Part) -> dict[str, np.ndarray]:
    """The input range (3,) of each sensor that a part declares, in SI."""
    found = {kind: part.sensor(kind).reading(CEILING) for kind in ("gyro", "accel")}
    return {
        kind: np.broadcast_to(part.sensor(kind).values[at[0]][at[1]], 3)
        for kind, at in found.items()
        if at is not None
    }


def undeclared(sample_rate: float) -> Part:
    """The model of a part that nobody declared: every coefficient is left to the data."""
    text = files("pyimu.identification").joinpath("undeclared.toml").read_text(encoding="utf-8")
    return replace(parse_part(text, "undeclared.toml"), sample_rate=sample_rate, notes={})


# The logs


# Trials, and what is free in them
