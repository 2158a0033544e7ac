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
from hri.core.text import is_printable
from hri.media import picture_size
from hri.serve.limits import ServeLimits

SOUND = 1
PICTURE = 2
COMMANDS = ("hello", "stop", "resume", "imitate", "rest", "teach", "sample", "undo")
_TEACHING = ("teach", "sample", "undo")
_HEADER = struct.Struct("<Bd")
_MAX_SOUND_BYTES = 2 * 48000
_RATES_HZ = (8000, 48000)
_MAX_LABEL = 40


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
        raise FormatError("a message without sound or a picture in it was ignored")
    kind, sent_ms = _HEADER.unpack_from(message)
    data = message[_HEADER.size :]
    if kind not in (SOUND, PICTURE):
        raise FormatError("a message that is neither sound nor a picture was ignored")
    if not math.isfinite(sent_ms):
        raise FormatError("a message whose time is no number was ignored")
    if kind == SOUND:
        if len(data) % 2:
            raise FormatError("sound that is no row of 16-bit samples was ignored")
        if len(data) > _MAX_SOUND_BYTES:
            raise FormatError("sound longer than a second was ignored")
        return Media(kind, sent_ms, data)
    if len(data) > limits.max_picture_bytes:
        raise FormatError(f"a picture of {len(data) // 1024} KB is too large and was ignored")
    size = picture_size(data) if data.startswith(b"\xff\xd8") else None
    if size is None or 0 in size:
        raise FormatError("a picture that is no JPEG was ignored")
    if size[0] * size[1] > limits.max_picture_px:
        raise FormatError(f"a picture of {size[0]} x {size[1]} pixels is too large and was ignored")
    return Media(kind, sent_ms, data)


def read_command(text: str, limits: ServeLimits) -> dict[str, Any]:
    """A command as a JSON object with its "type"; raises FormatError, in words for the page, for anything else."""
    if len(text) > limits.max_text_bytes:
        raise FormatError("a text that is too long was ignored")
    value = parse_json(text, "text from the page")
    if not isinstance(value, dict) or value.get("type") not in COMMANDS:
        raise FormatError("a text that is no command was ignored")
    if value["type"] == "hello":
        rate = value.get("rate", _RATES_HZ[0])
        if not isinstance(rate, int) or isinstance(rate, bool) or not _RATES_HZ[0] <= rate <= _RATES_HZ[1]:
            raise FormatError(f"sound of {rate} samples a second cannot be used")
        if not isinstance(value.get("page", ""), str):
            raise FormatError("a page is named by text")
    if value["type"] in _TEACHING and value.get("mode") not in ("speech", "gesture"):
        raise FormatError("what is added is a word (speech) or a gesture")
    if value["type"] == "teach":
        label = value.get("label")
        if not isinstance(label, str) or not label.strip() or len(label) > _MAX_LABEL or not is_printable(label):
            raise FormatError(f"a name has 1 to {_MAX_LABEL} letters")
        value["label"] = label.strip()
    return value
