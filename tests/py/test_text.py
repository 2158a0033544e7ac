# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Names of words and gestures in any script: joiners belong to them, control characters do not."""

from __future__ import annotations

from pathlib import Path

import pytest

from hri.core.errors import InvalidArgument
from hri.core.text import is_printable
from hri.live.takes import Takes


@pytest.mark.parametrize(
    "name", ["", "stop", "two words", "नमस्ते", "क्\u200dष", "नमस्\u200c", "അവന്\u200d", "می\u200cخواهم"]
)
def test_joiners_belong_in_words(name: str, tmp_path: Path) -> None:
    assert is_printable(name)
    if name:
        Takes(tmp_path, [name], "p1", 1, "gesture", "{label}/{person}_{take}.avi")


@pytest.mark.parametrize(
    "name",
    [
        "\u200d",
        "\u200cstop",
        "stop\u200d",
        "a \u200db",
        "a\u200d\u200db",
        "a\u202eb",
        "a\nb",
        "a\x00b",
        "a\u200bb",
        "क्\u2028ष",
    ],
)
def test_control_characters_and_lone_joiners_do_not(name: str, tmp_path: Path) -> None:
    assert not is_printable(name)
    with pytest.raises(InvalidArgument, match="cannot be the name of a file"):
        Takes(tmp_path, [name], "p1", 1, "gesture", "{label}/{person}_{take}.avi")
