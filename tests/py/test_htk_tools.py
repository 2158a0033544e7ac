# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Training tools of `hri htk`, and what all tools refuse: by name, with file and line, before anything is written."""

from __future__ import annotations

import re
from pathlib import Path

import click
import numpy as np
import pytest

from hri.cli.htk import htk
from hri.htk import ModelSet, ParameterFile
from htk_toys import FILES, STEPS, clip, model_text, succeed

pytest_plugins = ("htk_folders",)


def test_init_and_rest_keep_topology_mixtures_and_floors(hri, work: Path):
    succeed(hri("htk", "init", "-n", "-H", "header", "-M", "out", "-o", "x", "proto", *FILES))
    for command, path in (("init", "out/x"), ("rest", "again/x")):
        if command == "rest":
            succeed(hri("htk", "rest", "-H", "header", "-M", "again", "out/x", *FILES))
        made = ModelSet()
        made.read(path)
        steps = made.transitions("x")
        assert np.all((steps > 0) <= (np.array([[float(v) for v in row.split()] for row in STEPS.split("\n")[:4]]) > 0))
        assert steps[2, 1] > 0 and made.hmm("x").weights.shape == (2, 2)
        assert np.all(made.hmm("x").variances >= 3)
        assert Path(path).parent.joinpath("header").is_file()
    # Without -M the file itself is written again; its name is the model's.
    before = Path("out/x").read_bytes()
    succeed(hri("htk", "rest", "out/x", *FILES))
    assert Path("out/x").read_bytes() != before


def test_init_and_rest_find_models_in_macro_files(hri, work: Path):
    Path("models").write_text("~o <VECSIZE> 1 <USER>\n" + model_text("a") + model_text("b"))
    succeed(hri("htk", "init", "-H", "models", "-M", "out", "b", *FILES))
    made, before = ModelSet(), ModelSet()
    made.read("out/models")
    before.read("models")
    assert made.hmm_names == ["a", "b"]
    np.testing.assert_array_equal(made.hmm("a").means, before.hmm("a").means)
    assert not np.array_equal(made.hmm("b").means, before.hmm("b").means)
    missing = hri("htk", "rest", "-H", "models", "-M", "no", "c", *FILES)
    assert missing.code == 3 and "c: there is no such file, and no -H defines the model 'c'" in missing.err
    several = hri("htk", "init", "-M", "no", "models", *FILES)
    assert several.code == 3 and "models: defines 2 models, not one" in several.err
    assert not Path("no").exists()


def test_init_takes_the_options_of_hinit(hri, work: Path):
    kept = ModelSet()
    kept.read("proto")
    succeed(hri("htk", "init", "-u", "t", "-M", "u", "proto", *FILES))
    made = ModelSet()
    made.read("u/proto")
    np.testing.assert_array_equal(made.hmm("proto").means, kept.hmm("proto").means)
    assert not np.array_equal(made.transitions("proto"), kept.transitions("proto"))
    succeed(hri("htk", "init", "-v", 9, "-M", "v", "proto", *FILES))
    made = ModelSet()
    made.read("v/proto")
    assert np.all(made.hmm("proto").variances >= 9)
    traced = succeed(hri("htk", "init", "-T", 1, "-i", 2, "-e", 0, "-M", "i", "proto", *FILES))
    assert traced.count("pass ") <= 2 and "proto: 4 recordings -> i/proto" in traced
    # -n begins with the model as it is.
    begun = succeed(hri("htk", "init", "-n", "-T", 1, "-i", 1, "-M", "n", "proto", *FILES))
    assert begun.splitlines()[0] != traced.splitlines()[0]
    few = hri("htk", "init", "-m", 5, "-M", "m", "proto", *FILES)
    assert few.code == 3 and "proto: 4 recordings to train on, fewer than 5 (-m)" in few.err
    floor = succeed(hri("htk", "rest", "-w", 30000, "-M", "w", "proto", *FILES))
    assert floor == ""
    made = ModelSet()
    made.read("w/proto")
    assert np.all(made.hmm("proto").weights >= 0.3 - 1e-6)
    short = "~o <VECSIZE> 1 <USER>\n" + model_text(
        "proto", (0, 1, 2), "0 1 0 0 0\n0 .5 .5 0 0\n0 0 .5 .5 0\n0 0 0 .5 .5\n0 0 0 0 0\n"
    )
    Path("three").write_text(short)
    ParameterFile(np.zeros((2, 1), np.float32), "USER", 100000).write("short.usr")
    left = hri("htk", "rest", "-M", "s", "three", "short.usr", *FILES)
    assert left.code == 0 and "short.usr: 2 frames, fewer than the 3 that proto takes; left out" in left.err


