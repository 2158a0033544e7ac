# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The command line: results on stdout, messages on stderr, exit codes, no traceback."""

from __future__ import annotations

import json
import re
import signal
import subprocess
import sys
import tomllib
from contextlib import contextmanager
from pathlib import Path

import cv2
import pytest

from conftest import QUICK, RATE_HZ, tone_word
from hri import _native
from hri.cli.answers import alternatives, confidence_text
from hri.cli.info import EXTRAS
from hri.cli.main import COMMANDS
from hri.cli.recognizers import parse_options
from hri.cli.session_screen import describe
from hri.core.errors import InvalidArgument
from hri.datasets import Dataset
from hri.fusion import FusedDecision
from hri.io import write_wav_pcm16
from hri.live import Event
from hri.recognition.decision import NO_INPUT, RECOGNISED, UNKNOWN, Decision, NBest
from hri.studies import STUDIES

pytestmark = pytest.mark.usefixtures("few_fillers")


def test_train_then_recognise_with_the_models_kept_per_user(hri, spoken: Path, signed: Path, tmp_path: Path):
    trained = hri("train", "speech", "--data", spoken)
    assert (trained.code, trained.out) == (0, f"{tmp_path / 'data' / 'hri' / 'speech.hri'}\n")
    assert "2 labels: 1 2" in trained.err
    assert hri("train", "gesture", "--data", signed).code == 0

    sign = next(sample.path for sample in Dataset.load(signed).samples if sample.label == "2")
    both = hri("recognise", "--speech", spoken / "2_low_0.wav", "--gesture", sign, "--json", "-")
    assert both.code == 0
    result = json.loads(both.out)
    assert (result["label"], result["status"]) == ("2", "recognised")
    assert result["rule"].startswith("table 6.9")
    assert {result["speech"]["label"], result["gesture"]["label"]} == {"2"}

    alone = hri("recognise", "--speech", spoken / "1_high_1.wav")
    label, confidence, rule = alone.out.strip().split("\t")
    assert label == "1" and 0.5 < float(confidence) <= 1 and rule.startswith("speech alone")
    assert "speech: 1 (1 " in alone.err


def test_robot_answers_on_film_and_rests_when_nothing_was_said(hri, spoken: Path, word_model: Path, tmp_path: Path):
    film, still = tmp_path / "answer.mp4", tmp_path / "answer.png"
    models = ("--speech-model", word_model)
    said = ("recognise", *models, "--speech", spoken / "1_low_0.wav", "--backend", "kinematic", "--robot")
    assert hri(*said, film).code == 0
    assert cv2.VideoCapture(str(film)).read()[0]
    assert hri(*said, still).code == 0
    assert cv2.imread(str(still)).shape == (480, 640, 3)

    silence = tmp_path / "silence.wav"
    write_wav_pcm16(str(silence), 0 * tone_word(500, 0, 0), RATE_HZ)
    none = tmp_path / "none.mp4"
    rests = hri("recognise", *models, "--speech", silence, "--robot", none, "--json", tmp_path / "r.json")
    assert rests.code == 0 and rests.out.startswith("no_input\t-\t")
    assert "robot: not moved" in rests.err and not none.exists()
    assert json.loads((tmp_path / "r.json").read_text())["robot"] == {"moved": False, "reason": "no_input"}


def test_the_confidence_of_a_label_that_was_rejected_is_not_shown_as_that_of_unknown() -> None:
    nbest = (NBest("7", 0.998, -1.0), NBest("4", 0.002, -9.0))
    rejected = Decision("speech", UNKNOWN, UNKNOWN, 0.998, nbest=nbest)
    assert (confidence_text(rejected), alternatives(rejected, 2)) == ("nearest: 7", "nearest: 7, 4")
    sure = Decision("speech", "7", RECOGNISED, 0.998, nbest=nbest)
    assert (confidence_text(sure), alternatives(sure, 2)) == ("0.998", "7 0.998, 4 0.002")
    nothing = Decision("speech", NO_INPUT, NO_INPUT, 0.0)
    assert (confidence_text(nothing), alternatives(nothing, 2)) == ("-", NO_INPUT)
    asked = FusedDecision("ask", "ask", 0.0, "stop", nbest=nbest)
    assert confidence_text(asked) == "0.000"
    decided = {"speech": rejected.to_dict(), "gesture": None, "final": "", "status": UNKNOWN, "rule": "r", "why": "w"}
    assert describe(Event(1.0, "fused", decided, mode="session")).endswith("s  unknown  (word unknown; r; w)")


