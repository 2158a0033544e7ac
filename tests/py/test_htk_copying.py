# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Options of `hri htk` copy, list, parse, sgen and results, one by one."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from conftest import RATE_HZ, tone_word
from hri.htk import MasterLabelFile, ParameterFile, Transcription
from hri.io import write_wav_pcm16
from htk_toys import succeed

pytest_plugins = ("htk_folders",)


def test_sgen_and_parse_take_their_options(hri, words: Path):
    succeed(hri("htk", "parse", "-l", "-d", "made.dict", "gram", "made.net"))
    assert Path("made.dict").read_text() == "up up\ndown down\n"
    assert "l=-0.69314" in Path("made.net").read_text()
    shown = succeed(hri("htk", "sgen", "-q", "-s", "-n", 300, "net", "dict")).splitlines()
    assert shown[0] == "Number of Nodes = 4 [2 words], Vocab Size = 2"
    # Two of three times: one word of two, then perhaps another.
    entropy = float(shown[1].split("Entropy = ")[1].split(",")[0])
    assert 1.0 < entropy < 1.35 and shown[1].endswith(f"Perplexity = {2**entropy:.6f}") is not None
    assert shown[2].startswith("300 Sentences: average len = 1.") and shown[2].endswith("min=1, max=2")


def test_results_take_their_options(hri, work: Path):
    Path("list").write_text("a\nb\nx-a+y\n")
    Path("ref.mlf").write_text('#!MLF!#\n"*/s1_ann.lab"\na\nb\n.\n"*/s2_ann.lab"\nb\n.\n"*/s1_bob.lab"\na\n.\n')
    Path("rec.mlf").write_text(
        '#!MLF!#\n"*/s1_ann.rec"\nx-a+y\n///\na\nb\n.\n"*/s2_ann.rec"\nA\n.\n"*/s1_bob.rec"\na\nb\n.\n'
    )
    given = ("-I", "ref.mlf", "list", "rec.mlf")
    refused = hri("htk", "results", "-p", *given)
    assert refused.code == 3 and "rec.mlf: line 9: the list list does not have 'A'" in refused.err
    succeed(hri("htk", "results", *given))  # what is not in the list is only an error
    out = succeed(hri("htk", "results", "-c", "-s", *given))
    assert "SENT: %Correct=0.00 [H=0, S=3, N=3]" in out and "[H=2, D=1, S=1, I=1, N=4]" in out
    out = succeed(hri("htk", "results", "-c", "-d", 2, "-a", "CLIP", "-b", "UNIT", *given))
    assert "CLIP: %Correct=33.33" in out and "UNIT: %Corr=75.00, Acc=50.00 [H=3, D=0, S=1, I=1, N=4]" in out
    out = succeed(hri("htk", "results", "-c", "-s", "-m", 1, *given))
    assert "[H=1, D=1, S=0, I=0, N=2]" in out
    out = succeed(hri("htk", "results", "-c", "-s", "-z", "b", *given))
    assert "[H=2, D=0, S=0, I=1, N=2]" in out
    out = succeed(hri("htk", "results", "-c", "-s", "-k", "*_%%%.rec", *given))
    speakers = out.split("Speaker Results")[1].splitlines()[1:3]
    assert speakers == [
        "ann:   33.33(  33.33)  [H=   1, D=  1, S=  1, I=  0, N=  3]   0.00 [N=  2]",
        "bob:  100.00(   0.00)  [H=   1, D=  0, S=  0, I=  1, N=  1]   0.00 [N=  1]",
    ]
    out = succeed(hri("htk", "results", "-c", "-s", "-k", "*/s1_%%%.rec", *given))
    assert out.splitlines()[-1] == "** Speaker Pattern '*/s1_%%%.rec' Failed 1 Times **" and "[H=2, D=1, S=1" in out
    out = succeed(hri("htk", "results", "-c", "-s", "-f", "-t", *given)).splitlines()
    assert out[0] == "------------------------ Sentence Scores --------------------------"
    assert out[1] == "====================== HTK Results Analysis ======================="
    at = out.index("-------------------------- File Results ---------------------------")
    assert out[at + 1] == "s1_ann.rec:   50.00(  50.00)  [H=   1, D=  1, S=  0, I=  0, N=  2]"
    assert out[at + 2] == "Aligned transcription: */s1_ann.lab vs */s1_ann.rec"
    rows = succeed(hri("htk", "results", "-c", "-s", "-p", *given)).split("Confusion Matrix")[1].splitlines()[1:]
    assert rows[0].split() == ["A", "B", "Del", "%c"]
    assert rows[1].split() == ["A", "2", "0", "0", "100.0"] and rows[2].split() == ["B", "1", "0", "1", "0.0"]
    assert rows[3].split() == ["Ins", "0", "1"]
    table = succeed(hri("htk", "results", "-h", "-c", "-s", "-k", "*_%%%.rec", *given))
    assert "Usage" not in table
    row = next(line for line in table.splitlines() if line.startswith("| Sum/Avg"))
    assert row.replace("|", " ").split() == ["Sum/Avg", "3", "50.00", "25.00", "25.00", "25.00", "75.00", "100.00"]
    assert any(line.startswith("| ann ") for line in table.splitlines())
    Path("ref.mlf").write_text('#!MLF!#\n"*/s1_ann.lab"\na\nc\n.\n')
    Path("folder.mlf").write_text('#!MLF!#\n"*" -> "labels"\n')
    refused = hri("htk", "results", "-I", "ref.mlf", "list", "folder.mlf")
    assert refused.code == 3 and "folder.mlf: '*' names a folder; labels have to stand here" in refused.err
    refused = hri("htk", "results", "-p", "-s", "-m", 1, *given)
    assert refused.code == 3 and "ref.mlf: line 4: the list list does not have 'c'" in refused.err


