# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Data sets in folders: patterns, detection, manifests and folds."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hri.core.errors import FormatError, InvalidArgument, IoError
from hri.datasets import Dataset, Pattern
from hri.datasets.manifest import Manifest, SampleRow, read_manifest, write_manifest


def touch(root: Path, *names: str) -> Path:
    """Empty files; a data set does not open its recordings."""
    for name in names:
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()
    return root


def fields(pattern: str, path: str) -> tuple[str, str, str] | None:
    found = Pattern(pattern).match(path)
    return None if found is None else (found.label, found.person, found.take)


@pytest.mark.parametrize(
    ("pattern", "path", "expected"),
    [
        ("{label}_{person}_{take}.wav", "3_theo_12.wav", ("3", "theo", "12")),
        ("{label}_{person}_{take}.wav", "3_theo_12.WAV", ("3", "theo", "12")),
        ("{label}_{person}_{take}.wav", "3_theo_12.flac", None),
        ("{label}_{person}_{take}.wav", "x/3_theo_12.wav", None),
        ("{label}_{person}_{take}", "turn_left_ann_1.wav", ("turn_left", "ann", "1")),
        ("{label}/{label}_{person}_{take}.wav", "7/7_speaker1_2.wav", ("7", "speaker1", "2")),
        ("{label}/{label}_{person}_{take}.wav", "7/8_speaker1_2.wav", None),
        ("{person}/{label}.jpg", "person001/9.jpg", ("9", "person001", "")),
        ("{label}/{take}.m4v", "swipeUp/t3.m4v", ("swipeUp", "", "t3")),
        ("{_}/{label}-{_}-{take}.wav", "any/go-thing-4.wav", ("go", "", "4")),
        ("a+b/{label}.wav", "a+b/go.wav", ("go", "", "")),
        ("a+b/{label}.wav", "aab/go.wav", None),
        ("{label}/{person}.wav", "नमस्ते/अनु.wav", ("नमस्ते", "अनु", "")),
    ],
)
def test_pattern_splits_paths(pattern: str, path: str, expected: object) -> None:
    assert fields(pattern, path) == expected


@pytest.mark.parametrize(
    ("pattern", "message"),
    [
        ("{person}/{take}.wav", r"needs a \{label\}"),
        ("", r"needs a \{label\}"),
        ("{label}/{speaker}.wav", r"unknown placeholder \{speaker\}"),
        ("{label}{person}.wav", r"nothing between \{label\} and \{person\}"),
        ("{label}/{take.wav", "brace"),
        ("../{label}.wav", "inside"),
        ("/{label}.wav", "inside"),
    ],
)
def test_pattern_without_sense_is_refused(pattern: str, message: str) -> None:
    with pytest.raises(InvalidArgument, match=message):
        Pattern(pattern)


LAYOUTS = {
    "{label}_{person}_{take}": ["0_theo_0.wav", "0_theo_10.wav", "0_theo_2.wav", "1_ann_0.wav"],
    "{_}/{label}_{person}_{take}": ["recordings/0_theo_0.wav", "recordings/1_ann_0.wav"],
    "{label}/{label}_{person}_{take}": ["7/7_speaker1_1.wav", "10/10_speaker2_1.wav"],
    "{_}/{label}/{label}_{person}_{take}": ["digits/7/7_s1_1.wav", "words/ghar/ghar_s2_1.wav"],
    "{label}/{person}_nohash_{take}": ["yes/0a7c_nohash_0.wav", "no/0a7c_nohash_1.wav"],
    "{person}/{label}": ["person001/0.jpg", "person001/1.jpg", "person002/0.jpg"],
    "{label}/{take}": ["pinch/t1.m4v", "pinch/t2.m4v", "zoom/t1.m4v", "zoom/t2.m4v"],
    "{person}/{label}/{take}": ["speaker1/go/1.wav", "speaker1/halt/1.wav", "speaker2/go/1.wav"],
    "{label}/{person}/{take}": ["go/speaker1/1.wav", "halt/speaker1/1.wav", "go/speaker2/1.wav"],
    "{person}/{label}_{take}": ["s1/go_1.wav", "s1/halt_1.wav", "s2/go_1.wav"],
    "{label}/{person}_{take}": ["go/ann_1.wav", "halt/bob_1.wav"],
}


