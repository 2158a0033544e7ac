# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Texts for people are in one table, in English and Hindi, and none stands elsewhere on the page."""

from __future__ import annotations

import copy
import json
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from hri.core.errors import FormatError
from hri.core.phrases import LANGUAGES, Phrase, in_language, phrase, phrase_of, phrases
from hri.language import KnowledgeBase, StoredSentence
from hri.page import component
from hri.recognition.decision import plain
from hri.session import Dialogue, SessionOptions

PYTHON = Path(__file__).resolve().parents[2] / "python/hri"
SCRIPTS = [*sorted((PYTHON / "serve/page").glob("*.js")), *sorted((PYTHON / "page").glob("*.js"))]
PAGE = PYTHON / "serve/page/index.html"
CONSTRUCTED = ("missing_", "state_", "status_", "no_")  # in codes that scripts make of names
PLACE = re.compile(r"\{(\w+(?:\|\w+)?)\}")
COMMENT = re.compile(r"^\s*//.*$|(?<=[;{}()\s]) // .*$", re.MULTILINE)
LITERAL = re.compile(r'"([^"\n]*)"|\'([^\'\n]*)\'|`([^`]*)`')


def test_every_text_is_in_both_languages_with_the_same_places() -> None:
    for code, texts in phrases().items():
        assert tuple(texts) == LANGUAGES == ("en", "hi"), code
        places, in_hindi = (set(PLACE.findall(texts[language])) for language in LANGUAGES)
        assert in_hindi <= places and places - in_hindi <= {"device", "noun"}, code
        assert not re.search("[\u0900-\u097f]", texts["en"]), code
        named = re.sub(r"hri|C\+\+|JSON", "", PLACE.sub("", texts["en"]))
        if re.search("[A-Za-z]", named):
            assert re.search("[\u0900-\u097f]", texts["hi"]), code
        for place in PLACE.findall(texts["en"]):
            _, _, joint = place.partition("|")
            assert not joint or joint in phrases(), code


def test_every_code_that_is_used_is_there_and_every_text_is_used() -> None:
    sources = [p.read_text(encoding="utf-8") for p in (*PYTHON.rglob("*.py"), *SCRIPTS, PAGE)]
    used = {code for text in sources for code in re.findall(r'\b(?:phrase|inWords)\(\s*"(\w+)"', text)}
    used |= {code for text in sources for code in re.findall(r'data-(?:text|label)="(\w+)"', text)}
    assert used - set(phrases()) == set()
    quoted = {code for text in sources for code in re.findall(r'["\'](\w+)["\']', text)}
    joints = {place.partition("|")[2] for texts in phrases().values() for place in PLACE.findall(texts["en"])}
    left = set(phrases()) - used - quoted - joints
    assert {code for code in left if not code.startswith(CONSTRUCTED)} == set()


def test_no_text_stands_on_the_page_itself() -> None:
    html = re.sub(r"<!--.*?-->", "", PAGE.read_text(encoding="utf-8"), flags=re.DOTALL)
    assert [text for text in re.findall(r">([^<]*)<", html) if text.strip()] == []
    assert re.findall(r"(?:aria-label|title|placeholder|alt)=", html) == []
    for script in SCRIPTS:
        assert list(texts_in(script.read_text(encoding="utf-8"))) == [], script.name


@pytest.mark.parametrize(
    "script",
    ['line.textContent = "Speak now.";', "show(`Sample ${count} of three`);", 'button.textContent = "Undo";'],
)
def test_a_text_in_a_script_is_seen(script: str) -> None:
    assert len(list(texts_in(script))) == 1
    assert list(texts_in('at("log").querySelector("[data-part=line] p"); // the next line of it\n')) == []


def texts_in(script: str) -> Iterator[str]:
    """Literals of a script that look like text for people: words in a row, or a word that begins as sentences do."""
    for found in LITERAL.finditer(COMMENT.sub("", script)):
        text = re.sub(r"\$\{[^}]*\}", "1", next(one for one in found.groups() if one is not None))
        if text == "Escape" or re.search(r"[\[\]<>#=]", text):  # a key, and selectors
            continue
        if re.search(r"[A-Za-z]{2,} [A-Za-z0-9]+ [A-Za-z]|[a-z]{2,}[.:!?]$|^[A-Z][a-z]+( [a-z]+)*\.?$", text):
            yield text


def test_the_page_gets_the_table_as_a_script() -> None:
    script = component("table.js").decode()
    assert json.loads(script.removeprefix("export const PHRASES = ").removesuffix(";\n")) == phrases()


def test_a_phrase_is_its_english_text_and_is_said_in_hindi() -> None:
    asked = phrase("did_you_mean", labels=["stop", "five"])
    assert asked == "Did you mean stop or five?" and isinstance(asked, str)
    assert in_language(asked.code, "hi", asked.values) == "क्या आपका मतलब stop या five था?"
    nested = phrase("rule_table", case=phrase("case_one_above", mode=phrase("gesture")))
    assert nested == "table 6.9: only gesture above its threshold"
    assert in_language("rule_table", "hi", nested.values) == "सारणी 6.9: केवल इशारा अपनी सीमा से ऊपर"
    assert json.loads(json.dumps(nested.to_dict()))["values"]["case"]["values"]["mode"]["code"] == "gesture"
    kept = copy.deepcopy(plain({"rule": nested}))["rule"]
    assert isinstance(kept, Phrase) and (kept.code, kept.values) == (nested.code, nested.values)
    assert phrase_of(FormatError(asked)) is asked and phrase_of(FormatError("rate")) == "rate"
    with pytest.raises(KeyError):
        phrase("no_such_text")


def test_a_stored_sentence_is_said_in_the_languages_that_it_has() -> None:
    stored = StoredSentence(("7", "1"), {"en": "Are you sad?", "hi": "क्या तुम उदास हो?"})
    dialogue = Dialogue(SessionOptions(), knowledge=KnowledgeBase([stored]))
    (said,) = [action.text for action in dialogue.signed(["7", "1"], 0.0, 2.0) if action.kind == "say"]
    assert said == "Are you sad?" and isinstance(said, Phrase)
    assert in_language(said.code, "hi", said.values) == "क्या तुम उदास हो?"
    assert in_language("stored", "hi", {"texts": {"de": "Bist du traurig?"}}) == "Bist du traurig?"