def test_exit_codes_in_the_help_are_those_of_the_page(hri) -> None:
    page = (Path(__file__).resolve().parents[2] / "docs" / "command_line.md").read_text(encoding="utf-8")
    table = page.partition("| exit code |")[2].partition("\n\n")[0]
    written = {code for row in re.findall(r"^\| ([0-9, ]+) \|", table, re.MULTILINE) for code in row.split(", ")}
    shown = hri("--help").out.partition("Exit codes:")[2].partition("\n\n")[0]
    assert set(re.findall(r"\b[0-9]+\b", shown)) == written


def test_evaluate_by_person_and_by_folders(hri, spoken: Path, tmp_path: Path):
    picture, report = tmp_path / "confusion.png", tmp_path / "new" / "report.json"
    result = hri(
        *("evaluate", "speech", "--data", spoken, "--confusion", picture, "--json", report),
        *("--noise", "white", "--snr", "20", "--front-end", "cepstra", "--no-network"),
    )
    assert result.code == 0 and "%" not in result.err and "front end: cepstra" in result.err
    rows = [line.split("\t") for line in result.out.splitlines()]
    assert [row[0] for row in rows] == ["held out", "high", "low", "middle", "all"]
    assert rows[-1][2].startswith("100.0 % ± 0.0")
    assert cv2.imread(str(picture)) is not None
    written = json.loads(report.read_text())
    assert written["conditions"]["snr_db"] == 20 and written["num_samples"] == 18
    assert written["options"]["num_states"] > 0

    quick = ("--option", "num_states=4", "--option", "use_network=false", "--front-end", "cepstra")
    split = hri("evaluate", "speech", "--train", spoken, "--test", spoken, *quick)
    assert split.code == 0 and split.out.splitlines()[-1].startswith("all\t18\t100.0 %\t"), "no spread of one fold"
    assert "WARNING: in both folders: high low middle" in split.err


def test_evaluate_gestures_of_unseen_persons(hri, signed: Path):
    result = hri("evaluate", "gesture", "--data", signed, "--folds", "2", "--exposure", "0.5", "--json", "-")
    assert json.loads(result.out)["conditions"]["exposure"] == 0.5
    assert json.loads(result.out)["accuracy_mean"] >= 0.75


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["recognise"], "give a recording: --speech FILE, --gesture FILE, or both"),
        (["evaluate", "speech"], "give either --data DIR, or --train DIR and --test DIR"),
        (["evaluate", "speech", "--data", ".", "--noise", "white"], "--noise and --snr go together"),
        (["evaluate", "speech", "--data", ".", "--exposure", "0.5"], "--exposure is for gestures"),
        (["evaluate", "gesture", "--data", ".", "--noise", "pink", "--snr", "3"], "--noise is for speech"),
        (["study", "fsdd-noise", "--only", "white"], "--only 'white' is not AXIS=VALUE"),
        (["train", "smell", "--data", "."], "'smell' is not one of 'speech', 'gesture'"),
        (["nonsense"], "no command 'nonsense'"),
    ],
)
def test_wrong_usage_ends_with_2(hri, arguments: list[str], message: str):
    result = hri(*arguments)
    assert (result.code, result.out) == (2, "")
    assert message in result.err


