# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A folder of labelled recordings."""

from __future__ import annotations

import logging
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from os import PathLike
from pathlib import Path

from hri.core.display import count, html_table, short_path, summary
from hri.core.errors import FormatError, InvalidArgument, IoError
from hri.core.labels import as_texts
from hri.core.suggest import did_you_mean
from hri.datasets.detection import detect_kind, detect_pattern, is_noise, media_files
from hri.datasets.folds import Fold, split_by_person, split_by_value, split_stratified
from hri.datasets.manifest import KINDS, MANIFEST_NAME, Manifest, read_manifest
from hri.datasets.pattern import PathFields, Pattern
from hri.datasets.skig import is_skig, skig_clips
from hri.media import natural_key

_log = logging.getLogger(__name__)


@dataclass(frozen=True)
class Sample:
    """One recording: its file, what is said or shown, by whom, which repetition ("" if unknown), and under which
    conditions, such as {"illumination": "dark"}, where the data set says so."""

    path: Path
    label: str
    person: str = ""
    take: str = ""
    conditions: dict[str, str] = field(default_factory=dict)

    def __repr__(self) -> str:
        known = {"person": self.person, "take": self.take, **self.conditions}
        shown = (f"{name}={value!r}" for name, value in known.items() if value)
        return summary("Sample", repr(self.label), *shown, short_path(self.path))


@dataclass(frozen=True)
class Dataset:
    """Labelled recordings in one folder; `load` makes one.

    Attributes
    ----------
    root : Path
    kind : "speech" or "gesture"
    samples : list of Sample
        Natural order of their paths, or the manifest's order.
    pattern : str or None
        How label, person and take were read from the paths; None for a manifest with tables.
    synthetic : bool
        The manifest says that a program made the recordings.
    ignored : list of Path
        Recordings under `root` that do not fit a pattern given by the caller or the manifest, and, where the pattern
        was found out, those in a folder ``_background_noise_``.
    """

    root: Path
    kind: str
    samples: list[Sample]
    pattern: str | None = None
    synthetic: bool = False
    ignored: list[Path] = field(default_factory=list)

    @classmethod
    def load(
        cls,
        directory: str | PathLike[str],
        kind: str | None = None,
        pattern: str | None = None,
    ) -> Dataset:
        """Find the recordings in a folder; their content is not read yet.

        Parameters
        ----------
        directory : path-like
        kind : "speech" or "gesture", optional
            By default as the manifest says, or by the suffixes of the files.
        pattern : str, optional
            Such as ``"{label}/{label}_{person}_{take}.wav"``, see `Pattern`; it goes before a
            manifest. Without it a ``dataset.toml`` is read, and without that the common layouts
            are tried.

        Raises
        ------
        InvalidArgument
            For an unknown kind or a bad pattern.
        FormatError
            For a faulty manifest (file, table and row are named), a layout that is not recognised
            (what was tried is listed), a label or person that is not UTF-8, or a folder without recordings.
        IoError
            When `directory` is not a folder.
        """
        dataset = cls._load(Path(directory), kind, pattern)
        _log.info("%r", dataset)
        return dataset

    @classmethod
    def _load(cls, root: Path, kind: str | None, pattern: str | None) -> Dataset:
        if kind is not None and kind not in KINDS:
            raise InvalidArgument(f"kind is {kind!r}, must be one of {KINDS}")
        if not root.is_dir():
            raise IoError(f"{root}: not a folder" if root.exists() else f"{root}: no such folder")
        manifest_path = root / MANIFEST_NAME
        if pattern is not None:
            kind = kind or detect_kind(root)
            return _load_pattern(root, kind, Pattern(pattern), media_files(root, kind))
        if manifest_path.exists():
            return _load_manifest(root, kind, manifest_path)
        kind = kind or detect_kind(root)
        found = media_files(root, kind)
        files = [path for path in found if not is_noise(root, path)]
        if not files:
            raise FormatError(f"{root}: no {kind} recordings in it")
        if kind == "gesture" and is_skig(root):
            return load_skig(root)
        dataset = _load_pattern(root, kind, detect_pattern(root, files), files)
        return replace(dataset, ignored=[path for path in found if is_noise(root, path)])

    def __len__(self) -> int:
        return len(self.samples)

    def __repr__(self) -> str:
        return summary(
            "Dataset",
            self.kind,
            count(len(self), "sample"),
            count(len(self.labels), "label"),
            count(len(self.persons), "person") if self.persons else "persons not known",
            "synthetic" if self.synthetic else "",
            short_path(self.root),
        )

    def _repr_html_(self) -> str:
        rows = []
        for label in self.labels:
            persons = [sample.person for sample in self.samples if sample.label == label]
            rows.append((label, len(persons), len({person for person in persons if person}) or ""))
        return html_table(("label", "samples", "persons"), rows, repr(self))

    def __iter__(self) -> Iterator[Sample]:
        return iter(self.samples)

    @property
    def labels(self) -> list[str]:
        """All labels, each once, in natural order."""
        return sorted({sample.label for sample in self.samples}, key=natural_key)

    @property
    def persons(self) -> list[str]:
        """All persons, each once, in natural order; empty when they are not known."""
        return sorted({s.person for s in self.samples if s.person}, key=natural_key)

    @property
    def conditions(self) -> dict[str, list[str]]:
        """What is known of the conditions of all samples: every name with its values, in natural order."""
        names = set.intersection(*(set(s.conditions) for s in self.samples)) if self.samples else set()
        return {
            name: sorted({s.conditions[name] for s in self.samples}, key=natural_key)
            for name in sorted(names, key=natural_key)
        }

    def select(self, labels: Iterable[str | int] | None = None, persons: Iterable[str | int] | None = None) -> Dataset:
        """The part with these labels and these persons (None: all); integers stand for their digits.

        Raises
        ------
        InvalidArgument
            For a label or person that does not occur or is no text, and for a single text in place of a sequence.
        """
        wanted_labels = _members(labels, self.labels, "label")
        wanted_persons = _members(persons, self.persons, "person")
        return replace(
            self,
            samples=[
                sample
                for sample in self.samples
                if (wanted_labels is None or sample.label in wanted_labels)
                and (wanted_persons is None or sample.person in wanted_persons)
            ],
        )

    def folds_by_person(self, num_folds: int | None = None, seed: int = 0) -> list[Fold]:
        """Folds in which no person is in both parts; None holds out one person at a time.

        Raises
        ------
        InvalidArgument
            When the person of a recording is not known, which is named, or persons are fewer than the folds.
        """
        nameless = [sample.path for sample in self.samples if not sample.person]
        if nameless:
            raise InvalidArgument(
                f"{nameless[0]}: its person is not known, as of {len(nameless)} of {len(self)} recordings, so they "
                "cannot be split by person"
            )
        return split_by_person([sample.person for sample in self.samples], num_folds, seed)

    def folds_by_condition(self, name: str) -> list[Fold]:
        """Folds that each hold out one value of a condition.

        Raises
        ------
        InvalidArgument
            For a condition that not every sample has, or that has one value only.
        """
        known = self.conditions
        if not isinstance(name, str) or name not in known:
            raise InvalidArgument(f"condition {name!r} is not known of every sample; known are {sorted(known)}")
        return split_by_value(name, [sample.conditions[name] for sample in self.samples])

    def folds_stratified(self, num_folds: int = 5, seed: int = 0) -> list[Fold]:
        """Folds with nearly the same share of every label, whatever the person."""
        return split_stratified([sample.label for sample in self.samples], num_folds, seed)


