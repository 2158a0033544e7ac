# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The command line when something is wrong: one line on stderr, the right exit code, and no work done in vain."""

from __future__ import annotations

import io
import json
import os
import re
import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from conftest import QUICK
from hri import studies
from hri.cli import main as cli_main
from hri.cli.output import say_table
from hri.cli.progress import progress_bars
from hri.cli.recognizers import recognizer_factory
from hri.io import ModelFile

pytestmark = pytest.mark.usefixtures("few_fillers")


class Terminal(io.StringIO):
    """A stream that says it is a terminal."""

    def isatty(self) -> bool:
        return True


def run_python(code: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=os.environ, check=False)


@pytest.mark.parametrize(
    ("arguments", "option"),
    [
        (("evaluate", "speech", "--confusion", "c.xyz"), "--confusion"),
        (("evaluate", "speech", "--confusion", "{file}/c.png"), "--confusion"),
        (("evaluate", "speech", "--json", "{file}/result.json"), "--json"),
        (("train", "speech", "--out", "{file}/words.hri"), "--out"),
        (("train", "speech", "--out", "{folder}"), "--out"),
    ],
)
def test_places_that_cannot_be_written_are_refused_before_the_work(
    hri, monkeypatch: pytest.MonkeyPatch, spoken: Path, tmp_path: Path, arguments: tuple[str, ...], option: str
):
    monkeypatch.setattr("hri.datasets.Dataset.load", lambda *_: pytest.fail("the recordings were read"))
    (tmp_path / "file").touch()
    places = {"file": tmp_path / "file", "folder": tmp_path}
    result = hri(*(argument.format(**places) for argument in arguments), "--data", spoken)
    assert (result.code, result.out) == (2, "")
    assert result.err.startswith(f"hri: error: Invalid value for '{option}'") and result.err.count("\n") == 1


@pytest.mark.parametrize(
    "arguments", ["train speech", "train gesture", "train-connected", "train-units", "train-sentences"]
)
def test_the_place_where_models_are_kept_is_looked_at_before_the_work(
    hri, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, arguments: str
):
    monkeypatch.setattr("hri.datasets.Dataset.load", lambda *_: pytest.fail("the recordings were read"))
    (tmp_path / "data").touch()  # in place of the user's folder of data
    result = hri(*arguments.split(), "--data", tmp_path)
    assert (result.code, result.out) == (2, "")
    assert f"cannot be written: '{tmp_path / 'data'}' is not a folder where you may write" in result.err
    assert "name a file with --out" in result.err


def test_a_model_that_cannot_be_replaced_is_not_read(hri, monkeypatch: pytest.MonkeyPatch, word_model: Path):
    monkeypatch.setattr("os.access", lambda _, mode: mode != os.W_OK)  # as of a folder of another user
    for command in (("add-word", word_model), ("remove-word",), ("add-gesture", word_model)):
        result = hri(*command, "--model", word_model, "--label", "1")
        assert result.code == 2 and f"'{word_model}' cannot be replaced" in result.err, result.err


def test_usage_errors_are_one_line_that_names_the_help(hri):
    for arguments, place in (("train", "hri train"), ("robot nonsense", "hri robot"), ("nonsense", "hri")):
        result = hri(*arguments.split())
        assert result.code == 2 and result.err.count("\n") == 1
        assert result.err.endswith(f"(see '{place} --help')\n")


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        ("session --model m.hri", ("--speech-model", "--gesture-model")),
        ("session --device 1", ("--microphone", "--camera")),
        ("recognise --model m.hri", ("--speech-model", "--gesture-model")),
        ("listen --microphone 1", ("--device",)),
        ("watch --gesture-model m.hri", ("--model",)),
        ("listen --json f", ("--json-lines",)),
    ],
)
def test_the_name_that_other_commands_have_for_an_option_is_answered_with_its_own(
    hri, arguments: str, named: tuple[str, ...]
):
    result = hri(*arguments.split())
    meant = result.err.partition("Did you mean")[2]
    assert result.code == 2 and re.findall(r"--[a-z-]+", meant.partition("?")[0]) == list(named), result.err


def test_choices_that_an_option_does_not_have_are_listed(hri, spoken: Path):
    result = hri("train", "speech", "--data", spoken, "--option", "model=hmmm")
    assert result.code == 3
    assert result.err.startswith("hri: error: --option: ") and "'ptbhmm'" in result.err


