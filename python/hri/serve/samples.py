# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Samples of the page as a data set to download."""

from __future__ import annotations

import io
import zipfile
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from hri.core.errors import InvalidArgument
from hri.core.text import is_printable
from hri.io import write_wav_pcm16
from hri.media import Audio

_BAD = frozenset('/\\:*?"<>|')
_PATTERN = "{label}/{person}_{take}.wav"
_MANIFEST = f"""format_version = 1
kind = "speech"
name = "samples of the page"
pattern = "{_PATTERN}"
"""


def samples_zip(rows: Sequence[tuple[Audio, str, str]]) -> bytes:
    """A ZIP archive of recordings, ``{label}/{person}_{take}.wav``, and a manifest that says so.

    Parameters
    ----------
    rows : sequence of (Audio, label, person)
        Takes are counted for each label and person.

    Raises
    ------
    InvalidArgument
        For a label that cannot be the name of a folder.
    """
    takes: Counter[tuple[str, str]] = Counter()
    archive = io.BytesIO()
    with TemporaryDirectory(prefix="hri-serve-") as folder, zipfile.ZipFile(archive, "w") as out:
        path = Path(folder) / "sample.wav"
        for clip, label, person in rows:
            if _BAD & set(label) or label.startswith(".") or label != label.strip() or not is_printable(label):
                raise InvalidArgument(f"“{label}” cannot be the name of a folder: undo it, and choose another name")
            takes[label, person] += 1
            write_wav_pcm16(str(path), clip.samples, clip.sample_rate_hz)
            out.write(path, _PATTERN.format(label=label, person=person, take=takes[label, person]))
        out.writestr("dataset.toml", _MANIFEST)
    return archive.getvalue()
