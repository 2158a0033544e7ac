# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""From spellings to sub-word units: phones of the International Phonetic Alphabet, as espeak-ng reads text aloud."""

from __future__ import annotations

import re
import subprocess
import unicodedata
from collections.abc import Collection

from hri.core.errors import InvalidArgument, IoError

_TIMEOUT_S = 60
_LENGTH, _ASPIRATED, _NASAL = "ː", "ʰ", "\u0303"
_MODIFIERS = {_LENGTH, "ˑ", _ASPIRATED, "ʱ", "ʲ", "ʷ", "ˠ", "ˤ", "˞"}
# Stress, syllables and joins are no units.
_DROPPED = set("ˈˌ.|‖‿-_'\u0361\u200d\u200c")

# From the lips back.
_PLACES = (
    *("p b m f v ɸ β w ʋ", "θ ð", "t d n s z ɾ r l ɹ ɬ", "ʃ ʒ", "ʈ ɖ ɳ ʂ ʐ ɽ ɭ ɻ"),
    *("c ɟ ɲ ç ʝ j ʎ ɕ ʑ", "k ɡ ŋ x ɣ", "q ɢ χ ʁ", "ħ ʕ", "ʔ h ɦ"),
)
_MANNERS = {
    "plosive": "p b t d ʈ ɖ c ɟ k ɡ q ɢ ʔ",
    "nasal": "m n ɳ ɲ ŋ",
    "fricative": "ɸ β f v θ ð s z ʃ ʒ ʂ ʐ ç ʝ ɕ ʑ x ɣ χ ʁ ħ ʕ h ɦ ɬ",
    "approximant": "ʋ w ɹ ɻ j",
    "rhotic": "r ɾ ɽ",
    "lateral": "l ɭ ʎ",
}
_LIQUID = {"approximant", "rhotic", "lateral"}
_VOICELESS = set("pfɸθtsʃʈʂcçɕkxqχħʔhɬ")
# By height, from close; in a row front, central and back.
_VOWELS = ("i y|ɨ ʉ|ɯ u", "ɪ ʏ|ᵻ|ʊ", "e ø|ɘ ɵ|ɤ o", "|ə ɚ|", "ɛ œ|ɜ ɝ ɞ|ʌ ɔ", "æ|ɐ|", "a ɶ||ɑ ɒ")
_ROUNDED = set("yʉuʏʊøɵoœɞɔɶɒ")
_PLACE_OF = {phone: place for place, phones in enumerate(_PLACES) for phone in phones.split()}
_MANNER_OF = {phone: manner for manner, phones in _MANNERS.items() for phone in phones.split()}
_VOWEL_OF = {
    phone: (height, back)
    for height, row in enumerate(_VOWELS)
    for back, phones in enumerate(row.split("|"))
    for phone in phones.split()
}
_OTHER_KIND = 20.0


def pronounce(text: str, language: str = "en") -> tuple[str, ...]:
    """The phones of a word or several, as the program espeak-ng pronounces them.

    Each is one symbol of the International Phonetic Alphabet with its marks of length, aspiration and nasality;
    diphthongs and affricates are two.

    Parameters
    ----------
    text : str
        In the script of the language.
    language : str
        Code of an espeak-ng voice: "en", "hi", "de", ...

    Raises
    ------
    IoError
        When espeak-ng is not installed.
    InvalidArgument
        For a language it does not know, or a text that has no sound.

    Examples
    --------
    >>> pronounce("घर", "hi")
    ('ɡʰ', 'ʌ', 'ɾ')
    """
    command = ["espeak-ng", "-q", "-v", language, "--ipa", "--", text]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=_TIMEOUT_S, check=False)
    except FileNotFoundError as error:
        raise IoError(
            "pronunciations from spellings need the program espeak-ng: install the package espeak-ng "
            "(apt install espeak-ng, dnf install espeak-ng, brew install espeak-ng)"
        ) from error
    except subprocess.TimeoutExpired as error:
        raise IoError(f"espeak-ng did not finish {text!r} in {_TIMEOUT_S} s") from error
    except ValueError as error:  # a null character
        raise InvalidArgument(f"text {text!r} cannot be pronounced: {error}") from error
    if done.returncode != 0:
        said = done.stderr.strip() or f"exit code {done.returncode}"
        raise InvalidArgument(f"espeak-ng refuses language {language!r}: {said}")
    phones = split_phones(done.stdout)
    if not phones:
        raise InvalidArgument(f"text {text!r} has no sound in language {language!r}")
    return phones


def split_phones(transcription: str) -> tuple[str, ...]:
    """The phones of a transcription in the International Phonetic Alphabet; stress is left out."""
    # Names of languages that a word is borrowed from stand in brackets; a retroflex flap may be written with a dot.
    plain = re.sub(r"\([\w-]+\)", "", transcription).replace("r.", "ɽ")
    phones: list[str] = []
    for symbol in unicodedata.normalize("NFD", plain):
        if symbol.isspace() or symbol in _DROPPED:
            continue
        if symbol in _MODIFIERS or unicodedata.combining(symbol):
            if phones:
                phones[-1] += symbol
        else:
            phones.append(symbol)
    # A mark of its own by Unicode, and a phone of its own here.
    return tuple(phone.replace("c\u0327", "ç") for phone in phones)


def closest_phone(phone: str, known: Collection[str]) -> str:
    """Of `known`, the phone that is articulated most alike; `phone` itself where it is among them.

    By place, manner, voice and aspiration of consonants, by height, backness, rounding, length and nasality of vowels.

    Raises
    ------
    InvalidArgument
        Where nothing is known, or nothing of the kind of `phone`: a vowel, a consonant, or neither.
    """
    if phone in known:
        return phone
    best = min(sorted(known), key=lambda other: _distance(phone, other), default=None)
    if best is None or _distance(phone, best) >= _OTHER_KIND:
        raise InvalidArgument(f"no phone is known that is like {phone!r}")
    return best


def _distance(one: str, other: str) -> float:
    marks = sum(weight * ((mark in one) != (mark in other)) for mark, weight in ((_LENGTH, 0.5), (_NASAL, 0.8)))
    a, b = one[:1], other[:1]
    if a in _VOWEL_OF and b in _VOWEL_OF:
        (height, back), (other_height, other_back) = _VOWEL_OF[a], _VOWEL_OF[b]
        rounding = (a in _ROUNDED) != (b in _ROUNDED)
        return marks + 0.7 * abs(height - other_height) + abs(back - other_back) + 0.5 * rounding
    if a in _PLACE_OF and b in _PLACE_OF:
        manner, other_manner = _MANNER_OF[a], _MANNER_OF[b]
        change = 0.0 if manner == other_manner else 1.0 if {manner, other_manner} <= _LIQUID else 2.0
        voice = (a in _VOICELESS) != (b in _VOICELESS)
        breath = any((mark in one) != (mark in other) for mark in (_ASPIRATED, "ʱ"))
        return marks + 0.4 * abs(_PLACE_OF[a] - _PLACE_OF[b]) + change + 1.0 * voice + 0.6 * breath
    return _OTHER_KIND