@pytest.fixture
def sounds(work: Path) -> Path:
    for name, base in (("one", 500.0), ("two", 900.0)):
        write_wav_pcm16(work / f"{name}.wav", tone_word(base, 0, 1)[:16000], RATE_HZ)
    Path("config").write_text("SOURCEFORMAT = WAV\nTARGETKIND = MFCC_0\nTARGETRATE = 100000\nSAVEWITHCRC = F\n")
    Path("labels").mkdir()
    Path("labels/one.lab").write_text(
        "0 2000000 sil\n2000000 6000000 word\n6000000 8000000 sil\n8000000 10000000 word\n"
    )
    return work


def test_copy_cuts_and_joins(hri, sounds: Path):
    def coded(*arguments: object) -> ParameterFile:
        succeed(hri("htk", "copy", "-C", "config", *arguments))
        return ParameterFile.read(str(arguments[-1]))

    whole = coded("one.wav", "whole.mfc")
    part = coded("-s", 2_000_000, "-e", 6_000_000, "one.wav", "part.mfc")
    assert len(whole.values) == 98 and len(part.values) == 38
    np.testing.assert_allclose(part.values, whole.values[20:58], atol=1e-4)
    for option in (("-n", 2), ("-x", "word"), ("-n", -3), ("-x", "word", 1)):
        named = coded(*option, "-L", "labels", "one.wav", "named.mfc")
        np.testing.assert_array_equal(named.values, part.values)
    assert len(coded("-n", 2, 3, "-L", "labels", "one.wav", "n.mfc").values) == 58
    assert len(coded("-x", "word", 1, "-m", 500_000, "-L", "labels", "one.wav", "m.mfc").values) == 48
    # Ends before and behind that of the recording, which has a second.
    np.testing.assert_array_equal(coded("-s", 2_000_000, "-e", -4_000_000, "one.wav", "e.mfc").values, part.values)
    assert len(coded("-e", 0, "one.wav", "e.mfc").values) == len(coded("-e", 9e7, "one.wav", "e.mfc").values) == 98
    assert len(coded("-x", "word", 2, "-m", 1e7, "-L", "labels", "one.wav", "m.mfc").values) == 98
    joined = coded("one.wav", "+", "two.wav", "both.mfc")
    assert len(joined.values) == 198
    # Parameter files are cut and joined by frames.
    Path("plain").write_text("SAVEWITHCRC = F\n")
    succeed(
        hri("htk", "copy", "-C", "plain", "-s", 2_000_000, "-e", 3_000_000, "whole.mfc", "+", "whole.mfc", "cut.mfc")
    )
    np.testing.assert_array_equal(ParameterFile.read("cut.mfc").values, np.tile(whole.values[20:30], (2, 1)))


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("one.wav", "two.wav"), "two.wav is a recording that is there"),
        (("one.wav", "one.wav"), "one.wav is a source"),
        (("one.wav", "a.mfc", "two.wav", "link.wav"), "link.wav is a source"),
        (("one.wav", "+", "u0.usr", "u0.usr"), "u0.usr is a source"),
        (("one.wav", "a.mfc", "two.wav", "./a.mfc"), "./a.mfc is the target of two pairs"),
        (("-S", "pairs.scp"), "two.wav is a recording that is there"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, tuple) else "",
)
def test_copy_writes_over_no_recording(hri, sounds: Path, arguments: tuple[str, ...], message: str):
    """As where the targets were forgotten: `copy *.wav`."""
    Path("link.wav").symlink_to("one.wav")
    Path("pairs.scp").write_text("one.wav a.mfc one.wav two.wav\n")
    before = {name: Path(name).read_bytes() for name in ("one.wav", "two.wav", "u0.usr")}
    refused = hri("htk", "copy", "-C", "config", *arguments)
    assert refused.code == 2 and message in refused.err
    assert {name: Path(name).read_bytes() for name in before} == before and not Path("a.mfc").exists()


