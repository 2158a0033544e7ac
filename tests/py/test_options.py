# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Options: every field stands in one list in C++, and Python, stubs, docs, the command line and files take it there."""

from __future__ import annotations

import copy
import math
import pickle
import re
from pathlib import Path
from typing import Any, get_type_hints

import pytest

import hri
from hri import _native, _native_vision
from hri.cli.options import CHOSEN_BY_TRAIN, option_table
from hri.cli.recognizers import CLASSES, recognizer_factory
from hri.core.errors import InvalidArgument
from hri.recognition import keywords

ROOT = Path(__file__).resolve().parents[2]
CLASSES_WITH_FIELDS = sorted(
    {c for m in (_native, _native_vision) for c in vars(m).values() if hasattr(c, "fields")}, key=lambda c: c.__name__
)
# Structs whose functions take their fields as plain arguments, or that other structs are made into.
ONLY_CPP = {"HmmStreamOptions", "FewSampleOptions", "MapAdaptationOptions", "AdaptationOptions"}
WRONG = {"int": "few", "float": "far", "str": 3, "bool": "maybe"}
every_class = pytest.mark.parametrize("options_class", CLASSES_WITH_FIELDS, ids=lambda c: c.__name__)


def structs_of_the_headers() -> set[str]:
    """Every struct that lists its fields in a public header."""
    texts = [path.read_text(encoding="utf-8") for path in (ROOT / "cpp/include/hri").rglob("*.hpp")]
    texts = [re.sub(r"^ *//.*", "", text, flags=re.MULTILINE) for text in texts]
    return {name for text in texts for name in re.findall(r'kName = "(\w+)"', text)}


def test_every_struct_is_listed_bound_and_tested() -> None:
    headers = [path.read_text(encoding="utf-8") for path in (ROOT / "cpp/include/hri").rglob("*.hpp")]
    structs = {n for text in headers for n in re.findall(r"^struct (?:HRI_API )?(\w+Options)\b", text, re.MULTILINE)}
    assert structs <= structs_of_the_headers(), "a struct without visit()"
    assert {c.__name__ for c in CLASSES_WITH_FIELDS} | ONLY_CPP == structs_of_the_headers()
    tests = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "tests/cpp").rglob("*options_test.cpp"))
    assert {name for name in structs_of_the_headers() if not re.search(rf"\b{name}\b", tests)} == set()


@every_class
def test_every_field_stands_in_the_stub_the_docstring_and_the_table(options_class: Any) -> None:
    name = options_class.__name__
    stub = "".join(
        (ROOT / "python/hri" / f"{m}.pyi").read_text(encoding="utf-8") for m in ("_native", "_native_vision")
    )
    body = re.search(rf"^class {name}:\n(.*?)^(?=\S)", stub, re.DOTALL | re.MULTILINE)
    assert body is not None
    constructor = re.search(r"def __init__\((.*?)\) -> None", body[1], re.DOTALL)
    assert constructor is not None
    section = (ROOT / "docs/options.md").read_text(encoding="utf-8").split(f"\n## {name}\n")[1].split("\n## ")[0]
    for field in options_class.fields():
        assert re.search(rf"\b{field.name}: (?!typing\.Any\b)", constructor[1]), f"{field.name} has no typed keyword"
        assert f"\n{field.name} : " in options_class.__doc__
        assert field.description in options_class.__doc__ and f"| `{field.name}` |" in section
        assert field.range or field.type in ("bool", "str") or field.choices or field.options, field.name


@every_class
def test_as_dict_copies_and_pickles_give_the_same_options(options_class: Any) -> None:
    options = options_class()
    assert options_class(**options.as_dict()) == options
    assert [field.name for field in options_class.fields()] == list(options.as_dict())
    assert repr(options) == f"{options_class.__name__}()"
    changed = next((f for f in options_class.fields() if f.type == "bool"), None)
    if changed is not None:
        setattr(options, changed.name, not changed.default)
        assert repr(options) == f"{options_class.__name__}({changed.name}={not changed.default})"
        assert options != options_class()
    for twin in (copy.copy(options), copy.deepcopy(options), pickle.loads(pickle.dumps(options))):
        assert twin == options and twin is not options
    assert options != 3


@every_class
def test_values_outside_are_refused_by_the_constructor_and_by_attributes(options_class: Any) -> None:
    for field in options_class.fields():
        if field.options is not None:
            with pytest.raises(TypeError, match=f"{field.name} must be {field.options.__name__} or a dict"):
                options_class(**{field.name: 3})
            continue
        full = f"{options_class.__name__}.{field.name}"
        wrong: list[tuple[type[Exception], Any]] = [(TypeError, WRONG.get(field.type, 3)), (TypeError, None)]
        if field.type == "float":
            wrong += [(InvalidArgument, value) for value in (math.nan, -math.inf, -1e308, 1e308)]
        elif field.type == "int":
            wrong += [(InvalidArgument, value) for value in (-(2**40), 2**70)]
            wrong += [(TypeError, value) for value in (1.5, True)]
        elif field.choices:
            wrong += [(InvalidArgument, "nothing of that name")]
        for error, value in wrong:
            with pytest.raises(error, match=full):
                options_class(**{field.name: value})
            options = options_class()
            with pytest.raises(error, match=full):
                setattr(options, field.name, value)
            assert options == options_class(), "what was refused changed nothing"