def load_skig(root: Path, stream: str = "rgb") -> Dataset:
    """The Sheffield Kinect Gesture data set: one of its two streams, "rgb" or "dep"; errors as of `skig_clips`."""
    samples = [Sample(c.path, c.label, c.person, c.take, c.conditions) for c in skig_clips(root, stream)]
    used = {sample.path for sample in samples}
    return Dataset(root, "gesture", samples, ignored=[p for p in media_files(root, "gesture") if p not in used])


def _load_pattern(root: Path, kind: str, pattern: Pattern, files: Iterable[Path]) -> Dataset:
    samples, ignored = [], []
    for path in files:
        fields = pattern.match(path.relative_to(root).as_posix())
        if fields is None:
            ignored.append(path)
        else:
            _require_text(path, fields)
            samples.append(Sample(path, fields.label, fields.person, fields.take))
    if not samples:
        example = f", for example {ignored[0].relative_to(root).as_posix()}" if ignored else ""
        raise FormatError(f"{root}: none of its {len(ignored)} {kind} files fits {pattern.text!r}{example}")
    return Dataset(root, kind, samples, pattern.text, ignored=ignored)


def _require_text(path: Path, fields: PathFields) -> None:
    for what, text in (("label", fields.label), ("person", fields.person)):
        if any("\ud800" <= character <= "\udfff" for character in text):
            raise FormatError(f"{path}: the name is not UTF-8, so it can hold no {what}")


def _load_manifest(root: Path, kind: str | None, path: Path) -> Dataset:
    manifest = read_manifest(path)
    if kind is not None and kind != manifest.kind:
        raise FormatError(f"{path}: kind is {manifest.kind!r}, but {kind!r} was asked for")
    if manifest.pattern is not None:
        dataset = _load_pattern(root, manifest.kind, Pattern(manifest.pattern), media_files(root, manifest.kind))
        places: Iterable[str] = (str(sample.path) for sample in dataset.samples)
    else:
        dataset = Dataset(root, manifest.kind, _listed_samples(root, manifest, path))
        places = (f"[[samples]] row {i + 1}" for i in range(len(dataset)))
    if manifest.labels:
        for place, sample in zip(places, dataset.samples, strict=True):
            if sample.label not in manifest.labels:
                raise FormatError(f"{path}: {place}: label {sample.label!r} is not in labels {manifest.labels}")
    return replace(dataset, synthetic=manifest.synthetic)


def _listed_samples(root: Path, manifest: Manifest, manifest_path: Path) -> list[Sample]:
    samples = []
    for number, row in enumerate(manifest.rows, start=1):
        path = root / row.path
        if not path.is_file():
            raise FormatError(f"{manifest_path}: [[samples]] row {number}: no file {row.path!r}")
        samples.append(Sample(path, row.label, row.person, row.take))
    if not samples:
        raise FormatError(f"{manifest_path}: no [[samples]] tables in it")
    return samples


def _members(wanted: Iterable[str | int] | None, known: list[str], what: str) -> set[str] | None:
    if wanted is None:
        return None
    names = as_texts(wanted, f"{what}s")  # read once: it may be a generator
    for name in names:
        if name not in known:
            raise InvalidArgument(f"no {what} {name!r} in this data set; {did_you_mean(name, known, 'it has')}")
    return set(names)
