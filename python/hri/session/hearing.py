# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What listens to the sound of a session, and when a spoken STOP counts before the end of the word is certain."""

from __future__ import annotations

from hri.live import Listener
from hri.live.listener import endpointer_of
from hri.recognition import CommandRecognizer, Decision, WordRecognizer
from hri.session.options import SessionOptions
from hri.session.pairing import Pairer
from hri.signal import EndpointerOptions

STOP_PAUSE_MS = 150.0
"""Quiet after which a word that is heard so far may be STOP.

As long as a robot that halts 150 ms after the word's end allows, as some of this quiet belongs to the word: after
shorter ones the beginnings of more other words are STOP.
"""


def pausing_endpointer_of(words: WordRecognizer | CommandRecognizer) -> EndpointerOptions:
    """When an utterance begins, pauses and ends, unless a caller says it."""
    options = endpointer_of(words)
    options.pause_ms = STOP_PAUSE_MS
    return options


def listener_of(
    words: WordRecognizer | CommandRecognizer,
    endpointer: EndpointerOptions | None,
    options: SessionOptions,
    model_id: str,
) -> Listener:
    """What listens for words, or for commands of several."""
    pairer = Pairer(options)

    def sure(decision: Decision) -> bool:
        # What would only be asked about while the robot rests may be surer at the end of the word.
        return pairer.is_sure_stop(decision) and decision.confidence >= options.stop_at_rest

    stops = options.fusion.stop_labels
    return Listener(words, endpointer, model_id=model_id, urgent=stops, sure=sure)