def test_what_a_script_names_is_not_written_over(hri, words: Path):
    Path("test.scp").write_text("whole.usr\npart=v.usr[0,3]\n")
    Path("v.usr").rename("kept.usr")
    for name in ("v.usr", "whole.usr"):
        Path(name).write_bytes(Path("kept.usr").read_bytes())
        before = Path(name).read_bytes()
        for tool in (
            ("vite", "-H", "models", "-w", "net", "-S", "test.scp", "-i", name, "dict", "list"),
            ("quant", "-S", "test.scp", name),
            ("quant", name, "x=v.usr[0,3]", "whole.usr"),
        ):
            refused = hri("htk", *tool)
            assert refused.code == 2 and "is read, and would be written over" in refused.err, refused.err
        assert Path(name).read_bytes() == before


def test_copy_takes_labels_along(hri, sounds: Path):
    given = ("-C", "config", "-L", "labels", "-s", 1_000_000, "-e", 7_000_000)
    succeed(hri("htk", "copy", *given, "-i", "new.mlf", "-l", "*/of", "one.wav", "+", "one.wav", "both.mfc"))
    assert MasterLabelFile.read("new.mlf").entries[0][0] == "*/of/both.lab" and not Path("*").exists()
    succeed(hri("htk", "copy", *given, "-l", "cut", "one.wav", "+", "one.wav", "both.mfc"))
    expected = [
        ("sil", 0, 1_000_000),
        ("word", 1_000_000, 5_000_000),
        ("sil", 5_000_000, 6_000_000),
        ("sil", 6_000_000, 7_000_000),
        ("word", 7_000_000, 11_000_000),
        ("sil", 11_000_000, 12_000_000),
    ]
    for labels in (Transcription.read("cut/both.lab").labels, MasterLabelFile.read("new.mlf").entries[0][1].labels):
        assert [(label.name, label.first, label.last) for label in labels] == expected
    for option, message in (
        (("-x", "other"), "has no label 'other' number 1"),
        (("-n", 3, 9), "has 4 labels, and not those from 3 to 9"),
        (("-a", 2, "-n", 1), "has 1 alternative, no number 2"),
        (("-s", 5_000_000, "-e", 4_000_000), "nothing is left between"),
        (("-s", 90_000_000), "nothing is left between"),
        (("-e", -90_000_000), "nothing is left between 0.0 * 100 ns and 90000000.0 * 100 ns before its end"),
    ):
        refused = hri("htk", "copy", "-C", "config", "-L", "labels", *option, "one.wav", "no.mfc")
        assert refused.code == 3 and message in refused.err and not Path("no.mfc").exists()
    Path("labels/one.lab").write_text("0 0 word\n")
    refused = hri("htk", "copy", "-C", "config", "-L", "labels", "-x", "word", "one.wav", "no.mfc")
    assert refused.code == 3 and "line 1: the label 'word' ends where it begins" in refused.err
    assert hri("htk", "copy", "-C", "config", "one.wav", "+", "no.mfc").code == 2
    refused = hri("htk", "copy", "-C", "config", "-F", "HTK", "one.wav", "no.mfc")
    assert refused.code == 3 and "one.wav: is a WAV file, which SOURCEFORMAT = WAV, or -F WAV, reads" in refused.err


def test_list_shows_target_and_structure(hri, sounds: Path):
    Path("config").write_text("SOURCEFORMAT = WAV\nTARGETKIND = MFCC_0_D\nTARGETRATE = 100000\nNUMCEPS = 2\n")
    shown = succeed(hri("htk", "list", "-C", "config", "-t", "-o", "-z", "one.wav"))
    assert "Target: one.wav" in shown and "Sample Kind:   MFCC_D_K_0" in shown and "\n0:" not in shown
    assert shown.splitlines()[-1] == "MFCC-1 MFCC-2 C0 Del-1 Del-2 DelC0"
    shown = succeed(hri("htk", "list", "-C", "config", "-s", 3, "-e", 4, "one.wav"))
    assert [line.split(":")[0] for line in shown.splitlines()] == ["3", "4"]
    assert hri("htk", "list", "-t", "u0.usr").code == 2