@pytest.mark.parametrize("pattern", LAYOUTS)
def test_common_layouts_are_recognised(tmp_path: Path, pattern: str) -> None:
    dataset = Dataset.load(touch(tmp_path, *LAYOUTS[pattern]))
    assert dataset.pattern == pattern
    assert len(dataset) == len(LAYOUTS[pattern])
    assert dataset.kind == ("speech" if LAYOUTS[pattern][0].endswith("wav") else "gesture")
    assert not dataset.synthetic
    assert dataset.ignored == []


def test_labels_takes_and_samples_are_in_natural_order(tmp_path: Path) -> None:
    dataset = Dataset.load(touch(tmp_path, *LAYOUTS["{label}_{person}_{take}"], ".hidden_a_1.wav"))
    assert [sample.take for sample in dataset if sample.label == "0"] == ["0", "2", "10"]
    touch(tmp_path, "10_ann_0.wav", "2_ann_0.wav")
    assert Dataset.load(tmp_path).labels == ["0", "1", "2", "10"]


def test_unknown_layout_lists_what_was_tried(tmp_path: Path) -> None:
    touch(tmp_path, "doing_the_dishes.wav", "hum.wav")
    with pytest.raises(FormatError) as caught:
        Dataset.load(tmp_path)
    for text in (
        "{label}_{person}_{take}",
        "{label}/{take}",
        "doing_the_dishes.wav",
        "dataset.toml",
    ):
        assert text in str(caught.value)


def test_layout_that_may_be_two_things_is_asked_for(tmp_path: Path) -> None:
    touch(tmp_path, "ann/0.jpg", "ann/1.jpg", "bob/0.jpg", "bob/1.jpg")
    with pytest.raises(FormatError, match=r"\{label\}/\{take\} or \{person\}/\{label\}"):
        Dataset.load(tmp_path)
    assert Dataset.load(tmp_path, pattern="{person}/{label}.jpg").persons == ["ann", "bob"]


def test_noise_beside_words_is_no_word(tmp_path: Path) -> None:
    words = ["yes/0a7c_nohash_0.wav", "no/0a7c_nohash_0.wav", "no/11ff_nohash_0.wav"]
    dataset = Dataset.load(touch(tmp_path, *words, "_background_noise_/pink_noise.wav"))
    assert dataset.pattern == "{label}/{person}_nohash_{take}"
    assert (dataset.labels, dataset.persons) == (["no", "yes"], ["0a7c", "11ff"])
    assert dataset.ignored == [tmp_path / "_background_noise_/pink_noise.wav"]
    touch(tmp_path / "nameless", "yes/1.wav", "yes/2.wav", "no/1.wav", "_background_noise_/1.wav")
    assert Dataset.load(tmp_path / "nameless").labels == ["no", "yes"]
    with pytest.raises(FormatError, match="no speech recordings"):
        Dataset.load(touch(tmp_path / "noise", "_background_noise_/1.wav"))


@pytest.mark.parametrize(
    ("pattern", "names", "other"),
    [
        ("{label}/{person}_nohash_{take}", "{label}/{person}_nohash_0.wav", "go/hum.wav"),
        ("{person}/{label}/{take}", "speaker{person}/{label}/1.wav", "speaker1/go/hum.wav"),
    ],
)
def test_a_file_that_is_named_otherwise_does_not_cost_all_others_their_persons(
    tmp_path: Path, pattern: str, names: str, other: str
) -> None:
    touch(tmp_path, *(names.format(label=label, person=person) for label in ("go", "halt") for person in range(5)))
    assert Dataset.load(tmp_path).pattern == pattern
    touch(tmp_path, other)
    with pytest.raises(FormatError, match=f"10 of its 11 files .* these do not: {other}; say pattern='{pattern}'"):
        Dataset.load(tmp_path)
    assert len(Dataset.load(tmp_path, pattern=pattern).persons) == 5


def test_takes_that_begin_alike_are_no_persons(tmp_path: Path) -> None:
    takes = ["go/rec_1.wav", "go/rec_2.wav", "go/rec_3.wav", "halt/rec_1.wav", "halt/again.wav"]
    assert Dataset.load(touch(tmp_path, *takes)).pattern == "{label}/{take}"


