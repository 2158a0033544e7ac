# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What watches the pictures of a session: single gestures, or sentences of signs."""

from __future__ import annotations

from collections.abc import Callable

from hri.core.errors import InvalidArgument
from hri.live import FrameResult, HandFrames, PersonTracks, SignWatcher, Watcher
from hri.recognition import (
    Decision,
    GestureRecognizer,
    GestureSegmenterOptions,
    SentenceRecognizer,
    SentenceStreamOptions,
)
from hri.vision.persons import Faces

OnResult = Callable[[FrameResult, Decision | None], None]


def watcher_of(
    signs: GestureRecognizer | SentenceRecognizer,
    segmenter: GestureSegmenterOptions | SentenceStreamOptions | None,
    hands: HandFrames | None,
    faces: Faces | None,
    model_id: str,
    on_result: OnResult | None = None,
) -> Watcher | SignWatcher:
    """What watches for gestures, or for signed sentences. Raises InvalidArgument for what belongs to the other."""
    if isinstance(signs, SentenceRecognizer):
        if isinstance(segmenter, GestureSegmenterOptions):
            raise InvalidArgument("segmenter: signed sentences need SentenceStreamOptions")
        if hands is None and faces is not None and signs.options.input == "tracks":
            hands = PersonTracks(faces)
        return SignWatcher(signs, segmenter, hands=hands, model_id=model_id, on_result=on_result)
    if isinstance(segmenter, SentenceStreamOptions) or hands is not None:
        raise InvalidArgument("SentenceStreamOptions and hands are for a SentenceRecognizer")
    return Watcher(signs, segmenter, model_id=model_id, on_result=on_result)