@pytest.mark.parametrize("command", ["init", "rest", "compv", "erest", "vite"])
def test_headers_are_checked_before_any_work(hri, work: Path, command: str):
    """Another sample period, kind or size: refused by name, and nothing is written."""
    Path("models").write_text("~o <VECSIZE> 1 <USER>\n" + model_text("w"))
    Path("list").write_text("w\n")
    Path("dict").write_text("w w\n")
    Path("net").write_text("N=3 L=2\nI=0\nI=1 W=w\nI=2\nJ=0 S=0 E=1\nJ=1 S=1 E=2\n")
    entries = "".join(f'"*/{name}.lab"\nw\n.\n' for name in ("u0", "u1", "slow", "other", "wide", "broken"))
    Path("said.mlf").write_text("#!MLF!#\n" + entries)
    ParameterFile(clip(0), "USER", 200000).write("slow.usr")
    ParameterFile(np.tile(clip(0), (1, 13)), "MFCC_0", 100000).write("other.usr")
    ParameterFile(np.tile(clip(0), (1, 2)), "USER", 100000).write("wide.usr")
    Path("broken.usr").write_bytes(b"abc")
    given = {
        "init": ("-M", "out", "-m", 1, "proto"),
        "rest": ("-M", "out", "-m", 1, "proto"),
        "compv": ("-M", "out", "proto"),
        "erest": ("-H", "models", "-I", "said.mlf", "-M", "out", "list"),
        "vite": ("-H", "models", "-w", "net", "-l", "out", "dict", "list"),
    }[command]
    for bad, message in (
        ("slow.usr", "slow.usr: a frame each 200000 * 100 ns, where u0.usr has one each 100000 * 100 ns"),
        ("other.usr", "other.usr: its frames are MFCC_0, and the models take USER"),
        ("wide.usr", "wide.usr: 2 columns as USER, and the models take vectors of 1"),
        ("broken.usr", "broken.usr: byte 0: the header takes 12 bytes"),
        ("missing.usr", "missing.usr"),
    ):
        if command == "erest" and bad == "missing.usr":
            continue
        refused = hri("htk", command, *given, "u0.usr", "u1.usr", bad)
        assert refused.code in (2, 3) and message in refused.err, refused.err
        assert not Path("out").exists()
    Path("config").write_text("TARGETRATE = 150000\n")
    refused = hri("htk", command, "-C", "config", *given, "u0.usr", "u1.usr")
    assert refused.code == 3 and "u0.usr: a frame each 100000 * 100 ns, where TARGETRATE says 150000" in refused.err


