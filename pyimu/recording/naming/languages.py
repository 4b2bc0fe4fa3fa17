"""Words for quantities in the headers of other languages, as the English ones that are looked for.

Spreadsheets and sensors' own programs write headers in the language of their user; those without a
mark are in its code, which such a word tells.
"""

from __future__ import annotations

import re
import unicodedata

WORDS = {
    "accel": (
        *("beschleunigung", "beschleunigungssensor", "aceleracion", "acelerometro"),
        *("accelerazione", "accelerometro", "accelerometre", "aceleracao", "versnelling"),
        *("przyspieszenie", "ускорение", "акселерометр", "加速度", "가속도"),
    ),
    "gyro": (
        *("drehrate", "drehgeschwindigkeit", "winkelgeschwindigkeit", "gyroskop", "giroscopio"),
        *("vitesse angulaire", "velocidad angular", "velocita angolare", "velocidade angular"),
        *("hoeksnelheid", "predkosc katowa", "zyroskop", "угловая скорость", "гироскоп"),
        *("角速度", "陀螺仪", "陀螺", "ジャイロ", "각속도", "자이로"),
    ),
    "mag": (
        *("magnetfeld", "champ magnetique", "campo magnetico", "magnetometro", "magnetometre"),
        *("magnetisch veld", "магнитометр", "磁场", "磁場", "地磁", "磁気", "지자기"),
    ),
    "time": (
        *("zeit", "zeitstempel", "temps", "horodatage", "tiempo", "tempo", "tijd", "czas", "время"),
        *("时间", "時間", "时刻", "時刻", "시간"),
    ),
    "temperature": ("temperatur", "temperatura", "температура", "温度", "溫度", "온도"),
    "linear": ("lineare", "lineaire", "lineal", "线性", "線形"),
    "gravity": ("gravitation", "gravite", "gravedad", "gravita", "重力"),
    "alpha": ("winkelbeschleunigung", "角加速度", "각가속도"),
}
"""Without accents, in lower case, by what is meant: ``alpha`` is an angular acceleration."""

_MEANT = {word: meant for meant, words in WORDS.items() for word in words}

_LONGEST = sorted(_MEANT, key=lambda word: -len(word))

_LETTER = r"[^\W\d_]"

_BEFORE = {"temps": r"\A"}
"""What must stand before a word: ``imu temps`` are temperatures."""

_FOUND = re.compile(
    "|".join(
        # Words of letters stand alone or before an axis, those of signs run into what is there.
        rf"{_BEFORE.get(word, '')}(?<!{_LETTER}){word}(?=[xyz]?(?!{_LETTER}))"
        if word < "\u0500"
        else word
        for word in _LONGEST
    ),
    re.I,
)

CODES = {"gb2312": "GB 2312", "shift_jis": "Shift-JIS", "euc_kr": "EUC-KR", "big5": "Big5"} | {
    "cp1251": "Windows-1251"
}
"""Codes in which text is written that is in none for all languages, and what they are called."""


def in_english(text: str) -> str:
    """``text`` without accents, its words for quantities in English: ``Accélération x``,
    ``角速度X``.
    """
    plain = _without_accents(text)
    return _FOUND.sub(lambda found: f" {_MEANT[found[0].casefold()]} ", plain)


def code_by_words(text: bytes) -> str | None:
    """The code in which a line has a word for a quantity, None where it has none in any.

    A line of ASCII has none, and is in every code.
    """
    if text.isascii():
        return None
    for code in CODES:
        try:
            said = text.decode(code)
        except UnicodeDecodeError:
            continue
        there = _FOUND.findall(said)
        if any(not word.isascii() for word in there):
            return code
    return None


def _without_accents(text: str) -> str:
    """Letters of Latin scripts without their accents, every other sign as it is."""
    if text.isascii():
        return text
    return "".join(
        unicodedata.normalize("NFD", c)[0] if unicodedata.name(c, "").startswith("LATIN") else c
        for c in text
    )