def test_folders_that_are_links_are_followed_once(tmp_path: Path) -> None:
    root = touch(tmp_path / "root", "speaker1/go.wav", "speaker1/halt.wav")
    touch(tmp_path / "elsewhere", "go.wav", "halt.wav", ".hidden.wav")
    (root / "speaker2").symlink_to(tmp_path / "elsewhere")
    (root / "speaker3").symlink_to(tmp_path / "elsewhere")  # the same recordings
    (root / "speaker0").symlink_to(root / "speaker1")
    (root / "speaker1/up").symlink_to(root)
    (root / "speaker1/top").symlink_to(tmp_path)
    (tmp_path / "elsewhere/loop").symlink_to(root)
    dataset = Dataset.load(root)
    assert [(sample.person, sample.label) for sample in dataset] == [
        ("speaker1", "go"),
        ("speaker1", "halt"),
        ("speaker2", "go"),
        ("speaker2", "halt"),
    ]
    assert dataset.samples[2].path == root / "speaker2/go.wav"


def test_given_pattern_says_which_files_it_left_out(tmp_path: Path) -> None:
    touch(tmp_path, "go_ann_1.wav", "noise.wav", "read.me")
    dataset = Dataset.load(tmp_path, pattern="{label}_{person}_{take}.wav")
    assert [sample.label for sample in dataset] == ["go"]
    assert dataset.ignored == [tmp_path / "noise.wav"]
    with pytest.raises(FormatError, match=r"none of its 2 speech files fits '\{label\}-\{take\}'"):
        Dataset.load(tmp_path, pattern="{label}-{take}")


def test_kind_is_asked_for_when_both_are_there(tmp_path: Path) -> None:
    touch(tmp_path, "go/t1.wav", "stop/t1.wav", "go/t1.mp4", "stop/t1.mp4")
    with pytest.raises(FormatError, match="say kind"):
        Dataset.load(tmp_path)
    assert Dataset.load(tmp_path, "gesture").samples[0].path.suffix == ".mp4"
    with pytest.raises(InvalidArgument, match="kind is 'song'"):
        Dataset.load(tmp_path, kind="song")


def test_folder_without_recordings_is_refused(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match="no sound, picture or video"):
        Dataset.load(tmp_path)
    with pytest.raises(FormatError, match="no speech recordings"):
        Dataset.load(tmp_path, kind="speech")
    with pytest.raises(IoError, match="no such folder"):
        Dataset.load(tmp_path / "gone")
    with pytest.raises(IoError, match="not a folder"):
        Dataset.load(touch(tmp_path, "file.txt") / "file.txt")


def test_select_keeps_labels_and_persons(tmp_path: Path) -> None:
    dataset = Dataset.load(touch(tmp_path, "0_theo_0.wav", "1_theo_0.wav", "0_ann_0.wav"))
    part = dataset.select(labels=["0"], persons=["ann"])
    assert [(s.label, s.person) for s in part] == [("0", "ann")]
    with pytest.raises(InvalidArgument, match="no label '7'"):
        dataset.select(labels=["7"])


@pytest.mark.parametrize("as_given", [tuple, iter, np.array, dict.fromkeys])
def test_select_reads_any_sequence_once(tmp_path: Path, as_given: Callable[[list[str]], Any]) -> None:
    dataset = Dataset.load(touch(tmp_path, "1_theo_0.wav", "2_theo_0.wav", "12_ann_0.wav"))
    assert dataset.select(labels=as_given(["2", "12"])).labels == ["2", "12"]
    assert dataset.select(persons=as_given(["theo"])).labels == ["1", "2"]
    assert len(dataset.select(labels=np.array([], str))) == 0
    assert dataset.select(labels=[1]).labels == dataset.select(labels=np.array([1])).labels == ["1"]


@pytest.mark.parametrize("what", ["labels", "persons"])
def test_select_refuses_what_names_nothing(tmp_path: Path, what: str) -> None:
    dataset = Dataset.load(touch(tmp_path, "1/1/0.wav", "2/2/0.wav"), pattern="{label}/{person}/{take}")
    for wrong, complaint in (
        ("12", r"must be a sequence of texts, got one: write \['12'\]"),
        (b"1", "must be a sequence of texts"),
        (1, "must be a sequence of texts, got 1"),
        ([None], r"\[0\] must be text, got None"),
        (["1", float("nan")], r"\[1\] must be text, got nan"),
        ([True], r"\[0\] must be text, got True"),
    ):
        with pytest.raises(InvalidArgument, match=f"^{what}.*{complaint}"):
            dataset.select(**{what: wrong})


MANIFEST = """
kind = "speech"
[[samples]]
path = "a.wav"
label = "go"
person = "ann"
[[samples]]
path = "b.wav"
label = "halt"
"""


def manifest_in(root: Path, text: str) -> Path:
    touch(root, "a.wav", "b.wav")
    (root / "dataset.toml").write_text(text, encoding="utf-8")
    return root


