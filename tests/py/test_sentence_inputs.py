# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What signed sentences are trained on and counted by: wrong frames, words and numbers are named."""

from __future__ import annotations

from copy import copy

import numpy as np
import pytest

from hri.core.errors import InvalidArgument
from hri.recognition import SentenceRecognizer
from test_sentences import make_sentences, signed

SPAN = r"must be \(first_frame, last_frame\), got"
WORD = r"must be \(label, first_frame, last_frame\)"


@pytest.fixture(scope="module")
def signs() -> SentenceRecognizer:
    tracks, words = zip(*make_sentences(20), strict=True)
    return SentenceRecognizer().fit(tracks, words)


@pytest.mark.parametrize(
    ("spans", "message"),
    [
        ([(1.9, 12.9)], r"first_frame of spans\[0\] must be an integer, got 1\.9"),
        ([(1, 12), (20, float("nan"))], r"last_frame of spans\[1\] must be an integer, got nan"),
        ([(1, 2**40)], r"last_frame of spans\[0\] is 1099511627776, which is too large"),
        ([1, 2], rf"spans\[0\] {SPAN} 1"),
        ([(1, 2, 3)], rf"spans\[0\] {SPAN} \(1, 2, 3\)"),
        (["12"], rf"spans\[0\] {SPAN} '12'"),
        (5, r"spans must be a sequence of \(first_frame, last_frame\), got 5"),
    ],
)
def test_spans_that_are_no_frames_are_named(signs: SentenceRecognizer, spans: list, message: str) -> None:
    tracks, _ = signed(["BALL"], 1)
    for read in (signs.recognise_spans, signs.score_spans):
        with pytest.raises(InvalidArgument, match=f"^{message}"):
            read(tracks, spans)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ([("a", 5.7, 15.2)], r"first_frame of y\[1\]\[0\] must be an integer, got 5\.7"),
        ([("a", 5, float("nan"))], r"last_frame of y\[1\]\[0\] must be an integer, got nan"),
        ([("a", 5)], rf"y\[1\]\[0\] {WORD}, got \('a', 5\)"),
        (["a", "b"], rf"y\[1\]\[0\] {WORD}, got 'a'"),
        ("a b", r"y\[1\] must be a sequence of \(label, first_frame, last_frame\), got 'a b'"),
        ([("a", 5, 9), (None, 12, 15)], r"y\[1\]\[1\] must be text, got None"),
    ],
)
def test_words_that_are_no_labels_with_frames_are_named(words: list, message: str) -> None:
    tracks, spans = signed(["BALL", "CAT"], 1)
    with pytest.raises(InvalidArgument, match=f"^{message}"):
        SentenceRecognizer().fit([tracks] * 2, [spans, words])


def test_what_is_no_number_is_named(signs: SentenceRecognizer) -> None:
    tracks, spans = signed(["BALL", "CAT"], 1)
    with pytest.raises(InvalidArgument, match=r"^count must be an integer, got 2\.9"):
        signs.recognise_n_best(tracks, 2.9)
    ragged = [[1.0] * 6, [1.0] * 5]
    for values in (ragged, "tracks.csv", [["a"] * 6]):
        with pytest.raises(InvalidArgument, match=r"^tracks must be an array of numbers"):
            signs.recognise(values)
        with pytest.raises(InvalidArgument, match=r"^X\[1\] must be an array of numbers"):
            SentenceRecognizer(input="rows").fit([tracks.reshape(-1, 6), values], [spans] * 2)
    np.testing.assert_array_equal(
        signs.score_spans(tracks, np.array([(first, last) for _, first, last in spans])),
        signs.score_spans(tracks, [(first, last) for _, first, last in spans]),
    )


def test_errors_are_counted_of_words_alone(signs: SentenceRecognizer, monkeypatch: pytest.MonkeyPatch) -> None:
    tracks, spans = signed(["DOG", "CAT"], 31)
    assert signs.count_errors([tracks], [np.array(["DOG", "CAT"])]).rate == 0
    monkeypatch.setattr(SentenceRecognizer, "recognise", None)
    for y, scales, message in (
        ([spans], None, r"y\[0\]\[0\] must be text, got \('DOG'"),
        (["DOG CAT"], None, r"y\[0\] must be a sequence of texts"),
        ([["DOG"], ["CAT"]], None, "X, y and scales_px differ in length: 1, 2, 1"),
        ([["DOG"]], [1.0, 2.0], "X, y and scales_px differ in length: 1, 1, 2"),
        (None, None, "y must be a sequence"),
    ):
        with pytest.raises(InvalidArgument, match=f"^{message}"):
            signs.count_errors([tracks], y, scales)


def test_options_set_after_training_are_for_the_next(signs: SentenceRecognizer) -> None:
    tracks, _ = signed(["BALL"], 1)
    changed = copy(signs).set_params(input="rows")
    assert changed.recognise(tracks) == signs.recognise(tracks)
