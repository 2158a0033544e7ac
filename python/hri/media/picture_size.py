# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""How large a picture says it is, before memory and time are spent on it."""

from __future__ import annotations

import struct

_PNG = b"\x89PNG\r\n\x1a\n"
_NO_LENGTH = {0x01, *range(0xD0, 0xD9)}  # JPEG's markers without a segment
_FRAMES = {*range(0xC0, 0xD0)} - {0xC4, 0xC8, 0xCC}  # those that begin a frame and hold its size


def is_picture(data: bytes) -> bool:
    """Whether the data begin as a PNG, JPEG or BMP file does."""
    return data.startswith((_PNG, b"\xff\xd8", b"BM"))


def picture_size(data: bytes) -> tuple[int, int] | None:
    """Width and height in the header of a PNG, JPEG or BMP file; None for others, and where it is damaged."""
    try:
        if data.startswith(_PNG):
            width, height = struct.unpack_from(">II", data, 16)
            return width, height
        if data.startswith(b"\xff\xd8"):
            return _jpeg_size(data)
        if data.startswith(b"BM"):
            old = struct.unpack_from("<I", data, 14)[0] == 12
            width, height = struct.unpack_from("<HH" if old else "<ii", data, 18)
            return abs(width), abs(height)  # a negative height: the first row is the upper one
    except struct.error:  # the file ends within the header
        pass
    return None


def is_cut(data: bytes) -> bool:
    """Whether a PNG file ends before its chunks do; OpenCV takes memory for what a chunk claims, up to 4 GB."""
    if not data.startswith(_PNG):
        return False
    at = len(_PNG)
    while at + 12 <= len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        if kind == b"IEND":
            return False
        at += 12 + length
    return True


def _jpeg_size(data: bytes) -> tuple[int, int] | None:
    at = 2
    while True:
        at = data.find(b"\xff", at)
        if at < 0 or at + 1 >= len(data):
            return None
        marker = data[at + 1]
        if marker == 0xFF:  # filling
            at += 1
        elif marker in _NO_LENGTH or marker == 0:
            at += 2
        elif marker in _FRAMES:
            height, width = struct.unpack_from(">HH", data, at + 5)
            return width, height
        elif marker == 0xDA:  # the picture itself begins, and no size was given
            return None
        else:
            at += 2 + int(struct.unpack_from(">H", data, at + 2)[0])