def test_manifest_lists_samples(tmp_path: Path) -> None:
    dataset = Dataset.load(manifest_in(tmp_path, "synthetic = true\n" + MANIFEST))
    assert dataset.kind == "speech"
    assert dataset.synthetic
    assert dataset.pattern is None
    assert [(s.path.name, s.label, s.person, s.take) for s in dataset] == [
        ("a.wav", "go", "ann", ""),
        ("b.wav", "halt", "", ""),
    ]


def test_manifest_gives_a_pattern(tmp_path: Path) -> None:
    touch(tmp_path, "go/ann_1.wav", "halt/bob_1.wav")
    text = 'kind = "speech"\npattern = "{label}/{person}_{take}.wav"\nlabels = ["go", "halt"]\n'
    (tmp_path / "dataset.toml").write_text(text)
    assert Dataset.load(tmp_path).persons == ["ann", "bob"]


ROW = 'kind = "speech"\n[[samples]]\npath = "a.wav"\nlabel = "go"\n'


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (ROW + "speaker = 'x'\n", r"\[\[samples\]\] row 1: unknown key speaker"),
        (ROW + "persn = 'x'\n", r"unknown key persn; did you mean person"),
        ("colour = 1\n" + ROW, "unknown key colour; known are"),
        (ROW + ROW[16:].replace("a.wav", "c.wav"), r"\[\[samples\]\] row 2: no file 'c.wav'"),
        (ROW + ROW[16:], r"\[\[samples\]\] row 2: path 'a.wav' is already in row 1"),
        (ROW.replace('label = "go"', ""), r"\[\[samples\]\] row 1: label is missing"),
        (ROW.replace('"go"', "3"), r"row 1: label is 3, must be text"),
        (ROW.replace('"go"', '" "'), r"row 1: label is empty"),
        ("labels = ['halt']\n" + ROW, r"\[\[samples\]\] row 1: label 'go' is not in labels"),
        ("labels = ['go', 1]\n" + ROW, "labels, entry 2 is 1"),
        ("synthetic = 1\n" + ROW, "synthetic is 1, must be true or false"),
        ("samples = [1]\nkind = 'speech'\n", r"\[\[samples\]\] row 1 is 1, must be a table"),
        ("format_version = 2\n" + ROW, "format_version is 2, this program reads up to 1"),
        ("format_version = true\n" + ROW, "format_version is True, must be a whole number"),
        ("pattern = '{label}'\n" + ROW, "either pattern or"),
        ("kind = 'speech'\n", "either pattern or"),
        ("kind = 'speech'\nsamples = []\n", "no .*samples"),
        ("kind = 'speech'\npattern = 'x'\n", r"pattern: .*needs a \{label\}"),
        ("kind = 'song'\n", "kind is 'song', must be one of"),
        ("pattern = '{label}'\n", "kind is None, must be one of"),
        ("kind = \n", "not a TOML file: .*line 1"),
    ],
)
def test_faulty_manifest_names_file_table_and_row(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(FormatError, match=rf"dataset\.toml: .*{message}"):
        Dataset.load(manifest_in(tmp_path, text))


def test_manifest_that_is_no_text_is_refused(tmp_path: Path) -> None:
    (tmp_path / "dataset.toml").write_bytes(b"\xff\xfe\x00kind")
    with pytest.raises(FormatError, match="row 1: not UTF-8"):
        Dataset.load(tmp_path)


def test_kind_other_than_the_manifest_is_refused(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match="kind is 'speech', but 'gesture'"):
        Dataset.load(manifest_in(tmp_path, MANIFEST), kind="gesture")


def test_written_manifest_reads_back_equal(tmp_path: Path) -> None:
    manifest = Manifest(
        kind="gesture",
        name='with "quotes", \\ and\ttab',
        description="पाँच\x7f\n",
        licence="CC0-1.0",
        synthetic=True,
        labels=["go", "halt"],
        made_by={"program": "p", "seed": 3, "odd key": 1.5, "on": True},
        rows=[SampleRow("a b.jpg", "go", "ann", "1"), SampleRow("ü/b.jpg", "halt")],
    )
    write_manifest(tmp_path / "dataset.toml", manifest)
    assert read_manifest(tmp_path / "dataset.toml") == manifest
    assert [path.name for path in tmp_path.iterdir()] == ["dataset.toml"]
    with pytest.raises(IoError, match="gone"):
        write_manifest(tmp_path / "gone" / "dataset.toml", manifest)


def people(tmp_path: Path, count: int) -> Dataset:
    names = [f"{label}_p{person}_{take}.wav" for label in "ab" for person in range(count) for take in "12"]
    return Dataset.load(touch(tmp_path, *names), pattern="{label}_{person}_{take}.wav")


@pytest.mark.parametrize("num_folds", [None, 2, 3, 5])
def test_folds_hold_out_whole_persons_once(tmp_path: Path, num_folds: int | None) -> None:
    dataset = people(tmp_path, 5)
    folds = dataset.folds_by_person(num_folds)
    assert len(folds) == (num_folds or 5)
    assert sorted(i for fold in folds for i in fold.test) == list(range(len(dataset)))
    for fold in folds:
        trained = {dataset.samples[i].person for i in fold.train}
        tested = {dataset.samples[i].person for i in fold.test}
        assert trained.isdisjoint(tested)
        assert sorted(fold.train + fold.test) == list(range(len(dataset)))
        assert fold.name == ", ".join(sorted(tested))


def test_folds_depend_on_the_seed_alone(tmp_path: Path) -> None:
    dataset = people(tmp_path, 6)
    assert dataset.folds_by_person(3, seed=1) == dataset.folds_by_person(3, seed=1)
    assert len({tuple(f.name for f in dataset.folds_by_person(3, seed=s)) for s in range(8)}) > 1


def test_folds_that_cannot_be_are_refused(tmp_path: Path) -> None:
    dataset = people(tmp_path, 3)
    with pytest.raises(InvalidArgument, match=r"num_folds is 4, must be 2\.\.3"):
        dataset.folds_by_person(4)
    with pytest.raises(InvalidArgument, match="2 persons or more"):
        dataset.select(persons=["p1"]).folds_by_person()
    nameless = Dataset.load(touch(tmp_path / "x", "go/1.wav", "go/2.wav"), pattern="{label}/{take}")
    with pytest.raises(InvalidArgument, match=r"1\.wav: its person is not known, as of 2 of 2 recordings"):
        nameless.folds_by_person()
    rows = [f'[[samples]]\npath = "a_p{i}_1.wav"\nlabel = "a"\n' + f'person = "p{i}"\n' * (i != 1) for i in range(3)]
    manifest_in(tmp_path, 'kind = "speech"\n' + "".join(rows))
    with pytest.raises(InvalidArgument, match=r"a_p1_1\.wav: its person is not known, as of 1 of 3 recordings"):
        Dataset.load(tmp_path).folds_by_person()
    with pytest.raises(InvalidArgument, match="samples of label 'go'"):
        nameless.folds_stratified(3)
    whole = people(tmp_path / "y", 3)
    for split in (whole.folds_by_person, whole.folds_stratified):
        with pytest.raises(InvalidArgument, match=r"^num_folds must be an integer, got 2\.0"):
            split(2.0)
        with pytest.raises(InvalidArgument, match=r"^seed is -1, must be 0 or more"):
            split(2, seed=-1)
    with pytest.raises(InvalidArgument, match=r"condition .* is not known"):
        whole.folds_by_condition(["background"])


def test_stratified_folds_share_every_label(tmp_path: Path) -> None:
    dataset = people(tmp_path, 5)
    folds = dataset.folds_stratified(4, seed=2)
    assert sorted(i for fold in folds for i in fold.test) == list(range(20))
    for fold in folds:
        assert sorted(fold.train + fold.test) == list(range(20))
        for label in "ab":
            assert 2 <= sum(dataset.samples[i].label == label for i in fold.test) <= 3


@pytest.mark.parametrize(
    ("folder", "pattern", "count", "num_labels", "num_persons"),
    [
        ("fsdd/recordings", "{label}_{person}_{take}", 2000, 10, 4),
        ("hindi_words", "{_}/{label}/{label}_{person}_{take}", 400, 20, 4),
        ("sign_digits", "{person}/{label}", 1300, 10, 130),
        ("webcam_gestures", "{label}/{take}", 67, 8, 0),
    ],
)
def test_real_data_sets_are_recognised(
    folder: str, pattern: str, count: int, num_labels: int, num_persons: int
) -> None:
    root = Path(os.environ.get("HRI_DATA", "no such folder")) / folder
    if not root.is_dir():
        pytest.skip(f"HRI_DATA has no folder {folder}")
    dataset = Dataset.load(root)
    assert dataset.pattern == pattern
    found = len(dataset), len(dataset.labels), len(dataset.persons)
    assert found == (count, num_labels, num_persons)
