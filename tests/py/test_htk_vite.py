# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Options of `hri htk vite`, one by one."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from hri.htk import Label, MasterLabelFile, ModelSet, ParameterFile
from htk_toys import clip, model_text, succeed

pytest_plugins = ("htk_folders",)


def test_scripts_name_parts_of_files(hri, work: Path):
    """`name=file[first,last]`: labels by the name, frames of the part."""
    Path("models").write_text(
        "~o <VECSIZE> 1 <USER>\n"
        + model_text("lo", (0,), "0 1 0\n0 .5 .5\n0 0 0\n")
        + model_text("hi", (8,), "0 1 0\n0 .5 .5\n0 0 0\n")
    )
    Path("list").write_text("lo\nhi\n")
    Path("dict").write_text("lo lo\nhi hi\n")
    Path("gram").write_text("( < lo | hi > )\n")
    succeed(hri("htk", "parse", "gram", "net"))
    Path("s.scp").write_text("a.usr=u0.usr[0,4]\nb.usr=u0.usr[5,14]\nu1.usr\n")
    succeed(
        hri(
            "htk",
            "vite",
            "-H",
            "models",
            "-w",
            "net",
            "-l",
            "*",
            "-i",
            "f.mlf",
            "-p",
            -30,
            "-S",
            "s.scp",
            "dict",
            "list",
        )
    )
    found = MasterLabelFile.read("f.mlf").entries
    assert [path for path, _ in found] == ["*/a.rec", "*/b.rec", "*/u1.rec"]
    assert [[label.name for label in one.labels] for _, one in found] == [
        ["lo"],
        ["hi", "lo"],
        ["lo", "hi", "lo", "hi"],
    ]
    assert found[1][1].labels[-1].last == 1_000_000
    for text, message in (
        ("c=u0.usr[5,20]", "u0.usr: has 20 frames, none with number 20"),
        ("u0.usr[5,2]", "the part ends"),
    ):
        Path("s.scp").write_text(text + "\n")
        refused = hri("htk", "vite", "-H", "models", "-w", "net", "-S", "s.scp", "dict", "list")
        assert refused.code == 3 and message in refused.err


def recognised(hri, *given: object) -> list[list[Label]]:
    succeed(hri("htk", "vite", "-H", "models", "-w", "net", "-i", "f.mlf", *given, "dict", "list", "v.usr"))
    return MasterLabelFile.read("f.mlf").entries[0][1].alternatives


def test_vite_aligns_models_and_states(hri, words: Path):
    """`-m` and `-f`; a word of the dictionary that the network does not use may have unknown models."""
    [whole] = recognised(hri)
    assert [(label.name, label.first, label.last) for label in whole] == [
        ("UP", 0, 1_500_000),
        ("down", 1_500_000, 2_500_000),
    ]
    [models] = recognised(hri, "-m")
    assert [label.name for label in models] == ["low", "hi", "sp", "hi", "low", "sp"]
    assert [label.first for label in models] == [0, 500_000, 1_000_000, 1_500_000, 2_000_000, 2_500_000]
    assert models[-1].first == models[-1].last  # passed without a frame
    assert [name for label in models for name, _ in label.others] == ["up", "down"]
    assert models[0].others[0][1] == pytest.approx(whole[0].score)
    score = sum(label.score for label in models[:3])
    assert score + np.log(0.5) == pytest.approx(whole[0].score, abs=1e-3)
    [both] = recognised(hri, "-m", "-f")
    assert both[0].name == "s2" and [name for name, _ in both[0].others] == ["low", "up"]
    assert [label.name for label in both] == ["s2"] * 5
    [states] = recognised(hri, "-f")
    assert [label.name for label in states] == ["low[2]", "hi[2]", "sp[2]", "hi[2]", "low[2]"]
    assert [name for name, _ in states[0].others] == ["up"]


def test_vite_writes_labels_as_o_says(hri, words: Path):
    plain = recognised(hri)[0][0]
    a_frame = recognised(hri, "-o", "N")[0][0]
    assert a_frame.score == pytest.approx(plain.score / 15, abs=1e-6)
    bare = recognised(hri, "-o", "ST")[0][0]
    assert bare.score is None and bare.first is None
    assert not any(label.others for label in recognised(hri, "-m", "-o", "W")[0])
    assert [name for name, _ in recognised(hri, "-m", "-f", "-o", "M")[0][0].others] == ["up"]
    Path("dict").write_text("up x-lo+y hi sp\ndown hi x-lo+y sp\n")
    assert [label.name for label in recognised(hri, "-m", "-o", "X")[0]][:2] == ["lo", "hi"]
    wrong = hri("htk", "vite", "-H", "models", "-w", "net", "-o", "C", "dict", "list", "v.usr")
    assert wrong.code == 2 and "not C: times are those of the edges" in wrong.err


