# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Recordings that training of words finds no speech in, named before they are left out."""

from __future__ import annotations

import logging
from collections.abc import Sequence

from hri import _native
from hri.core.display import count
from hri.core.errors import InvalidArgument
from hri.media import Audio

_log = logging.getLogger(__name__)

_MOST_NAMED = 10
_DEFAULT_RATE_HZ = 16000
"""Of models whose options leave the rate to the recordings: the lowest of these, and no higher one."""


def warn_of_silence(clips: Sequence[Audio], options: _native.WordRecognizerOptions) -> None:
    """Name the recordings in which training will find no speech, as a warning of the log.

    Parameters
    ----------
    clips : sequence of Audio
        All that is trained on. Those without a file are named by their place, as in ``X[3]``.
    options : WordRecognizerOptions
        Of training.
    """
    rate_hz = options.cepstra.sample_rate_hz or min([_DEFAULT_RATE_HZ, *(clip.sample_rate_hz for clip in clips)])
    silent = [
        f"X[{number}]" if clip.path is None else str(clip.path)
        for number, clip in enumerate(clips)
        if _is_silent(clip, rate_hz, options)
    ]
    if silent:
        names = list(dict.fromkeys(silent))  # of a recording and its copies
        more = f" and {len(names) - _MOST_NAMED} more" if len(names) > _MOST_NAMED else ""
        which = "is" if len(silent) == 1 else "are"
        named = " ".join(names[:_MOST_NAMED])
        number = count(len(silent), "recording")
        _log.warning("no speech is found in %s, which %s not learned from: %s%s", number, which, named, more)


def _is_silent(clip: Audio, rate_hz: int, options: _native.WordRecognizerOptions) -> bool:
    samples = clip.samples
    try:
        if clip.sample_rate_hz != rate_hz:
            samples = _native.resample(samples, clip.sample_rate_hz, rate_hz)
        return _native.find_speech(samples, rate_hz, options.activity) is None
    except InvalidArgument:  # too short, or a rate that is none: training says so
        return False
