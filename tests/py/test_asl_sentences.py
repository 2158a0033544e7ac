# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Signed sentences in three CSV files: what is in them is read, what is wrong is named."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

from hri.core.errors import FormatError, IoError
from hri.core.files import MAX_BYTES
from hri.datasets.asl_sentences import SignedWord, read_asl_sentences
from hri.robot.imitation import read_hand_tracks

HANDS = "video,frame,left-x,left-y,right-x,right-y,nose-x,nose-y"
GOOD = {
    "signers.csv": "video,speaker\n7,ann\n2,bob\n",
    "words.csv": "video,speaker,word,startframe,endframe\n7,ann,JOHN,0,1\n2,bob,JOHN,0,0\n7,ann,WRITE,1,2\n",
    "hands.csv": f"{HANDS}\n7,0,1,2,3,4,5,6\n7,1,1,2,3,4,5,6\n2,0,-9,8,7,6,5,4\n7,2,11,12,13,14,15,16\n",
}


def write(folder: Path, **changed: str | bytes) -> Path:
    """The good files, with some replaced."""
    for name, text in GOOD.items():
        data = changed.get(name.removesuffix(".csv"), text)
        (folder / name).write_bytes(data if isinstance(data, bytes) else data.encode())
    return folder


def test_positions_words_and_signers_come_together(tmp_path: Path) -> None:
    ann, bob = read_asl_sentences(write(tmp_path))
    assert (ann.video, ann.signer, bob.video, bob.signer) == ("7", "ann", "2", "bob")
    assert ann.words == (SignedWord("JOHN", 0, 1), SignedWord("WRITE", 1, 2)) and bob.words == (
        SignedWord("JOHN", 0, 0),
    )
    assert ann.positions.dtype == np.float32 and ann.positions.shape == (3, 3, 2)
    assert ann.positions[2].tolist() == [[11, 12], [13, 14], [15, 16]]
    assert bob.positions.tolist() == [[[-9, 8], [7, 6], [5, 4]]]


def test_positions_may_lie_between_pixels_or_be_out_of_sight(tmp_path: Path) -> None:
    hands = GOOD["hands.csv"].replace("2,0,-9,8,7,6", "2,0,-9.25,8,,nan")
    _, bob = read_asl_sentences(write(tmp_path, hands=hands))
    np.testing.assert_array_equal(bob.positions, [[[-9.25, 8], [np.nan, np.nan], [5, 4]]])
    read = read_hand_tracks(tmp_path / "hands.csv")["2"]
    np.testing.assert_array_equal(np.hstack([read.left, read.right, read.nose]), bob.positions.reshape(-1, 6))


def test_windows_line_ends_and_a_byte_order_mark_are_read(tmp_path: Path) -> None:
    plain = read_asl_sentences(write(tmp_path))
    marked = {name.removesuffix(".csv"): ("\ufeff" + text).replace("\n", "\r\n") for name, text in GOOD.items()}
    for one, other in zip(plain, read_asl_sentences(write(tmp_path, **marked)), strict=True):
        assert (one.video, one.words) == (other.video, other.words)
        np.testing.assert_array_equal(one.positions, other.positions)


