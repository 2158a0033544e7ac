# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Finding out how a folder without a manifest is laid out."""

from __future__ import annotations

import os
import re
from collections import defaultdict
from collections.abc import Sequence
from pathlib import Path

from hri.core.errors import FormatError
from hri.datasets.pattern import PathFields, Pattern
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
NOISE_FOLDER = "_background_noise_"
"""Of Speech Commands: minutes of noise beside the folders of words, and no word."""
NEARLY_ALL = 0.8
"""Share of files that follow a pattern with persons, from which on a pattern without them is not taken instead."""
NUM_SHOWN = 3
_PERSON_NAME = re.compile(r"(person|speaker|signer|subject|user|actor|participant|p|s)[-_]?\d+", re.I)
_TAKE_NAME = re.compile(r"(take|t|sample|clip|img|image|frame|rec)?[-_]?\d+", re.I)


def media_files(root: Path, kind: str) -> list[Path]:
    """All files of the kind under `root`, hidden ones left out, in natural order (2 before 10).

    Folders that are symbolic links are followed, each real folder once, by its own place under `root` if it has one.
    """
    found: list[Path] = []
    seen: set[str] = set()
    waiting = [root]
    while waiting:
        links: list[Path] = []
        for start in waiting:
            for folder, names, files in os.walk(start):  # follows no links: they come when all folders are seen
                real = os.path.realpath(folder)
                if real in seen:
                    names.clear()
                    continue
                seen.add(real)
                names[:] = [name for name in names if not name.startswith(".")]
                links += [link for name in names if (link := Path(folder, name)).is_symlink() and not _is_above(link)]
                found += [
                    path
                    for name in files
                    if not name.startswith(".")
                    and (path := Path(folder, name)).suffix.lower() in SUFFIXES[kind]
                    and path.is_file()
                ]
        waiting = _in_order(root, links)
    return _in_order(root, found)


def _is_above(link: Path) -> bool:
    """Whether a link leads to a folder that it lies in itself."""
    inside = link.parent.resolve()
    return link.resolve() in (inside, *inside.parents)


def _in_order(root: Path, paths: Sequence[Path]) -> list[Path]:
    return sorted(paths, key=lambda path: natural_key(path.relative_to(root).as_posix()))


def is_noise(root: Path, path: Path) -> bool:
    """Whether a file lies in the `NOISE_FOLDER` of a data set."""
    return NOISE_FOLDER in path.relative_to(root).parts[:-1]


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
        When none fits, with what was tried; when two fit equally well; when one without persons fits, and one with
        persons fits all but a few files, which are named.
    """
    names = [path.relative_to(root).as_posix() for path in files]
    tried: dict[Pattern, str] = {}
    for prefix in ("", "{_}/"):
        for text in COMMON_PATTERNS:
            pattern = Pattern(prefix + text)
            reason = _misfit(pattern, names)
            if reason is None:
                _refuse_ambiguous(root, pattern, names)
                if not pattern.has_person:
                    _refuse_lost_persons(root, pattern, names, list(tried))
                return pattern
            tried[pattern] = reason
    raise FormatError(
        f"{root}: the names of its {len(names)} files follow none of the layouts known here; "
        "write a dataset.toml, or say pattern='...'. Tried:\n"
        + "\n".join(f"  {one.text}: {reason}" for one, reason in tried.items())
    )


def _misfit(pattern: Pattern, names: Sequence[str]) -> str | None:
    """Why `pattern` does not describe these files, or None."""
    persons: set[str] = set()
    labels: set[str] = set()
    for name in names:
        fields = pattern.match(name)
        if fields is None:
            return f"does not fit {name}"
        if not _has_take_number(pattern, fields):
            return f"{fields.take!r} in {name} is no take number"
        persons.add(fields.person)
        labels.add(fields.label)
    if len(labels) < 2:
        return f"would give the one label {labels.pop()!r}"
    if pattern.has_person and not _looks_like_persons(pattern, persons, labels):
        return f"{sorted(persons)[0]!r} does not look like a person"
    return None


def _has_take_number(pattern: Pattern, fields: PathFields) -> bool:
    """True of patterns without a take, or without a person, too."""
    return not (pattern.has_take and pattern.has_person) or _TAKE_NAME.fullmatch(fields.take) is not None


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


def _refuse_lost_persons(root: Path, pattern: Pattern, names: Sequence[str], before: Sequence[Pattern]) -> None:
    """A few files that are named otherwise must not cost all others their persons."""
    for other in before:
        matched = {name: other.match(name) for name in names}
        persons = {name: one.person for name, one in matched.items() if one and _has_take_number(other, one)}
        if len(persons) < NEARLY_ALL * len(names) or len(set(persons.values())) < 2:
            continue
        if _misfit(other, list(persons)) is not None:
            continue
        others = [name for name in names if name not in persons]
        shown = ", ".join(others[:NUM_SHOWN]) + (f" and {len(others) - NUM_SHOWN} more" * (len(others) > NUM_SHOWN))
        raise FormatError(
            f"{root}: {len(persons)} of its {len(names)} files follow {other.text}, which names persons, and "
            f"these do not: {shown}; say pattern='{other.text}', or pattern='{pattern.text}' to do without persons"
        )