def test_recognisers_refuse_options_when_they_are_made() -> None:
    with pytest.raises(InvalidArgument, match=r"CepstraOptions\.num_filters must lie in 1\.\.512, got -1"):
        hri.WordRecognizerOptions(cepstra={"num_filters": -1})
    with pytest.raises(InvalidArgument, match=r"WordRecognizerOptions\.num_states must lie in 1\.\.64, got 0"):
        hri.WordRecognizer(num_states=0)
    with pytest.raises(InvalidArgument, match=r"must be one of 'svm', .*, got 'hmmm'"):
        hri.GestureRecognizer(model="hmmm")  # type: ignore[arg-type]
    with pytest.raises(InvalidArgument, match=r"ActivityOptions\.padding_ms"):
        hri.WordRecognizer(activity={"padding_ms": -1e308})


def test_fields_that_do_not_go_together_are_refused() -> None:
    with pytest.raises(InvalidArgument, match="WordRecognizerOptions: min_snr_db must not exceed max_snr_db"):
        hri.WordRecognizer(min_snr_db=30.0)
    with pytest.raises(InvalidArgument, match="CepstraOptions: num_cepstra must be less than num_filters"):
        _native.CepstraOptions(num_cepstra=26)
    with pytest.raises(InvalidArgument, match="high_hz must not exceed half the sample rate"):
        _native.CepstraOptions(high_hz=9000.0)


def test_every_class_is_offered_by_a_room() -> None:
    rooms = (hri.signal, hri.features, hri.models, hri.language, hri.htk, hri.vision, hri.recognition)
    offered = {name for room in rooms for name in room.__all__}
    assert {options_class.__name__ for options_class in CLASSES_WITH_FIELDS} - offered == set()


@pytest.mark.parametrize("recognizer_class", [hri.WordRecognizer, hri.GestureRecognizer])
def test_words_and_gestures_nest_alike(recognizer_class: Any) -> None:
    recognizer = recognizer_class(model="hmm", num_states=7)
    assert (recognizer.options.model, recognizer.options.num_states) == ("hmm", 7)
    assert recognizer.get_params()["num_states"] == 7


def test_a_dict_changes_only_what_it_names() -> None:
    options = hri.WordRecognizerOptions(cepstra={"num_filters": 30}, activity={"max_gap_ms": 200})
    assert (options.cepstra.num_filters, options.cepstra.sample_rate_hz) == (30, 0)
    assert (options.activity.max_gap_ms, options.activity.padding_ms) == (200, 60)
    assert repr(options) == "WordRecognizerOptions(cepstra={'num_filters': 30}, activity={'max_gap_ms': 200.0})"
    options.cepstra.num_filters = 40
    assert options.cepstra.num_filters == 40, "a nested object is the field itself"
    options.cepstra = _native.CepstraOptions()
    assert options.cepstra.sample_rate_hz == 16000


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("num_stats", "did you mean 'num_states'"),
        ("num_filters", r"a field of cepstra: cepstra=\{'num_filters'"),
        ("xyz", "Its fields are"),
    ],
)
def test_unknown_names_are_refused_with_a_hint(name: str, hint: str) -> None:
    with pytest.raises(TypeError, match=f"WordRecognizerOptions has no field '{name}'.*{hint}"):
        hri.WordRecognizer(**{name: 4})  # type: ignore[misc]
    with pytest.raises(InvalidArgument, match=f"--option: .*{hint}"):
        recognizer_factory("speech", (f"{name}=4",), seed=0)


@pytest.mark.parametrize("mode", list(CLASSES))
def test_the_command_line_knows_every_field(mode: str, hri: Any) -> None:
    options_class = type(CLASSES[mode]().options)
    printed = hri("options", mode).out
    rows = list(option_table(options_class))
    train = {line.split("=")[0] for line in printed.splitlines() if "\t'hri train' takes " in line}
    assert train == set(CHOSEN_BY_TRAIN[mode]) <= {row["name"] for row in rows}
    for row in rows:
        assert f"{row['name']}={row['default']}\t" in printed and row["description"] in printed

    def names(fields: Any, prefix: str = "") -> list[str]:
        return [
            name
            for f in fields
            for name in (names(f.options.fields(), f"{prefix}{f.name}.") if f.options else [prefix + f.name])
        ]

    assert [row["name"] for row in rows] == names(options_class.fields())
    defaults = tuple(f"{row['name']}={row['default']}" for row in rows)
    assert recognizer_factory(mode, defaults, seed=0)().options == options_class(), "as printed, so taken"


@pytest.mark.parametrize("options_class", [_native.WordRecognizerOptions, _native.GestureRecognizerOptions])
def test_typed_keywords_are_the_fields(options_class: Any) -> None:
    typed = getattr(keywords, options_class.__name__.replace("Options", "Keywords"))
    assert list(get_type_hints(typed)) == [field.name for field in options_class.fields()]