def test_bad_data_ends_with_3_and_one_line(hri, tmp_path: Path, spoken: Path, word_model: Path):
    broken = tmp_path / "broken.wav"
    broken.write_bytes(b"RIFF but no more")
    (tmp_path / "data" / "hri").mkdir(parents=True)
    (tmp_path / "data" / "hri" / "speech.hri").write_bytes(word_model.read_bytes())
    for arguments, message in (
        (("recognise", "--speech", broken), "broken.wav"),
        (("recognise", "--gesture", broken), "run 'hri train gesture --data DIR'"),
        (("recognise", "--speech", spoken / "1_low_0.wav", "--speech-model", broken), "broken.wav"),
        (("train", "speech", "--data", tmp_path / "data"), "data"),
        (("train", "speech", "--data", spoken, "--option", "num_stats=4"), "num_states"),
        (("train", "speech", "--data", spoken, "--option", "num_states=few"), "num_states"),
        (("train", "speech", "--data", spoken, "--option", "num_states"), "NAME=VALUE"),
        (("study", "nonsense"), "no study 'nonsense'; there are: fsdd"),
        (("study", "fsdd"), "HRI_DATA"),
        (("study", "fsdd", "--data", tmp_path), "fsdd/recordings"),
        (("study", "fsdd", "--data", tmp_path, "--only", "noise=pink"), "there are: none"),
        (("study", "fsdd-noise", "--data", tmp_path, "--only", "noise=purple"), "white, pink, dishes, tap"),
        (("info", broken), "broken.wav"),
    ):
        result = hri(*arguments)
        assert (result.code, result.out) == (3, ""), arguments
        assert result.err.startswith("hri: error: ") and result.err.count("\n") == 1, result.err
        assert message in result.err


def test_study_list_names_every_study(hri):
    result = hri("study", "list")
    names = [line.split("\t")[0] for line in result.out.splitlines()]
    assert names == list(STUDIES) and "fsdd" in names
    assert all("target: " in line for line in result.out.splitlines())
    assert [study["name"] for study in json.loads(hri("study", "list", "--json", "-").out)] == names


def test_info_tells_of_the_installation_and_of_models(hri, spoken: Path, tmp_path: Path):
    assert f"version\t{_native.__version__}" in hri("info").out
    model = tmp_path / "words.hri"
    hri("train", "speech", "--data", spoken, "--out", model, "--option", "num_states=5", *QUICK)
    reported = hri("info", model).out.splitlines()
    assert "labels\t1 2" in reported and "option\tnum_states=5" in reported and "option\ttrim=true" in reported


@pytest.mark.parametrize("name", list(COMMANDS))
def test_help_teaches_by_example(hri, name: str):
    result = hri(name, "--help")
    assert result.code == 0
    assert f"hri {name}" in result.out.split("Usage:")[1].split("\n", 1)[1]


def test_version_and_bare_call(hri):
    assert hri("--version").out.strip().endswith(_native.__version__)
    assert all(name in hri("--help").out for name in COMMANDS)
    as_module = subprocess.run([sys.executable, "-m", "hri", "--version"], capture_output=True, text=True, check=True)
    assert as_module.stdout == hri("--version").out


def test_options_are_nested_and_typed():
    assert parse_options(("model=ptbhmm", "cepstra.num_filters=30", "trim=false", "vtlp_step=0.1")) == {
        "model": "ptbhmm",
        "cepstra": {"num_filters": 30},
        "trim": False,
        "vtlp_step": 0.1,
    }
    with pytest.raises(InvalidArgument, match="cepstra has a value"):
        parse_options(("cepstra=3", "cepstra.num_filters=30"))


def test_ctrl_c_while_training_ends_with_130_and_writes_nothing(
    hri, spoken: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    reported = []

    @contextmanager
    def interrupt_in_training():
        def report(what: str, done: int, total: int) -> None:
            reported.append(what)
            if what == "training" and reported.count("training") == 1:
                signal.raise_signal(signal.SIGINT)

        yield report

    monkeypatch.setattr("hri.cli.train.progress_bars", interrupt_in_training)
    model = tmp_path / "words.hri"
    result = hri("train", "speech", "--data", spoken, "--out", model)
    assert (result.code, result.out) == (130, "") and result.err.endswith("\nhri: interrupted\n")
    assert reported.count("training") == 1
    assert list(tmp_path.glob("*.hri*")) == []


def test_info_says_of_every_extra_whether_it_is_there(hri, monkeypatch: pytest.MonkeyPatch):
    project = tomllib.loads((Path(__file__).parents[2] / "pyproject.toml").read_text())["project"]
    extras = project["optional-dependencies"].keys() - {"all", "test", "bench", "docs", "coverage", "lint"}
    monkeypatch.setitem(EXTRAS, "live", ("no_such_package.microphones",))
    lines = dict(line.split("\t") for line in hri("info").out.splitlines() if line.startswith("extra "))
    assert lines.keys() == {f"extra {name}" for name in extras}
    assert lines["extra live"] == "no: pip install libhri[live]" and lines["extra cli"] == "yes"
