"""The words of the package's pages: each defined once, and listed on the pages that use it."""

from __future__ import annotations

import re
from typing import NamedTuple

from markupsafe import Markup

NOT_WORDS = re.compile(r"<(svg|script|style)\b.*?</\1>|<!--.*?-->|<[^>]*>", re.DOTALL)
"""What of a page nobody reads as a sentence: pictures, programs, tags."""


class Word(NamedTuple):
    """A word, what it means in plain English (may hold markup), and the pattern that finds it."""

    name: str
    meaning: str
    found: str


WORDS = (
    Word(
        "residual",
        "What the sensor measured less what the model makes of the reference's motion.",
        r"\bresiduals?\b",
    ),
    Word(
        "held out",
        "Rows, or whole logs, that no fit has seen. Errors before and after are those on them.",
        r"\bheld[ -]out\b",
    ),
    Word(
        "floor",
        "What the noise of sensor and reference alone would leave of the same number; drift apart.",
        r"\bfloor\b",
    ),
    Word(
        "gain, nat",
        "By how much the logarithm of the probability of the rows grows with what is put in: "
        "ten nat make them e<sup>10</sup>, 22,000 times, as probable.",
        r"\bnat\b",
    ),
    Word(
        "gate",
        "The gain that noise without any effect reaches once in a hundred times, of all the "
        "candidates that were tried.",
        r"\bgate\b",
    ),
    Word(
        "alternative",
        "Another effect that explains these logs as well: they do not tell which of them it is.",
        r"\balternative\b",
    ),
    Word(
        "explained",
        "Above the gate at first, and no more once another effect was in the model.",
        r"\bgate\b.*\bexplained\b|\bexplained\b.*\bgate\b",
    ),
    Word(
        "not shown",
        "These logs say nothing of the coefficient, or less than is known of any part beforehand.",
        r"\bnot shown\b",
    ),
    Word(
        "standard error",
        "By how much an estimate would scatter if the log were taken again; two of them to either "
        "side hold the true value in 95 of a hundred.",
        r"\bstandard errors?\b",
    ),
    Word(
        "interval, bound",
        "Where the true value lies with the probability that is named, 95 % where none is, if the "
        "model is right; “&lt;” is the largest that the data allow of what they do not need.",
        r"\bintervals?\b|\bbound\b",
    ),
    Word(
        "Allan deviation",
        "How far the means of successive stretches of the log lie apart, by the length of a "
        "stretch (the cluster time τ). Each kind of noise has a slope of its own on it.",
        r"\bAllan\b",
    ),
    Word(
        "N, angle or velocity random walk",
        "White noise, the slope -1/2 of an Allan deviation: an angle made of it is off by N √t "
        "after the time t. It is the root of the two-sided density; data sheets print a noise "
        "density one-sided, √2 N.",
        r"\bangle.random.walk\b|\bvelocity random walk\b",
    ),
    Word(
        "B, bias instability",
        "Noise whose density is 1/f: the flat part of an Allan deviation, at 0.664 B. Data sheets "
        "print the lowest Allan deviation under this name.",
        r"\bbias.instability\b",
    ),
    Word(
        "K, rate or acceleration random walk",
        "A bias that wanders, the slope +1/2 of an Allan deviation: it is off by K √t after the "
        "time t.",
        r"\brate.random.walk\b|\bacceleration random walk\b",
    ),
    Word(
        "Q, quantization",
        "Rounding of the angle or the velocity: the slope -1 of an Allan deviation.",
        r"\b(angle|velocity).quantization\b",
    ),
    Word(
        "R, ramp",
        "A bias that grows in a straight line in this log: the slope +1 of an Allan deviation.",
        r"\b(rate|acceleration).ramp\b",
    ),
    Word(
        "G, H, Gauss-Markov noise",
        "A bias that wanders, but not without end: what it was is forgotten after the correlation "
        "time. The Allan deviation has a bump there, at 1.9 correlation times, of 0.62 standard "
        "deviations, and falls again.",
        r"\bgauss.markov\b",
    ),
    Word(
        "standard deviation, ±2σ",
        "How unsure an estimate says it is: the true value lies within two to either side in 95 of "
        "a hundred, if what is assumed holds.",
        r"\bstandard deviations?\b|\bstd\b|2σ",
    ),
    Word(
        "RMS",
        "Root mean square: the size of an error over a log, its mean and its scatter together.",
        r"\bRMS\b|\broot mean square\b",
    ),
    Word(
        "inclination, heading, total error",
        "The angle between true and estimated vertical; between true and estimated direction about "
        "it; and that of the one turn that would set both right.",
        r"\binclination\b",
    ),
    Word(
        "body axes, east-north-up",
        "The sensor's x forward, y left, z up; the world's x east, y north, z up. Yaw and heading "
        "count counter-clockwise from east, and nose up is negative pitch.",
        r"\beast-north-up\b|\bbody to world\b|\bforward-left-up\b",
    ),
    Word(
        "gyro bias",
        "What the gyro shows while nothing turns.",
        r"\bgyro bias\b",
    ),
    Word(
        "quasi-static",
        "So little in motion that the accelerometer shows gravity, and with it the vertical.",
        r"\bquasi-static\b",
    ),
    Word(
        "NIS, normalised innovation squared",
        "How far a measurement was from what was expected, over how far it should be: on average "
        "the number of its components (3 of a vector) where the filter is as good as it says.",
        r"\bNIS\b|\bnormalised innovations?\b",
    ),
    Word(
        "NEES, normalised error squared",
        "The squared error over the variance that the filter claims: on average the number of its "
        "components where the filter is as good as it says, more where it is worse.",
        r"\bNEES\b|\bnormalised errors?\b",
    ),
    Word(
        "smoothed",
        "Estimated from all of the log, what follows the sample included; a filter knows only "
        "what came before.",
        r"\bsmooth(ed|er)\b",
    ),
    Word(
        "zero-velocity update",
        "While the body stands still its velocity is known to be nought, and its gyro shows its "
        "bias: what had crept in since the last stop is seen, and taken back.",
        r"\bzero[ -]velocit(y|ies)\b",
    ),
    Word(
        "vehicle's constraint",
        "Wheels do not slip sideways and do not leave the ground: two components of the velocity "
        "are nought all along the drive.",
        r"\bvehicle's constraint\b",
    ),
    Word(
        "specimen",
        "One sensor of a production: its coefficients drawn within the part's tolerances.",
        r"\bspecimens?\b",
    ),
    Word(
        "first-order index",
        "Which share of the variance of a result one parameter makes by itself.",
        r"\bfirst-order (index|indices)\b",
    ),
    Word(
        "at rest",
        "The mean of no second lies off that of the next by more than noise and drift make it, and "
        "none far off them all.",
        r"\bat rest\b|\brests\b",
    ),
    Word(
        "column map",
        "A file that says what the columns of a log are, in which units and axes. The other "
        "commands take it as --columns.",
        r"\b[Cc]olumn map\b",
    ),
    Word(
        "clipping, stuck, spikes",
        "Samples that stop at a level because the sensor reads no further; that repeat one value; "
        "that stand alone, far from their neighbours.",
        r"\bclipping\b|\bstuck\b|\bspikes?\b",
    ),
)


def words_on(body: str) -> list[tuple[str, Markup]]:
    """The words that a page's ``body`` uses, each with its meaning, in the order of ``WORDS``."""
    text = NOT_WORDS.sub(" ", body)
    return [
        (w.name, Markup(w.meaning))
        for w in WORDS
        if re.search(w.found, text, re.IGNORECASE | re.DOTALL)
    ]
