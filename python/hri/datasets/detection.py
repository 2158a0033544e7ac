# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Finding out how a folder without a manifest is laid out."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Sequence
from pathlib import Path

from hri.core.errors import FormatError
from hri.datasets.pattern import Pattern
from hri.media import AUDIO_SUFFIXES, IMAGE_SUFFIXES, VIDEO_SUFFIXES, natural_key

SUFFIXES = {"speech": AUDIO_SUFFIXES, "gesture": IMAGE_SUFFIXES + VIDEO_SUFFIXES}

# From the most to the least particular; the first that fits every file is taken.
COMMON_PATTERNS = (
    "{label}/{label}_{person}_{take}",
    "{label}/{person}_nohash_{take}",
    "{label}_{person}_{take}",
    "{person}/{label}/{take}",
    "{label}/{person}/{take}",
    "{person}/{label}_{take}",
    "{label}/{person}_{take}",
    "{person}/{label}",
    "{label}/{take}",
)
_PERSON_NAME = re.compile(r"(person|speaker|signer|subject|user|actor|participant|p|s)[-_]?\d+", re.I)
_TAKE_NAME = re.compile(r"(take|t|sample|clip|img|image|frame|rec)?[-_]?\d+", re.I)


def media_files(root: Path, kind: str) -> list[Path]:
    """All files of the kind under `root`, hidden ones left out, in natural order (2 before 10)."""
    found = [
        path
        for path in root.rglob("*")
        if path.suffix.lower() in SUFFIXES[kind]
        and path.is_file()
        and not any(part.startswith(".") for part in path.relative_to(root).parts)
    ]
    return sorted(found, key=lambda path: natural_key(path.relative_to(root).as_posix()))


def detect_kind(root: Path) -> str:
    """ "speech" or "gesture", by the files under `root`.

    Raises
    ------
    FormatError
        When there is neither, or both.
    """
    kinds = [kind for kind in SUFFIXES if media_files(root, kind)]
    if len(kinds) == 1:
        return kinds[0]
    what = "no sound, picture or video files" if not kinds else "sound as well as pictures or video"
    raise FormatError(f"{root}: holds {what}; say kind='speech' or kind='gesture'")


def detect_pattern(root: Path, files: Sequence[Path]) -> Pattern:
    """The first of `COMMON_PATTERNS` that fits every file, with fields that look like their names.

    An outer folder that all files share, or that only groups them ("digits", "words"), is skipped.

    Raises
    ------
    FormatError
        When none fits, with what was tried, or when two fit equally well.
    """
    names = [path.relative_to(root).as_posix() for path in files]
    tried: list[str] = []
    for prefix in ("", "{_}/"):
        for text in COMMON_PATTERNS:
            pattern = Pattern(prefix + text)
            reason = _misfit(pattern, names)
            if reason is None:
                _refuse_ambiguous(root, pattern, names)
                return pattern
            tried.append(f"  {pattern.text}: {reason}")
    raise FormatError(
        f"{root}: the names of its {len(names)} files follow none of the layouts known here; "
        "write a dataset.toml, or say pattern='...'. Tried:\n" + "\n".join(tried)
    )


def _misfit(pattern: Pattern, names: Sequence[str]) -> str | None:
    """Why `pattern` does not describe these files, or None."""
    persons: set[str] = set()
    labels: set[str] = set()
    for name in names:
        fields = pattern.match(name)
        if fields is None:
            return f"does not fit {name}"
        if pattern.has_take and pattern.has_person and not _TAKE_NAME.fullmatch(fields.take):
            return f"{fields.take!r} in {name} is no take number"
        persons.add(fields.person)
        labels.add(fields.label)
    if len(labels) < 2:
        return f"would give the one label {labels.pop()!r}"
    if pattern.has_person and not _looks_like_persons(pattern, persons, labels):
        return f"{sorted(persons)[0]!r} does not look like a person"
    return None


def _looks_like_persons(pattern: Pattern, persons: set[str], labels: set[str]) -> bool:
    """Where the order does not distinguish person and label, the person must be named as one."""
    if pattern.text.count("{label}") > 1 or "_nohash_" in pattern.text:
        return True
    if pattern.text.endswith("{label}_{person}_{take}"):
        return not any(_TAKE_NAME.fullmatch(person) for person in persons)
    if any(_PERSON_NAME.fullmatch(label) for label in labels):
        return False
    if pattern.text.endswith("{label}/{person}_{take}"):
        return True
    return all(_PERSON_NAME.fullmatch(person) for person in persons)


def _refuse_ambiguous(root: Path, pattern: Pattern, names: Sequence[str]) -> None:
    """`{label}/{take}` also fits persons who each show the same words: ask rather than guess."""
    if pattern.text not in ("{label}/{take}", "{_}/{label}/{take}"):
        return
    takes: dict[str, set[str]] = defaultdict(set)
    for name in names:
        fields = pattern.match(name)
        assert fields is not None
        takes[fields.label].add(fields.take)
    same_everywhere = len(takes) > 1 and len({frozenset(stems) for stems in takes.values()}) == 1
    numbered = all(re.fullmatch(r"[^\W\d]+[-_]?\d+", take) for take in next(iter(takes.values())))
    if same_everywhere and not numbered:
        other = pattern.text.replace("{label}/{take}", "{person}/{label}")
        raise FormatError(f"{root}: {names[0]} may be {pattern.text} or {other}; say which by pattern='...'")