def test_hed_writes_every_file_again(hri, words: Path):
    """-H twice and -d, -M: as HHEd; new macros come to the first file with a model, in which they stand first."""
    Path("macros").write_text('~o <VECSIZE> 1 <USER>\n~v "varFloor1"\n<VARIANCE> 1\n0.1\n')
    text = Path("models").read_text()
    at = text.index('~h "sp"')
    Path("hmmdefs").write_text(text[:at])
    Path("dir").mkdir()
    Path("dir/sp").write_text("~o <VECSIZE> 1 <USER>\n" + text[at:])
    Path("plain").write_text("x-lo+y\nhi\nsp\n")
    Path("e.hed").write_text("// tie\nTI pause {(hi,sp).state[2]}\n")
    done = succeed(
        hri("htk", "hed", "-T", 1, "-H", "macros", "-H", "hmmdefs", "-d", "dir", "-M", "out", "e.hed", "plain")
    )
    assert done == "e.hed: 1 command -> out/macros out/hmmdefs out/sp\n"
    assert Path("out/macros").read_text().count("~") == 2
    assert Path("out/hmmdefs").read_text().index('~s "pause"') < Path("out/hmmdefs").read_text().index("~h")
    assert Path("out/sp").read_text().count('~s "pause"') == 1
    made = ModelSet()
    for name in ("macros", "hmmdefs", "sp"):
        made.read(f"out/{name}")
    assert sorted(made.hmm_names) == ["hi", "sp", "x-lo+y"]
    succeed(hri("htk", "hed", "-H", "hmmdefs", "-d", "dir", "-o", "new", "-M", "two", "e.hed", "plain"))
    assert Path("two/sp.new").is_file()
    succeed(hri("htk", "hed", "-H", "hmmdefs", "-d", "dir", "-M", "one", "-w", "all", "e.hed", "plain"))
    assert [path.name for path in Path("one").iterdir()] == ["all"]


def test_erest_reads_and_writes_files_by_suffix(hri, words: Path):
    Path("dir").mkdir()
    for part in Path("models").read_text().split('~h "')[1:]:
        name = part.split('"')[0]
        Path("dir", f"{name}.old").write_text('~o <VECSIZE> 1 <USER>\n~h "' + part)
    Path("said.mlf").write_text('#!MLF!#\n"*/v.lab"\nlow\nhi\nsp\nhi\nlow\n.\n')
    given = ("-d", "dir", "-x", "old", "-o", "new", "-M", "out", "-m", 1, "-c", 20.0, "-I", "said.mlf", "list", "v.usr")
    succeed(hri("htk", "erest", *given))
    assert sorted(path.name for path in Path("out").iterdir()) == ["hi.new", "sp.new", "x-lo+y.new"]


def test_erest_adds_parts_up(hri, words: Path):
    """-p 1 and -p 2 write sums, -p 0 estimates of both what one pass estimates of all."""
    Path("said.mlf").write_text('#!MLF!#\n"*/v.lab"\nlow\nhi\nsp\nhi\nlow\n.\n"*/u0.lab"\nlow\nhi\nlow\nhi\n.\n')
    given = ("-H", "models", "-m", 1, "-I", "said.mlf")
    shown = succeed(hri("htk", "erest", *given, "-M", "whole", "list", "v.usr", "u0.usr"))
    for number, name in enumerate(("v.usr", "u0.usr"), 1):
        assert succeed(hri("htk", "erest", *given, "-M", "parts", "-p", number, "list", name)) == ""
    assert sorted(path.name for path in Path("parts").iterdir()) == ["HER1.acc", "HER2.acc"]
    given = ("-H", "models", "-m", 1, "-M", "parts", "-p", 0, "list")
    assert succeed(hri("htk", "erest", *given, "parts/HER1.acc", "parts/HER2.acc")) == shown
    made, expected = ModelSet(), ModelSet()
    made.read("parts/models")
    expected.read("whole/models")
    for name in expected.hmm_names:
        np.testing.assert_allclose(made.hmm(name).means, expected.hmm(name).means, rtol=1e-9)
        np.testing.assert_allclose(made.transitions(name), expected.transitions(name), atol=1e-9)
    refused = hri("htk", "erest", "-H", "whole/models", "-M", "no", "-p", 0, "list", "parts/HER1.acc")
    assert refused.code == 3 and "parts/HER1.acc: models: sums of other models" in refused.err
    assert not Path("no").exists()


