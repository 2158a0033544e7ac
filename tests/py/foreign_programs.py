# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Programs that were not written here, by which tests check ours; None where one is not installed."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path

# Debian's package sctk keeps its programs apart.
SCLITE = shutil.which("sclite", path=os.pathsep.join([os.environ.get("PATH", ""), "/usr/lib/sctk/bin"]))
JULIUS = shutil.which("julius")


def sclite_counts(folder: Path, references: Sequence[Sequence[str]], hypotheses: Sequence[Sequence[str]]) -> list[int]:
    """Sentences, words, correct, substituted, deleted, inserted, and all errors, as sclite counts them."""
    assert SCLITE is not None
    for name, lists in (("ref", references), ("hyp", hypotheses)):
        lines = [f"{' '.join(words)} (speaker_{i})\n" for i, words in enumerate(lists)]
        (folder / name).write_text("".join(lines))
    command = [SCLITE, "-r", "ref", "trn", "-h", "hyp", "trn", "-i", "rm", "-o", "rsum", "stdout"]
    out = subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True).stdout
    row = re.search(r"\|\s*Sum\s*\|\s*(\d+)\s+(\d+)\s*\|\s*(\d+)\s+(\d+)\s+(\d+)\s+(\d+)\s+(\d+)", out)
    assert row is not None, out
    return [int(number) for number in row.groups()]