def test_what_nobody_foresaw_is_one_line_too(hri, monkeypatch: pytest.MonkeyPatch, spoken: Path):
    def fail(*_: object) -> None:
        raise ZeroDivisionError("by\nzero")

    monkeypatch.setattr("hri.datasets.Dataset.load", fail)
    result = hri("train", "speech", "--data", spoken)
    assert result.code == cli_main.EXIT_UNEXPECTED == 70
    assert result.err == "hri: error: unexpected ZeroDivisionError: by zero (HRI_TRACEBACK=1 shows where)\n"
    monkeypatch.setenv("HRI_TRACEBACK", "1")
    with pytest.raises(ZeroDivisionError):
        hri("train", "speech", "--data", spoken)


def test_a_missing_extra_is_named_before_the_work(hri, monkeypatch: pytest.MonkeyPatch, spoken: Path):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    result = hri("evaluate", "speech", "--data", spoken, "--confusion", "c.png")
    assert (result.code, result.out) == (3, "")
    assert "pip install libhri[plots]" in result.err and result.err.count("\n") == 1


def test_a_command_that_does_not_load_troubles_no_other(hri, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setitem(cli_main.COMMANDS, "demo", ("hri.nowhere:demo", "Not there."))
    assert hri("--help").code == 0 and hri("study", "list").code == 0
    result = hri("demo")
    assert result.code == 3 and "hri.nowhere" in result.err and result.err.count("\n") == 1


def test_help_loads_no_recogniser_and_no_library_for_media():
    result = run_python(
        "import sys; from hri.cli.main import main; main(['--help']); "
        "print([m for m in ('cv2', 'rich', 'matplotlib', 'pybullet', 'hri.recognition') if m in sys.modules])"
    )
    assert result.stdout.splitlines()[-1] == "[]"


@pytest.mark.parametrize("change", [signal.SIG_UNBLOCK, signal.SIG_BLOCK])
def test_output_to_a_program_that_ends_early_ends_silently(change: signal.Sigmasks):
    code = "from hri.cli.main import run; import sys; sys.argv[1:] = ['robot', 'joints']; run()"
    before = signal.pthread_sigmask(change, {signal.SIGPIPE})  # which the process inherits
    try:
        with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
            assert process.stdout is not None and process.stderr is not None
            process.stdout.close()
            assert process.stderr.read() == b""
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
    assert process.returncode == -signal.SIGPIPE


@pytest.mark.parametrize("is_ignored", [False, True])
@pytest.mark.parametrize("module", ["click", "hri.cli.groups", "hri.cli.robot", "hri.robot"])
def test_an_interrupt_while_modules_are_loaded_is_one_too(module: str, is_ignored: bool):
    """Sent just before this module is looked for: by the entry point, by the command line, or by a command."""
    code = f"""
import os, signal, sys
class Interrupting:
    def find_spec(self, name, path=None, target=None):
        if name == {module!r}:
            os.kill(os.getpid(), signal.SIGINT)
sys.meta_path.insert(0, Interrupting())
sys.argv[1:] = ["robot", "joints"]
if {is_ignored}:  # as of what a shell runs in the background
    signal.signal(signal.SIGINT, signal.SIG_IGN)
from hri.cli.entry import run
run()
"""
    result = run_python(code)
    expected = (0, "") if is_ignored else (130, "\nhri: interrupted\n")
    assert (result.returncode, result.stderr) == expected and bool(result.stdout) is is_ignored


@pytest.mark.parametrize(("passed", "code"), [(True, 0), (False, 1)])
def test_a_study_that_misses_its_target_ends_with_1(
    hri, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, passed: bool, code: int
):
    found = {"accuracy_mean": 0.5, "accuracy_std": 0.1, "passed": passed}

    def run(data: Path, progress: object) -> dict[str, object]:
        return found

    run.__module__ = studies.STUDIES["fsdd"].run.__module__  # the code that a study is said to measure
    study = replace(studies.STUDIES["fsdd"], data=(), run=run)
    monkeypatch.setitem(studies.STUDIES, "fsdd", study)
    result = hri("study", "fsdd", "--data", tmp_path)
    assert result.code == code
    assert result.out.splitlines() == [
        "accuracy\t50.0 % ± 10.0",
        f"target\t{study.target}",
        f"passed\t{'yes' if passed else 'no'}",
    ]
    assert ("did not meet its target" in result.err) is not passed


def test_a_label_that_the_robot_does_not_know_still_gives_the_decision(hri, spoken: Path, tmp_path: Path):
    words = tmp_path / "words"
    words.mkdir()
    for path in spoken.iterdir():
        (words / f"word{path.name}").write_bytes(path.read_bytes())
    model, report, film = tmp_path / "words.hri", tmp_path / "report.json", tmp_path / "film.mp4"
    assert hri("train", "speech", "--data", words, "--out", model, *QUICK).code == 0
    said = ("recognise", "--speech", words / "word1_low_0.wav", "--speech-model", model)
    result = hri(*said, "--robot", film, "--json", report)
    assert result.code == 3 and result.out.startswith("word1\t")
    assert "no gesture named 'word1'" in result.err and not film.exists()
    assert json.loads(report.read_text())["robot"]["moved"] is False
    motions = tmp_path / "motions.toml"
    motions.write_text('word1 = "agree"\n', encoding="utf-8")
    asked = (*said, "--robot", film, "--backend", "kinematic", "--motions", motions, "--json", report)
    assert hri(*asked).code == 0 and film.exists() and json.loads(report.read_text())["robot"]["moved"] is True
    motions.write_text('word1 = "walk.csv"\n', encoding="utf-8")
    missing = hri(*asked)
    assert missing.code == 3 and f"{motions}: word1: {tmp_path / 'walk.csv'}: " in missing.err and not missing.out
    assert "--motions goes with --robot or --gui" in hri(*said, "--motions", motions).err


def test_a_window_without_a_display_is_refused(hri, monkeypatch: pytest.MonkeyPatch, spoken: Path, word_model: Path):
    pytest.importorskip("pybullet")
    monkeypatch.delenv("DISPLAY", raising=False)
    result = hri("recognise", "--speech", spoken / "1_low_0.wav", "--speech-model", word_model, "--gui")
    assert result.code == 3 and "DISPLAY" in result.err.splitlines()[-1]


def test_people_met_before_and_files_left_out_are_told_of(hri, spoken: Path, tmp_path: Path):
    split = hri("evaluate", "speech", "--train", spoken, "--test", spoken, "--front-end", "cepstra", "--no-network")
    assert "in both folders: high low middle;" in split.err
    chosen = ("--pattern", "{label}_low_{take}.wav", "--out", tmp_path / "m.hri", *QUICK)
    part = hri("train", "speech", "--data", spoken, *chosen)
    assert part.code == 0 and "12 recordings do not fit the pattern, such as 1_high_0.wav" in part.err


@pytest.mark.parametrize("mode", ["speech", "gesture"])
def test_a_seed_reaches_the_recogniser_unless_an_option_says_otherwise(mode: str):
    def seed(*options: str) -> int:
        return int(recognizer_factory(mode, options, seed=7)().get_params()["seed"])

    assert seed() == 7
    assert seed("seed=3") == 3


def test_progress_is_drawn_on_a_terminal_only(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setenv("TERM", "xterm")
    for stream, drawn in ((Terminal(), True), (io.StringIO(), False)):
        monkeypatch.setattr(sys, "stderr", stream)
        with progress_bars() as progress:
            for what in ("reading", "training"):
                for done in range(3):
                    progress(what, done + 1, 3)
        assert ("training" in stream.getvalue()) is drawn
        assert bool(stream.getvalue()) is drawn


def test_tables_are_aligned_on_a_terminal_and_tabbed_elsewhere(monkeypatch: pytest.MonkeyPatch):
    rows = [("held out", "right"), ("a", "5")]
    for stream, text in ((Terminal(), "held out  right\na         5\n"), (io.StringIO(), "held out\tright\na\t5\n")):
        monkeypatch.setattr(sys, "stdout", stream)
        say_table(rows, None)
        assert stream.getvalue() == text


def test_info_shows_kind_and_fields_of_what_is_no_recogniser(hri, tmp_path: Path):
    other = ModelFile()
    other.kind = "recipe"
    other.set_text("rule", "product")
    other.write(str(tmp_path / "other.hri"))
    result = hri("info", tmp_path / "other.hri")
    assert result.code == 0 and {"kind\trecipe", "metadata rule\tproduct"} <= set(result.out.splitlines()), result.err
    other.kind = "word_recognizer"
    other.write(str(tmp_path / "other.hri"))
    assert hri("info", tmp_path / "other.hri").code == 3, "a damaged recogniser"
