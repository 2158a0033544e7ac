# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What the command line says beside its results: suggestions, how much it prints, and help with examples."""

from __future__ import annotations

import json
import logging
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import click
import pytest

from conftest import QUICK
from hri.cli.in_commands import of_models
from hri.cli.main import hri as root
from hri.core.suggest import did_you_mean, nearest
from hri.datasets import Dataset
from hri.recognition import WordRecognizer
from hri.recognition.loading import _KINDS


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        ("trian speech", 2, "no command 'trian'; did you mean 'train'?"),
        ("recognize --speech x", 2, "did you mean 'recognise'?"),
        ("robot gesture", 2, "did you mean 'gestures'?"),
        ("corpus speach", 2, "did you mean 'speech'?"),
        ("record words", 2, "did you mean 'word'?"),
        ("train speech --dat .", 2, "--data"),
        ("study fusion-digit", 3, "did you mean 'fusion-digits'"),
        ("robot play namste --backend kinematic", 3, "did you mean 'namaste'?"),
    ],
)
def test_what_was_meant_is_suggested(hri, arguments: str, code: int, message: str):
    result = hri(*arguments.split())
    assert (result.code, result.out) == (code, "")
    assert message in result.err and result.err.count("\n") == 1


def test_of_a_folder_that_may_be_two_things_what_to_type_is_said(hri, tmp_path: Path):
    """The most natural layout of few recordings."""
    for name in ("go/a.wav", "go/b.wav", "stop/a.wav", "stop/b.wav"):
        (tmp_path / "data" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "data" / name).touch()
    result = hri("train", "speech", "--data", tmp_path / "data")
    assert result.code == 3
    assert "say which, by --pattern '{label}/{take}' or --pattern '{person}/{label}'\n" in result.err
    folders = ("--speech-data", tmp_path / "data", "--gesture-data", tmp_path)
    result = hri("train-fusion", *folders, "--out", tmp_path / "fusion.hri")
    assert result.code == 3 and "by --speech-pattern '{label}/{take}' or --speech-pattern" in result.err
    (tmp_path / "data" / "x_y.wav").touch()
    result = hri("train-units", "--data", tmp_path / "data")
    assert "write a dataset.toml, or say --pattern '...'. Tried:" in result.err


def test_a_folder_without_an_option_is_described_in_its_manifest(hri, spoken: Path, tmp_path: Path):
    for name in ("go/a.wav", "stop/a.wav"):
        (tmp_path / "others" / name).parent.mkdir(parents=True)
        (tmp_path / "others" / name).touch()
    result = hri("train", "speech", "--data", spoken, "--fillers", tmp_path / "others")
    assert result.code == 3 and "by pattern = '{label}/{take}' in its dataset.toml or pattern = " in result.err


@pytest.mark.parametrize(
    ("command", "model", "commands"),
    [
        (("listen", "--model"), "sign_model", "'hri watch' and 'hri add-gesture' (--model), 'hri recognise'"),
        (("watch", "--model"), "word_model", "'hri listen' and 'hri adapt' (--model), 'hri recognise'"),
        (("transcribe", "--model"), "word_model", "'hri listen' and 'hri adapt' (--model), 'hri recognise'"),
    ],
    ids=lambda value: value[0] if isinstance(value, tuple) else "",
)
def test_a_model_of_another_kind_is_said_to_be_of_these_commands(
    hri, spoken: Path, request: pytest.FixtureRequest, command: tuple[str, ...], model: str, commands: str
):
    result = hri(*command, request.getfixturevalue(model), spoken / "1_low_0.wav")
    assert result.code == 3 and f"is needed here; {commands}" in result.err and ".load" not in result.err


def test_every_kind_of_model_has_its_commands(hri, spoken: Path):
    for name, taken_by in _KINDS.values():
        assert ".load" in taken_by and ".load" not in of_models(f"m.hri is a {name}; {taken_by}")
        said = of_models(f"a.wav is a sound file, and a {name} is needed here: train makes one, save writes it")
        maker = re.fullmatch(r".* is needed here: 'hri (\S+).*' makes one", said)
        assert maker is not None and root.get_command(click.Context(root), maker[1]) is not None
    result = hri("info", spoken / "1_low_0.wav")
    assert result.code == 3 and "is needed here: 'hri train' makes one\n" in result.err


def test_names_that_are_like_none_are_listed():
    assert did_you_mean("xyz", ["train", "watch"]) == "there are: train, watch"
    assert did_you_mean("xyz", [f"label{i}" for i in range(30)], "it has").endswith("label11 and 18 more")
    assert nearest("STOP", ["stop", "start"])[0] == "stop"


def test_labels_are_suggested(hri, spoken: Path, tmp_path: Path):
    dataset = Dataset.load(spoken, "speech")
    with pytest.raises(ValueError, match="no person 'hihg' in this data set; did you mean 'high'"):
        dataset.select(persons=["hihg"])
    model = tmp_path / "words.hri"
    paths = [sample.path for sample in dataset]
    names = [{"1": "forward", "2": "backward"}[sample.label] for sample in dataset]
    WordRecognizer(num_noisy_copies=0, num_vtlp_factors=1).fit(paths, names, fillers=[]).save(model)
    result = hri("remove-word", "--model", model, "--label", "forwrad")
    assert result.code == 3 and "no word 'forwrad'; did you mean 'forward'" in result.err
    result = hri("adapt", "--model", model, "--label", "backwards", "-o", tmp_path / "a.hri", paths[0])
    assert result.code == 3 and "did you mean 'backward'" in result.err


