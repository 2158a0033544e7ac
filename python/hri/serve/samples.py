# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Samples of the page as a data set to download."""

from __future__ import annotations

import io
import json
import zipfile
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from hri.core.text import is_printable
from hri.io import write_wav_pcm16
from hri.media import Audio

_BAD = frozenset('/\\:*?"<>|')
_MANIFEST = """format_version = 1
kind = "speech"
name = "samples of the page"
"""


def samples_zip(rows: Sequence[tuple[Audio, str, str]]) -> bytes:
    """A ZIP archive of recordings, ``{label}/{person}_{take}.wav``, and a manifest that has label and person of each.

    What no name of a folder may have is left out of the folders' names; the manifest has the labels as they are.

    Parameters
    ----------
    rows : sequence of (Audio, label, person)
        Takes are counted for each label and person.
    """
    takes: Counter[tuple[str, str]] = Counter()
    folders = _folders([label for _, label, _ in rows])
    manifest = [_MANIFEST]
    archive = io.BytesIO()
    with TemporaryDirectory(prefix="hri-serve-") as folder, zipfile.ZipFile(archive, "w") as out:
        path = Path(folder) / "sample.wav"
        for clip, label, person in rows:
            takes[label, person] += 1
            take = str(takes[label, person])
            name = f"{folders[label]}/{person}_{take}.wav"
            write_wav_pcm16(str(path), clip.samples, clip.sample_rate_hz)
            out.write(path, name)
            row = {"path": name, "label": label, "person": person, "take": take}
            manifest += ["[[samples]]\n", *(f"{key} = {_toml(value)}\n" for key, value in row.items())]
        out.writestr("dataset.toml", "".join(manifest))
    return archive.getvalue()


def _folders(labels: Sequence[str]) -> dict[str, str]:
    """A folder for each label, whose name every system takes, and which no other label has."""
    found: dict[str, str] = {}
    for label in dict.fromkeys(labels):
        plain = "".join("_" if letter in _BAD or not is_printable(letter) else letter for letter in label)
        plain = plain.strip(" .") or "_"
        name, number = plain, 1
        while name.casefold() in (used.casefold() for used in found.values()):
            number += 1
            name = f"{plain}_{number}"
        found[label] = name
    return found


def _toml(text: str) -> str:
    """TOML's strings are JSON's but for DEL."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