def test_copy_makes_kinds_of_those_that_say_more(hri, sounds: Path):
    """Filters become cepstra, and a predictor its cepstra, as the recording itself does; others are refused."""
    for source, target in (("FBANK_E", "MFCC_E_D"), ("LPC", "LPCEPSTRA"), ("LPC", "LPREFC"), ("MELSPEC", "MFCC_0")):
        text = "SOURCEFORMAT = WAV\nTARGETRATE = 100000\nNUMCHANS = 24\nNUMCEPS = 10\nSAVEWITHCRC = F\n"
        for name, kind in (("source", source), ("target", target)):
            Path("config").write_text(f"{text}TARGETKIND = {kind}\n")
            succeed(hri("htk", "copy", "-C", "config", "one.wav", f"{name}.par"))
        succeed(hri("htk", "copy", "-C", "config", "-F", "HTK", "source.par", "made.par"))
        made, expected = ParameterFile.read("made.par"), ParameterFile.read("target.par")
        assert made.kind == expected.kind == ParameterFile.read("target.par").kind
        np.testing.assert_allclose(made.values, expected.values, rtol=0, atol=1e-4 * np.abs(expected.values).max())
    Path("config").write_text("TARGETKIND = FBANK\n")
    refused = hri("htk", "copy", "-C", "config", "target.par", "no.par")
    assert refused.code != 0 and "cannot become FBANK" in refused.err and not Path("no.par").exists()


def test_results_count_keywords_by_their_times(hri, work: Path):
    """Half an hour: five false alarms an hour. What ranks above each of them, by hand."""
    hour = 36_000_000_000
    Path("list").write_text("fire\nhelp\n")
    said = "0 100 fire\n100 200 other\n1000 2000 fire\n3000 4000 fire\n5000 6000 help\n"
    Path("said.mlf").write_text(f'#!MLF!#\n"*/a.lab"\n{said}{hour // 2 - 9} {hour // 2} other\n.\n')
    # By score: hit, false alarm, hit, the same again, a word that is no keyword, false alarm (the middle of what was
    # said lies beside it), hit of help.
    found = (
        "10 90 fire -1\n200 300 fire -2\n900 2000 fire -3\n1400 1600 fire -4\n2000 2500 other 5\n"
        "3000 3400 fire -5\n5100 9900 help -9\n"
    )
    Path("found.mlf").write_text(f'#!MLF!#\n"*/a.rec"\n{found}.\n')
    rows = succeed(hri("htk", "results", "-w", "-I", "said.mlf", "list", "found.mlf")).splitlines()
    cells = {row.split(":")[0].strip(): row.split(":")[1].split() for row in rows[2:5]}
    # N = 5: after one hit of three, then three for good.
    merit = (100 / 3 + 4 * 100) / 5
    assert cells["fire"] == ["3", "2", "3", f"{merit:.2f}"]
    assert cells["help"] == ["1", "0", "1", "100.00"]
    assert cells["Overall"] == ["4", "2", "4", f"{(3 * merit + 100) / 4:.2f}"]
    rows = succeed(hri("htk", "results", "-w", "-u", 2.5, "-I", "said.mlf", "list", "found.mlf")).splitlines()
    # 2 false alarms in 2.5 hours.
    assert rows[2].split()[-1] == f"{(100 / 3 + 100) / 2:.2f}"
    Path("found.mlf").write_text('#!MLF!#\n"*/a.rec"\n0 100 fire\n.\n')
    refused = hri("htk", "results", "-w", "-I", "said.mlf", "list", "found.mlf")
    assert refused.code == 3 and "found.mlf: line 3: the keyword 'fire' has no score" in refused.err
    Path("found.mlf").write_text('#!MLF!#\n"*/a.rec"\nfire -3\n.\n')
    refused = hri("htk", "results", "-w", "-I", "said.mlf", "list", "found.mlf")
    assert refused.code == 3 and "found.mlf: line 3: the label 'fire' has no times" in refused.err


