# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a page sends: text for commands, binary messages for sound and pictures.

A binary message is one byte (1 sound, 2 picture), the page's time in milliseconds (float64, little endian), and 16-bit
samples (little endian, mono) or a JPEG file.
"""

from __future__ import annotations

import math
import struct
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import FormatError
from hri.core.files import parse_json
from hri.core.phrases import Phrase, phrase
from hri.core.text import is_printable
from hri.media import picture_size
from hri.serve.limits import ServeLimits

SOUND = 1
PICTURE = 2
COMMANDS = ("hello", "stop", "resume", "imitate", "rest", "teach", "sample", "undo", "voice")
_TEACHING = ("teach", "sample", "undo")
_HEADER = struct.Struct("<Bd")
_MAX_SOUND_BYTES = 2 * 48000
_RATES_HZ = (8000, 48000)
_MAX_LABEL = 40


def with_phrases(message: dict[str, Any]) -> dict[str, Any]:
    """A message for the page whose "phrases" say, by field, how its texts are said in another language."""
    found = {name: _encoded(value) for name, value in message.items()}
    found = {name: value for name, value in found.items() if value}
    return message | {"phrases": found} if found else message


def _encoded(value: Any) -> dict[str, Any] | None:
    if isinstance(value, Phrase):
        return value.to_dict() if value.code else None
    if isinstance(value, dict):
        return {name: one.to_dict() for name, one in value.items() if isinstance(one, Phrase)}
    return None


@dataclass(frozen=True)
class Media:
    """Sound or a picture as it came.

    Attributes
    ----------
    kind : int
        SOUND or PICTURE.
    sent_ms : float
        When it was taken, by the page's clock.
    data : bytes
    """

    kind: int
    sent_ms: float
    data: bytes

    def samples(self) -> NDArray[np.float32]:
        """Of sound, in -1..1."""
        return np.frombuffer(self.data, dtype="<i2").astype(np.float32) / np.float32(32768)


def read_media(message: bytes, limits: ServeLimits) -> Media:
    """Raises FormatError, in words for the page, for what is neither sound nor a picture, or too large."""
    if len(message) <= _HEADER.size:
        raise FormatError(phrase("message_empty"))
    kind, sent_ms = _HEADER.unpack_from(message)
    data = message[_HEADER.size :]
    if kind not in (SOUND, PICTURE):
        raise FormatError(phrase("message_unknown"))
    if not math.isfinite(sent_ms):
        raise FormatError(phrase("message_time"))
    if kind == SOUND:
        if len(data) % 2:
            raise FormatError(phrase("sound_odd"))
        if len(data) > _MAX_SOUND_BYTES:
            raise FormatError(phrase("sound_long"))
        return Media(kind, sent_ms, data)
    if len(data) > limits.max_picture_bytes:
        raise FormatError(phrase("picture_heavy", kb=len(data) // 1024))
    size = picture_size(data) if data.startswith(b"\xff\xd8") else None
    if size is None or 0 in size:
        raise FormatError(phrase("picture_no_jpeg"))
    if size[0] * size[1] > limits.max_picture_px:
        raise FormatError(phrase("picture_large", width=size[0], height=size[1]))
    return Media(kind, sent_ms, data)


def read_command(text: str, limits: ServeLimits) -> dict[str, Any]:
    """A command as a JSON object with its "type"; raises FormatError, in words for the page, for anything else."""
    if len(text) > limits.max_text_bytes:
        raise FormatError(phrase("text_long"))
    value = parse_json(text, "text from the page")
    if not isinstance(value, dict) or value.get("type") not in COMMANDS:
        raise FormatError(phrase("text_no_command"))
    if value["type"] == "hello":
        rate = value.get("rate", _RATES_HZ[0])
        if not isinstance(rate, int) or isinstance(rate, bool) or not _RATES_HZ[0] <= rate <= _RATES_HZ[1]:
            raise FormatError(phrase("rate_unusable", rate=rate))
        if not isinstance(value.get("page", ""), str):
            raise FormatError(phrase("page_name"))
    if value["type"] == "voice" and not isinstance(value.get("text"), str):
        raise FormatError(phrase("text_no_command"))
    if value["type"] in _TEACHING and value.get("mode") not in ("speech", "gesture"):
        raise FormatError(phrase("mode_unknown"))
    if value["type"] == "teach":
        label = value.get("label")
        if not isinstance(label, str) or not label.strip() or len(label) > _MAX_LABEL or not is_printable(label):
            raise FormatError(phrase("name_length", most=_MAX_LABEL))
        value["label"] = label.strip()
    return value