@pytest.mark.parametrize(
    ("file", "old", "new", "message"),
    [
        ("hands", "nose-y", "nose-z", "hands.csv: row 1: the columns are"),
        ("hands", "2,0,-9,8,7,6,5,4", "2,0,-9,8,7,6,5", "hands.csv: row 4: 7 fields, must be 8"),
        ("hands", "2,0,-9", "2,0,inf", "hands.csv: row 4, field left-x: 'inf' is no number within 65535"),
        ("hands", "2,0,-9", "2,0.5,-9", "row 4, field frame: '0.5' is no whole number"),
        ("hands", "2,0,-9", "2,0,٣", "row 4, field left-x: '٣' is no number within 65535"),
        ("hands", "2,0,-9", "2,0," + "9" * 5000, "row 4, field left-x: '9999"),
        ("hands", "2,0,-9", "2,0,99999999", "row 4, field left-x: '99999999' is no number within 65535"),
        ("hands", "2,0,-9", "2,1,-9", "row 4, field frame: 1, but the next frame of video '2' is 0"),
        ("hands", "7,2,11", "7,1,11", "row 5, field frame: 1, but the next frame of video '7' is 2"),
        ("hands", "2,0,-9", "3,0,-9", "row 4, field video: '3' is not in signers.csv"),
        ("hands", "2,0,-9", '"2,0,-9', "hands.csv: row 4: unexpected end of data"),
        ("hands", "2,0,-9", "2,0," + "x" * 200000, "hands.csv: row 4: field larger than field limit"),
        ("hands", "2,0,-9", "2,0,\x00", "row 4"),
        ("signers", "2,bob", "7,bob", "signers.csv: row 3, field video: '7' stands in an earlier row too"),
        ("signers", "2,bob", "2,", "signers.csv: row 3, field speaker: '' is no name"),
        ("signers", "2,bob", '2,"b\nob"', r"signers.csv: row 3, field speaker: 'b\nob' is no name"),
        ("signers", "2,bob\n", "2,bob\n3,eve\n", "no row of video '3', which signers.csv lists"),
        ("signers", "7,ann\n2,bob\n", "", "signers.csv: no rows"),
        (
            "words",
            "2,bob,JOHN,0,0",
            "2,ann,JOHN,0,0",
            "words.csv: row 3, field speaker: 'ann', but signers.csv says 'bob'",
        ),
        ("words", "2,bob,JOHN,0,0", "2,bob,,0,0", "words.csv: row 3, field word: '' is no name"),
        ("words", "2,bob,JOHN,0,0", "2,bob,JOHN,0,1", "words.csv: row 3, field endframe: 1, must be 0..0"),
        ("words", "7,ann,WRITE,1,2", "7,ann,WRITE,2,1", "words.csv: row 4, field endframe: 1, must be 2..2"),
        ("words", "7,ann,WRITE,1,2", "7,ann,WRITE,-1,2", "words.csv: row 4, field startframe: -1, must be 0..2"),
        ("words", "7,ann,WRITE,1,2", "7,ann,WRITE,1,2,", "words.csv: row 4: 6 fields, must be 5"),
    ],
)
def test_a_wrong_row_is_named_with_file_and_field(tmp_path: Path, file: str, old: str, new: str, message: str) -> None:
    good = GOOD[f"{file}.csv"]
    assert good.count(old) == 1
    with pytest.raises(FormatError) as caught:
        read_asl_sentences(write(tmp_path, **{file: good.replace(old, new)}))
    assert message in str(caught.value)
    assert f"{file}.csv" in str(caught.value)


def test_other_bytes_than_utf_8_and_empty_files_are_refused(tmp_path: Path) -> None:
    bad = GOOD["words.csv"].encode().replace(b"2,bob,JOHN", b"2,bob,J\xffHN")
    with pytest.raises(FormatError, match=r"words\.csv: row 3: not UTF-8"):
        read_asl_sentences(write(tmp_path, words=bad))
    with pytest.raises(FormatError, match=r"hands\.csv: no rows"):
        read_asl_sentences(write(tmp_path, hands=b""))


def test_files_that_are_missing_or_huge_are_not_read(tmp_path: Path) -> None:
    for number, name in enumerate(GOOD):
        folder = tmp_path / str(number)
        folder.mkdir()
        (write(folder) / name).unlink()
        with pytest.raises(IoError, match=name):
            read_asl_sentences(folder)
    with (write(tmp_path) / "hands.csv").open("r+b") as file:
        file.truncate(MAX_BYTES + 1)
    with pytest.raises(FormatError, match=r"hands\.csv: has 268435457 bytes"):
        read_asl_sentences(tmp_path)


@pytest.mark.data
def test_the_real_sentences() -> None:
    sentences = read_asl_sentences(Path(os.environ["HRI_DATA"]) / "asl_sentences")
    words = [word.label for sentence in sentences for word in sentence.words]
    assert (len(sentences), len(words), len(set(words))) == (161, 710, 112)
    assert {sentence.signer for sentence in sentences} == {"man-1", "woman-1", "woman-2"}