def test_labels_are_found_by_all_patterns_in_turn(hri, sounds: Path):
    """A folder counts where it has the file; patterns are compared with names as they are given."""

    def seconds(*arguments: object) -> float:
        succeed(hri("htk", "copy", "-C", "config", "-x", "word", *arguments, "out.mfc"))
        return (2 + len(ParameterFile.read("out.mfc").values)) / 100  # a frame has 25 ms

    for folder in ("empty", "second", "deep"):
        Path(folder).mkdir()
    Path("deep/sounds").mkdir()
    Path("second/one.lab").write_text("0 3000000 word\n")
    Path("deep/sounds/one.lab").write_text("0 4000000 word\n")
    Path("sounds").mkdir()
    Path("one.wav").rename("sounds/one.wav")
    entry = "{}\n0 {} word\n.\n"
    for text, expected in (
        ('"*" -> "empty"\n"*" -> "second"\n', 0.3),
        ('"*" -> "empty"\n' + entry.format('"*/one.lab"', 5_000_000), 0.5),
        ('"*" => "empty"\n"*" => "deep"\n', 0.4),
        (entry.format('"sounds/???.lab"', 6_000_000), 0.6),
    ):
        Path("labels.mlf").write_text(f"#!MLF!#\n{text}")
        assert seconds("-I", "labels.mlf", "sounds/one.wav") == expected
    Path("labels.mlf").write_text('#!MLF!#\n"*" -> "empty"\n')
    refused = hri("htk", "copy", "-C", "config", "-x", "word", "-I", "labels.mlf", "sounds/one.wav", "no.mfc")
    assert refused.code == 3 and "empty/one.lab: there is no such label file" in refused.err
    Path("sounds/one.lab").write_text("0 7000000 word\n")
    assert seconds("-I", "labels.mlf", "sounds/one.wav") == 0.7
    Path("sounds/one.wav").rename("one.wav")
    for pattern in ("one.lab", "???.lab", "*/one.lab", "./one.*"):
        Path("labels.mlf").write_text(f"#!MLF!#\n{entry.format(chr(34) + pattern + chr(34), 2_000_000)}")
        assert seconds("-I", "labels.mlf", "one.wav") == 0.2
        assert seconds("-I", "labels.mlf", "./one.wav") == 0.2


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        (("list",), 2, "no files: name those to print"),
        (("list", "-s", "20", "u0.usr"), 3, "u0.usr: has 20 frames, from 0 on, and none from 20 on"),
        (("list", "-s", "5", "-e", "2", "u0.usr"), 2, "-e 2 lies before -s 5"),
        (("list", "-z", "none.usr"), 3, "none.usr: cannot open"),
        (("list", "-z", "-S", "bad.scp"), 3, "bad.scp: line 2: none.usr: there is no such file"),
        (("quant", "-S", "bad.scp", "codebook"), 3, "bad.scp: line 2: none.usr: there is no such file"),
        (("quant", "-S", "part.scp", "codebook"), 3, "part.scp: line 1: none.usr: there is no such file"),
        (("quant", "-S", "said.mlf", "codebook"), 3, "said.mlf: is a master label file, which -I takes"),
        (("copy", "-S", "bad.scp"), 3, "bad.scp: line 2: none.usr: there is no such file"),
        (("copy", "-S", "odd.scp"), 2, "odd.scp: line 3: u1.usr has no target: files come in pairs"),
        (("copy", "-S", "said.mlf"), 3, "said.mlf: is a master label file"),
        (("results", "-I", "said.mlf", "-S", "bad.scp", "list"), 3, "bad.scp: line 2: none.usr: there is no such"),
        (("build", "-S", "bad.scp", "list", "net"), 3, "bad.scp: line 2: none.usr: there is no such file"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, tuple) else "",
)
def test_what_is_wrong_with_files_and_frames_is_said(
    hri, work: Path, arguments: tuple[str, ...], code: int, message: str
):
    Path("bad.scp").write_text("u0.usr a.usr\nnone.usr b.usr\n" if arguments[0] == "copy" else "u0.usr\nnone.usr\n")
    Path("part.scp").write_text("seven=none.usr[0,3]\n")
    Path("odd.scp").write_text("u0.usr a.usr\n\nu1.usr\n")
    Path("said.mlf").write_text('#!MLF!#\n"*/a.lab"\nup\n.\n')
    Path("list").write_text("up\n")
    done = hri("htk", *arguments)
    assert done.code == code and message in done.err, done.err
    assert not Path("a.usr").exists()
    assert len(succeed(hri("htk", "list", "-s", 18, "-e", 300, "u0.usr")).splitlines()) == 2