def test_vite_scales_and_prunes(hri, words: Path):
    plain = recognised(hri)[0][0].score
    assert recognised(hri, "-r", 3)[0][0].score == pytest.approx(plain + 2 * np.log(0.5), abs=1e-3)
    assert recognised(hri, "-p", -7)[0][0].score == pytest.approx(plain - 7, abs=1e-3)
    # The best path so far stays in the first model; in a narrow beam it is the only one.
    ParameterFile(clip(9, 0), "USER", 100000).write("v.usr")
    Path("net").write_text("N=3 L=2\nI=0\nI=1 W=up\nI=2\nJ=0 S=0 E=1\nJ=1 S=1 E=2\n")
    narrow = hri("htk", "vite", "-H", "models", "-w", "net", "-t", 0.001, "-i", "n.mlf", "dict", "list", "v.usr")
    assert narrow.code == 0 and "v.usr: no sentence of the network ends with the recording" in narrow.err
    wider = recognised(hri, "-t", 0.001, 50, 100)
    assert [label.name for label in wider[0]] == ["UP"]
    plain = recognised(hri)[0][0].score
    assert recognised(hri, "-u", 100, "-v", 50.0, "-c", 10.0)[0][0].score == plain
    assert hri("htk", "vite", "-H", "models", "-w", "net", "-t", 1, 2, "dict", "list", "v.usr").code == 2
    assert recognised(hri, "-n", 2, 2, "-q", "lat", "-l", "lats", "-z", "lat")[0][0].score == pytest.approx(
        plain, abs=1e-2
    )
    refused = hri("htk", "vite", "-H", "models", "-w", "net", "-q", "Btal", "dict", "list", "v.usr")
    assert refused.code == 2 and "-q takes tal" in refused.err


def test_vite_reads_models_from_a_folder(hri, words: Path):
    models = ModelSet()
    models.read("models")
    text = Path("models").read_text()
    parts = text.split('~h "')
    Path("dir").mkdir()
    for part in parts[1:]:
        name = part.split('"')[0]
        Path("dir", f"{name}.hmm").write_text(parts[0] + '~h "' + part)
    expected = recognised(hri)[0][0].score
    found = ("htk", "vite", "-d", "dir", "-x", "hmm", "-w", "net", "-i", "d.mlf", "dict", "list", "v.usr")
    succeed(hri(*found))
    assert MasterLabelFile.read("d.mlf").entries[0][1].labels[0].score == expected


def test_alignment_names_file_and_line_of_unknown_words(hri, words: Path):
    Path("said.mlf").write_text('#!MLF!#\n"*/u0.lab"\nup\n.\n"*/v.lab"\nup\nleft\n.\n')
    given = ("htk", "vite", "-H", "models", "-a", "-I", "said.mlf", "-l", "out")
    refused = hri(*given, "dict", "list", "u0.usr", "v.usr")
    assert refused.code == 3 and "said.mlf: line 7: the dictionary dict does not have the word 'left'" in refused.err
    assert not Path("out").exists()
    refused = hri(*given, "-b", "silence", "dict", "list", "u0.usr")
    assert refused.code == 3 and "dict: does not have the word 'silence', of -b" in refused.err
    Path("said.mlf").write_text('#!MLF!#\n"*/v.lab"\nunused\n.\n')
    refused = hri(*given, "dict", "list", "v.usr")
    assert refused.code == 3 and "dict: line 4: the list of models list does not have 'nothing'" in refused.err
    Path("net").write_text("N=3 L=2\nI=0\nI=1 W=left\nI=2\nJ=0 S=0 E=1\nJ=1 S=1 E=2\n")
    for command in (("vite", "-H", "models", "-w", "net", "dict", "list", "v.usr"), ("sgen", "net", "dict")):
        refused = hri("htk", *command)
        assert refused.code == 3 and "net: line 3: the dictionary dict does not have the word 'left'" in refused.err


def test_labels_may_stand_in_folders_that_an_mlf_names(hri, words: Path):
    Path("labels/day").mkdir(parents=True)
    Path("labels/v.lab").write_text("up\ndown\n")
    Path("labels/day/w.lab").write_text("up\ndown\n")
    Path("said.mlf").write_text('#!MLF!#\n"*/v.lab" -> "labels"\n"*/w.lab" => "labels"\n')
    Path("day").mkdir()
    ParameterFile(clip(9, 0, 8, 20, 8, 0), "USER", 100000).write("day/w.usr")
    succeed(
        hri(
            "htk",
            "vite",
            "-H",
            "models",
            "-a",
            "-I",
            "said.mlf",
            "-l",
            "*",
            "-i",
            "f.mlf",
            "dict",
            "list",
            "v.usr",
            "day/w.usr",
        )
    )
    assert [[label.name for label in one.labels] for _, one in MasterLabelFile.read("f.mlf").entries] == [
        ["UP", "down"]
    ] * 2
    Path("labels/v.lab").unlink()
    refused = hri("htk", "vite", "-H", "models", "-a", "-I", "said.mlf", "dict", "list", "v.usr")
    assert refused.code == 3 and "labels/v.lab: there is no such label file" in refused.err


def test_results_are_not_written_over_recordings_or_other_results(hri, words: Path):
    """Nothing is written then, not even the results of the recordings before."""
    Path("v.usr").rename("one.usr")
    Path("part").mkdir()
    Path("part/one.usr").write_bytes(Path("one.usr").read_bytes())
    before = {path: path.read_bytes() for path in Path().rglob("*.usr")}
    vite = ("htk", "vite", "-H", "models", "-w", "net")
    for given, place, files in (
        (("-y", "usr"), "one.usr is a recording", ("one.usr",)),
        (("-y", "usr", "-l", "part"), "part/one.usr is a recording", ("one.usr", "part/one.usr")),
        (("-n", "4 2", "-z", "usr"), "one.usr is a recording", ("one.usr",)),
        (("-l", "found"), "found/one.rec would hold results of one.usr", ("one.usr", "part/one.usr")),
        (("-n", "4 2", "-z", "rec"), "one.rec would hold results of one.usr", ("one.usr",)),
    ):
        refused = hri(*vite, *given, "dict", "list", *files)
        assert refused.code == 2 and place in refused.err, refused
    assert {path: path.read_bytes() for path in Path().rglob("*.usr")} == before
    assert not list(Path().rglob("*.rec"))
    succeed(hri(*vite, "-i", "f.mlf", "-l", "*", "dict", "list", "one.usr", "part/one.usr"))
