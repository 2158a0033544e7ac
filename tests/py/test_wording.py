# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Docs, messages and comments use the terms of the field: words that were replaced do not come back."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ROOTS = ("benchmarks", "bindings", "cmake", "cpp", "docs", "examples", "fuzz", "python", "tests", "tools")
SUFFIXES = {".py", ".md", ".hpp", ".cpp", ".inc", ".toml", ".sh", ".pyi", ".txt", ".cmake"}
# What was written, and what the field says.
REPLACED = {
    # Files have a method tell().
    r"tells?(?!\()|told": "report, return, print; separate; metadata",
    r"taught": "trained, in the vocabulary",
    r"turn(s|ed)? down": "rejected",
    r"(is|are|was|were|be|not) taken for": "misrecognised as, mistaken for, counted as",
    r"nobody|somebody|whoever": "no speaker, a speaker, a signer, a caller",
    r"(gets?|got) used to": "adapts to",
    r"mend(s|ed)?": "repaired, interpolated",
    r"noise copies": "noise augmentation",
    r"floor of noise": "noise floor",
    r"least jerk": "minimum jerk",
    r"off its course": "heading error",
    r"farthest": "max displacement",
    r"joined features?": "concatenated features",
    r"path model": "resampled-trajectory classifier",
    r"last movement": "final stroke",
    r"hands at rest": "rest pose",
}
PATTERN = re.compile(rf"\b({'|'.join(REPLACED)})\b", re.IGNORECASE)


def replaced_words(text: str) -> list[str]:
    """What is written in the old words."""
    return [found[0] for found in PATTERN.finditer(text)]


def test_no_text_is_written_in_replaced_words() -> None:
    files = [ROOT / "README.md", ROOT / "CHANGELOG.md", ROOT / "CONTRIBUTING.md", ROOT / "run"]
    files += [p for root in ROOTS for p in sorted((ROOT / root).rglob("*")) if p.suffix in SUFFIXES]
    found = [
        f"{path.relative_to(ROOT)}:{number}: {word}"
        for path in files
        if path != Path(__file__).resolve() and "results" not in path.parts
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        for word in replaced_words(line)
    ]
    assert found == []


def test_a_replaced_word_is_seen() -> None:
    assert replaced_words("Whoever was told nothing is turned down.") == ["Whoever", "told", "turned down"]
    assert replaced_words("A teller has recommended a recommendation.") == []