def test_every_option_that_there_is_not_is_refused_by_name(hri, words: Path):
    for command, options in {
        "copy": (("-t", 70), ("-O", "NIST"), ("-P", "TIMIT"), ("-G", "ESPS"), ("-F", "NIST")),
        "list": (("-d",), ("-p",), ("-n", 3)),
        "init": (("-B",),),
        "rest": (("-B",), ("-G", "TIMIT")),
        "compv": (("-c", "d"), ("-k", "s"), ("-q", "m"), ("-B",)),
        "erest": (("-B",), ("-r",), ("-a",), ("-h", "m"), ("-E", "d"), ("-J", "d"), ("-K", "d")),
        "hed": (("-B",), ("-z",), ("-Q", "x"), ("-r", "1")),
        "parse": (("-b",), ("-c",)),
        "build": (("-b",), ("-m", "f"), ("-w", "f"), ("-x", "f"), ("-z",)),
        "vite": (("-B",), ("-g",), ("-h", "m"), ("-j", 1), ("-k",), ("-J", "d"), ("-P", "ESPS")),
        "results": (("-g", "TIMIT"),),
    }.items():
        arguments = {
            "init": ("proto", *FILES),
            "rest": ("proto", *FILES),
            "compv": ("proto", *FILES),
            "list": FILES[:1],
        }
        given = arguments.get(command, ("dict", "list", "out"))
        for option in options:
            refused = hri("htk", command, *option, *given)
            assert refused.code in (2, 3), (command, option, refused.out)
            assert "not supported" in refused.err and option[0] in refused.err, refused.err


def test_standard_options_show_what_they_say(hri, words: Path):
    Path("config").write_text("NUMCHANS = 26\nHPARM: ENORMALISE = F\nMAXTRYOPEN = 3\n")
    shown = hri("htk", "parse", "-A", "-D", "-V", "-C", "config", "gram", "made")
    lines = succeed(shown).splitlines()
    assert lines[0] == "hri htk parse -A -D -V -C config gram made"
    assert lines[1].startswith("hri htk parse ") and lines[2] == "Configuration Parameters"
    assert [line.split() for line in lines[3:]] == [["NUMCHANS", "26"], ["ENORMALISE", "F"], ["MAXTRYOPEN", "3"]]
    assert shown.err == "set nothing here: MAXTRYOPEN\n"
    Path("config").write_text("\nCMEANDIR = means\n")
    for command in (
        "copy",
        "list",
        "parse",
        "build",
        "sgen",
        "compv",
        "init",
        "rest",
        "erest",
        "hed",
        "vite",
        "results",
    ):
        given = (("proto",) if command in ("compv", "init", "rest") else ("dict", "list")) + ("u0.usr",)
        given = given[:2] if command in ("parse", "build", "sgen", "hed") else given
        refused = hri("htk", command, *(("-w", "net") if command == "vite" else ()), "-C", "config", *given)
        assert refused.code == 3 and "config: line 2: CMEANDIR = means is not supported" in refused.err, (
            command,
            refused.err,
        )


def test_the_page_lists_every_option():
    """The table of docs/htk.md has what the commands take, less the standard options and those that are refused."""
    text = (Path(__file__).parents[2] / "docs" / "htk.md").read_text(encoding="utf-8")
    listed = dict(re.findall(r"(?m)^\| `(\w+)` \| [^|]* \| (.*) \|$", text))
    assert sorted(listed) == sorted(htk.commands)
    for name, command in htk.commands.items():
        options = {
            flag
            for param in command.params
            if isinstance(param, click.Option) and not (param.help or "").startswith("Refused: ")
            for flag in param.opts
        }
        found = set(re.findall(r"-{1,2}[A-Za-z]+(?:-[a-z]+)*", listed[name].split("commands")[0]))
        assert options - {"-A", "-C", "-D", "-S", "-T", "-V"} == found, name
        assert {"-A", "-C", "-D", "-T", "-V"} <= options, name
        assert all(param.help for param in command.params if isinstance(param, click.Option))
