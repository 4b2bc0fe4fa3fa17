"""The bits of an attitude filter's output ``status``."""

STATUS = {
    1: (
        "an input was not finite or absurd and its last good value was held, or a heading's "
        "variance was not above zero"
    ),
    2: "a sample was at a sensor's limit, or said of more than half a turn in a sample period",
    4: "a sensor or an axis is stuck, its samples have not changed for its stuck time",
    8: "gravity contradicted the attitude, and was weighed less",
    16: "a heading was older than heading_memory, or than the run, and not used",
    32: (
        "a heading was not used, as the tilt was contradicted or not known, or as more is known "
        "already than when it was true"
    ),
    64: "a heading contradicted the attitude, and was weighed less",
    128: "a variance was not above zero, and its std is shown as 0",
    256: (
        "the magnetic field was not the place's in strength or dip, and not used, or its direction "
        "contradicted the heading"
    ),
    512: (
        "the force has not had the size of gravity for 10 s, or has another one at rest than "
        "gravity_tolerance allows: it is taken as it is found, and std has what that means for the "
        "tilt"
    ),
}
"""Bits of the output ``status`` and what each says; 0 is well."""

STATUS_NAMES = {
    1: "input missing",
    2: "at a limit",
    4: "stuck",
    8: "gravity contradicted",
    16: "heading too old",
    32: "heading not used",
    64: "heading contradicted",
    128: "variance lost",
    256: "field disturbed",
    512: "gravity of another size",
}
"""The same bits in two or three words, for pictures."""
