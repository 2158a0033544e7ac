# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The knowledge base of sentences, from Python and from the command line."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from hri.core.errors import FormatError, InvalidArgument
from hri.language import KnowledgeBase, StoredSentence, choose_max_distance

HOME = StoredSentence(
    ("YOUR", "HOME", "BIG", "SMALL"), {"en": "Is your home big or small?", "hi": "आपका घर बड़ा है या छोटा?"}
)
SAD = StoredSentence(("YOU", "SAD", "WHY"), {"en": "Why are you sad?"})
AGREE = StoredSentence(("I", "AGREE"))


def test_words_that_are_stored_are_at_no_distance() -> None:
    base = KnowledgeBase([HOME, SAD, AGREE], max_distance=0)
    for stored in (HOME, SAD, AGREE):
        match = base.match(stored.words)
        assert match is not None and (match.sentence, match.distance) == (stored, 0)


def test_the_distance_is_that_of_the_edits() -> None:
    base = KnowledgeBase([SAD], costs=(4, 3, 2))
    assert base.nearest(["YOU", "SAD", "HOW"]).distance == pytest.approx(4 / (4 * 3))
    assert base.nearest(["YOU", "SAD"]).distance == pytest.approx(3 / (4 * 2 + 3))
    assert base.nearest(["YOU", "VERY", "SAD", "WHY"]).distance == pytest.approx(2 / (4 * 3 + 2))
    assert KnowledgeBase([SAD]).nearest(["WHY"]).distance == pytest.approx(6 / (4 + 3 * 2))


@pytest.mark.parametrize("costs", [(4, 3, 3), (4, 3, 2), (9, 2, 3)])
def test_words_without_any_in_common_are_as_far_as_can_be(costs: tuple[int, int, int]) -> None:
    base = KnowledgeBase([HOME], costs=costs)
    for found in ([], ["X"], ["X", "Y", "Z", "W"], list("ABCDEFGH")):
        assert base.nearest(found).distance == 1


def test_alternatives_may_be_nearer_than_what_was_recognised() -> None:
    base = KnowledgeBase([HOME, SAD, AGREE], max_distance=0.3)
    found, others = ["YOU", "GLAD", "HOW"], [["I", "AGREE", "TOO"], ["YOU", "SAD", "WHY"], ["I", "AGREE"]]
    assert base.match(found) is None
    assert base.nearest(found, others).sentence is SAD  # as near as the last, and before it
    match = base.match(found, others)
    assert match is not None and match.distance == 0
    assert base.nearest(found, others[:1]).sentence is AGREE
    with pytest.raises(InvalidArgument, match="split it"):
        base.nearest(found, ["I AGREE"])  # type: ignore[list-item]


def test_far_words_and_unknown_words_are_none_of_them() -> None:
    base = KnowledgeBase([HOME, SAD, AGREE], max_distance=0.4)
    near = base.match(["YOUR", "HOME", "BIG"])
    assert near is not None and near.sentence is HOME
    unknown_word = base.match(["YOU", "SAD", "BECAUSE"])
    assert unknown_word is not None and unknown_word.sentence is SAD
    assert base.match(["OLD", "KEYS", "RUST"]) is None
    assert base.match([]) is None


def test_words_that_no_recogniser_knows_are_named_with_those_that_differ_in_case() -> None:
    base = KnowledgeBase([SAD, AGREE, HOME])
    labels = ["you", "SAD", "I", "YOUR", "HOME", "BIG", "SMALL", "sad"]
    assert base.unknown_words(labels) == {"YOU": "you", "WHY": None, "AGREE": None}


def test_texts_are_given_by_language() -> None:
    assert HOME.text("hi") == "आपका घर बड़ा है या छोटा?"
    assert SAD.text("hi") == "YOU SAD WHY" and AGREE.text() == "I AGREE"


def test_the_largest_distance_divides_right_from_wrong() -> None:
    assert choose_max_distance([0, 0.1, 0.2], [0.5, 0.6]) == 0.2
    assert choose_max_distance([0, 0.1, 0.9], [0.5, 0.6]) == 0.1
    assert choose_max_distance([], [0.3]) == 0.0
    with pytest.raises(InvalidArgument, match="no distance"):
        choose_max_distance([], [])


def test_what_is_no_knowledge_base_is_refused() -> None:
    with pytest.raises(InvalidArgument, match="there is none"):
        KnowledgeBase([])
    with pytest.raises(InvalidArgument, match="stored twice"):
        KnowledgeBase([SAD, StoredSentence(SAD.words)])
    with pytest.raises(InvalidArgument, match="needs words"):
        KnowledgeBase([StoredSentence(())])
    for bad in (-0.1, 1.1, float("nan")):
        with pytest.raises(InvalidArgument, match="max_distance"):
            KnowledgeBase([SAD], max_distance=bad)
    with pytest.raises(InvalidArgument, match="costs"):
        KnowledgeBase([SAD], costs=(1, 2, 3))
    with pytest.raises(InvalidArgument, match="split it"):
        KnowledgeBase([SAD]).match("YOU SAD WHY")


def test_a_file_gives_sentences_with_their_texts(tmp_path: Path) -> None:
    path = tmp_path / "stored.csv"
    path.write_text('signs,en,hi\nYOU SAD WHY,"Why, you, are you sad?",\nI AGREE,,मैं सहमत हूँ\n', "utf-8")
    base = KnowledgeBase.read(path, max_distance=0.2)
    assert [s.words for s in base.sentences] == [("YOU", "SAD", "WHY"), ("I", "AGREE")]
    assert base.sentences[0].text() == "Why, you, are you sad?" and base.sentences[1].text("hi") == "मैं सहमत हूँ"
    assert base.max_distance == 0.2


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "row 1: the columns must be 'signs'"),
        ("words,en\nA,b\n", "row 1: the columns must be 'signs'"),
        ("signs,en,en\nA,b,c\n", "row 1: the columns must be 'signs'"),
        ("signs,en\n", "no rows"),
        ("signs,en\nA,b\nB\n", "row 3: must have 2 cells"),
        ("signs,en\n ,b\n", "row 2: must have 2 cells, and words"),
        ("signs,en\nA B,b\nA  B,c\n", "row 3: 'A B' stands in an earlier row too"),
        ('signs,en\nA,"b\x07"\n', "row 2: control characters"),
    ],
)
def test_a_file_that_is_none_is_named(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "stored.csv"
    path.write_text(text, "utf-8")
    with pytest.raises(FormatError, match=message) as caught:
        KnowledgeBase.read(path)
    assert str(path) in str(caught.value)


def test_espeak_says_sentences_in_both_languages() -> None:
    if shutil.which("espeak-ng") is None:
        pytest.skip("espeak-ng is not installed")
    from hri.synthetic.speech import speak

    for language in ("en", "hi"):
        audio = speak(HOME.text(language), language)
        assert len(audio.samples) > audio.sample_rate_hz  # longer than a second