def test_files_of_another_kind_are_said_to_be_what_they_are(
    hri, spoken: Path, signed: Path, word_model: Path, tmp_path: Path
):
    words, word, sign = word_model, spoken / "1_low_0.wav", next(signed.glob("*/*.jpg"))
    for arguments, code, message in (
        (("recognise", words), 2, "words.hri is a model, not a recording: give it as --speech-model"),
        (
            ("recognise", "--speech", words, "--speech-model", words),
            3,
            "words.hri is a model, and a sound",
        ),
        (("recognise", "--gesture", sign, "--gesture-model", words), 3, "words.hri is a word recogniser"),
        (
            ("recognise", "--speech", word, "--speech-model", word),
            3,
            "1_low_0.wav is a sound file, and a word",
        ),
        (("recognise", "--speech", sign, "--speech-model", words), 3, "is a picture, and a sound file is needed"),
        (("recognise", word, word, sign), 2, "several recordings must be of words only, or of signs only"),
        (("recognise", spoken, "--robot", tmp_path / "film.mp4"), 2, "--robot and --gui show one decision"),
    ):
        result = hri(*arguments)
        assert (result.code, result.out) == (code, ""), arguments
        assert message in result.err, result.err


def test_recordings_need_no_option_where_their_suffix_says_it_all(
    hri, spoken: Path, signed: Path, word_model: Path, sign_model: Path
):
    models = ("--speech-model", word_model, "--gesture-model", sign_model)
    word, sign = spoken / "1_low_0.wav", sorted((signed / "1").iterdir())[0]
    short = hri("recognise", word, sign, *models)
    assert short.code == 0 and short.out == hri("recognise", "--speech", word, "--gesture", sign, *models).out


def test_several_recordings_of_a_mode_have_a_line_each(
    hri, spoken: Path, signed: Path, word_model: Path, sign_model: Path, tmp_path: Path
):
    words, signs, report = word_model, sign_model, tmp_path / "report.json"
    one, two, torn = spoken / "1_low_0.wav", spoken / "2_low_0.wav", tmp_path / "torn.wav"
    torn.write_bytes(b"RIFF")
    done = hri("recognise", one, torn, two, "--speech-model", words, "--json", report)
    rows = [line.split("\t") for line in done.out.splitlines()]
    assert done.code == 3 and [row[:2] for row in rows] == [[str(one), "1"], [str(two), "2"]]
    assert done.err.endswith("\n") and "1 of 3 recordings not recognised, first" in done.err and str(torn) in done.err
    found = json.loads(report.read_text())
    assert [row["file"] for row in found] == [str(one), str(torn), str(two)] and "error" in found[1]
    alone = json.loads(hri("recognise", one, "--speech-model", words, "--json", "-").out)
    assert found[0] == {"file": str(one), **{name: value for name, value in alone.items() if name != "robot"}}
    folder = hri("recognise", spoken, "--speech-model", words)
    assert folder.code == 0 and len(folder.out.splitlines()) == len(list(spoken.glob("*.wav")))
    pictures = sorted((signed / "1").iterdir())[:2]
    shown = hri("recognise", *pictures, "--gesture-model", signs)
    assert shown.code == 0 and [line.split("\t")[0] for line in shown.out.splitlines()] == list(map(str, pictures))


def test_quiet_and_verbose_change_what_is_said_and_not_the_result(hri, spoken: Path, tmp_path: Path):
    model = tmp_path / "words.hri"
    command = ("train", "speech", "--data", spoken, "--out", model, *QUICK)
    plain, quiet, verbose = hri(*command), hri("-q", *command), hri("-v", *command)
    assert plain.out == quiet.out == verbose.out
    assert quiet.err == "" and "18 recordings" in plain.err
    assert "hri.recognition" in verbose.err and "hri.recognition" not in plain.err
    assert hri("-q", "nonsense").err.startswith("hri: error: ")
    assert hri("-q", "-v", "info").code == 2


def test_the_library_is_silent_unless_somebody_listens(spoken: Path, caplog: pytest.LogCaptureFixture):
    code = (
        "import hri, logging, sys; "
        "assert any(isinstance(h, logging.NullHandler) for h in logging.getLogger('hri').handlers); "
        f"hri.Dataset.load({str(spoken)!r})"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    logger = logging.getLogger("hri")
    propagated, level = logger.propagate, logger.level
    logger.propagate = True
    try:
        with caplog.at_level(logging.INFO, "hri"):
            Dataset.load(spoken, "speech")
    finally:
        logger.propagate = propagated
        logger.setLevel(level)
    assert any(record.name == "hri.datasets.dataset" and "18" in record.getMessage() for record in caplog.records)


def commands(group: click.Group, name: str) -> Iterator[tuple[str, click.Command]]:
    context = click.Context(group)
    for entry in group.list_commands(context):
        command = group.get_command(context, entry)
        assert command is not None
        if isinstance(command, click.Group):
            yield from commands(command, f"{name} {entry}")
        yield f"{name} {entry}", command


def test_every_command_has_help_with_an_example_of_itself():
    missing = []
    for name, command in commands(root, "hri"):
        text = command.get_help(click.Context(command, info_name=name))
        if "Example" not in text or f"\n      {name}" not in text.replace("    hri", "      hri"):
            missing.append(name)
    assert missing == []
