# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The voice of commands that speak: espeak-ng, into files or through the loudspeaker."""

from __future__ import annotations

from hri.core.errors import InvalidArgument
from hri.core.text import is_printable
from hri.live import Loudspeaker
from hri.media import Audio
from hri.synthetic.speech import Speaker, speak

_VOICE = Speaker("voice", variant="f2", accent=0, pitch=50, rate=155, noise_db=-96.0)
_TRIED = "1"


class SpokenText:
    """Says texts in a language through the loudspeaker.

    Parameters
    ----------
    language : str
        Of the voice, as espeak-ng names it.

    Raises
    ------
    ImportError
        Without sounddevice.
    IoError
        Without espeak-ng, and without a loudspeaker.
    InvalidArgument
        For a language that espeak-ng does not know.
    """

    def __init__(self, language: str) -> None:
        spoken(_TRIED, language)  # refuses what is missing now
        self._language = language
        self._loudspeaker = Loudspeaker()

    def say(self, text: str) -> None:
        """Say a text, and return when it has been said; errors as of `spoken` and `Loudspeaker.play`."""
        audio = spoken(text, self._language)
        self._loudspeaker.play(audio.samples, audio.sample_rate_hz)

    def close(self) -> None:
        """Say nothing more."""
        self._loudspeaker.close()


def spoken(text: str, language: str) -> Audio:
    """A text as speech; errors as of `hri.synthetic.speech.speak`, and for control characters."""
    if not is_printable(text):
        raise InvalidArgument(f"{text!r} cannot be spoken: it holds control characters")
    return speak(text, language, _VOICE)
