# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Headers and parts of parameter files are read alone, as they are in the whole, in memory for what is asked for."""

from __future__ import annotations

import struct
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from conftest import RATE_HZ, tone_word
from hri.core.errors import FormatError, InvalidArgument, IoError
from hri.htk import (
    Configuration,
    ParameterFile,
    Source,
    VqTable,
    blocks_of,
    code_file,
    code_sources,
    list_parameters,
    load_observations,
    read_header,
)
from hri.io import write_wav_pcm16
from htk_toys import model_text, succeed

pytest_plugins = ("htk_folders",)
KINDS = ("MFCC_0", "MFCC_0_K", "MFCC_0_C", "MFCC_0_C_K", "MFCC_0_D_A", "WAVEFORM", "DISCRETE_K", "IREFC_K")
NUM_FRAMES = 30


def make(path: Path, kind: str) -> ParameterFile:
    """A file of 30 frames, as it is read."""
    rng = np.random.default_rng(len(kind))
    values = rng.normal(size=(NUM_FRAMES, 39 if "_D_A" in kind else 13))
    if kind.startswith(("WAVEFORM", "DISCRETE")):
        values = rng.integers(1, 4, size=(NUM_FRAMES, 1))
    elif kind.startswith("IREFC"):
        values = rng.uniform(-1, 1, size=(NUM_FRAMES, 13))
    ParameterFile(values.astype(np.float32), kind, 100_000).write(path)
    return ParameterFile.read(path)


def settings(text: str) -> Configuration:
    configuration = Configuration()
    configuration.parse(text, "config")
    return configuration


@pytest.mark.parametrize("kind", KINDS)
def test_parts_are_cuts_of_the_whole(hri, tmp_path: Path, kind: str):
    path = tmp_path / "a.mfc"
    whole = make(path, kind)
    header = read_header(path)
    assert (header.kind, header.num_frames, header.num_columns) == (whole.kind, *whole.values.shape)
    for first, last in ((0, 1), (0, NUM_FRAMES), (7, 19), (NUM_FRAMES - 1, NUM_FRAMES)):
        part = ParameterFile.read_frames(path, first, last)
        assert part.kind == whole.kind and part.sample_period == 100_000
        assert part.values.tobytes() == whole.values[first:last].tobytes()
        source = Source(path, first * 100_000, last * 100_000)
        assert code_sources([source], settings("SAVEWITHCRC = F")).values.tobytes() == part.values.tobytes()
        assert source.duration(Configuration()) == (last - first) * 100_000
        lines = list(list_parameters(path, "a", first, last - 1, header=True))
        assert lines == list(list_parameters(whole, "a", first, last - 1, header=True))
        shown = succeed(hri("htk", "list", "-h", "-s", first, "-e", last - 1, path)).splitlines()
        assert shown[1:4] == lines[1:4] and shown[5:] == lines[4:]
    raw = succeed(hri("htk", "list", "-r", path)).splitlines()
    assert raw == [" ".join(f"{value:e}" for value in row) for row in whole.values]
    assert [len(block) for block in blocks_of(path, 5, 500)] == [NUM_FRAMES - 5]
    assert list(blocks_of(str(path), NUM_FRAMES)) == []


@pytest.mark.parametrize(
    ("kind", "wanted", "config"),
    [
        ("MFCC_0", "MFCC_0", ""),
        ("MFCC_0_C_K", "MFCC_0_D_A", ""),
        ("MFCC_0", "MFCC_0_D_A_T", "TARGETKIND = MFCC_0_D\nDELTAWINDOW = 3\nSAVECOMPRESSED = T"),
        ("MFCC_0_D_A", "MFCC_0_D", ""),
        ("MFCC_0", "MFCC_0_D_Z", ""),
        ("MFCC_0", "ANON", "TARGETKIND = MFCC_0_D_A"),
        ("IREFC_K", "LPC", ""),
        ("DISCRETE_K", "DISCRETE", "VQTABLE = table\nTARGETKIND = MFCC_0_V"),
        ("MFCC_0", "DISCRETE", "VQTABLE = table\nTARGETKIND = MFCC_0_V"),
        ("MFCC_0", "DISCRETE", "VQTABLE = deltas\nTARGETKIND = MFCC_0_D_V"),
    ],
)
def test_observations_of_parts_are_those_of_the_whole(work: Path, kind: str, wanted: str, config: str):
    rng = np.random.default_rng(0)
    for name, width in (("table", 13), ("deltas", 26)):
        VqTable(rng.normal(size=(8, width)).astype(np.float32), "MFCC_0" if width == 13 else "MFCC_0_D").write(name)
    make(work / "a.mfc", kind)
    configuration = settings(config)
    whole, period = load_observations("a.mfc", wanted, configuration)
    for first, last in ((0, 0), (0, 29), (1, 3), (12, 17), (26, 29), (29, 29)):
        part, of_part = load_observations("a.mfc", wanted, configuration, first, last)
        assert part.tobytes() == whole[first : last + 1].tobytes() and of_part == period
        assert part.base is None
    assert load_observations("a.mfc", wanted, configuration, 20)[0].tobytes() == whole[20:].tobytes()


def test_parts_of_recordings_are_cuts_of_the_whole(work: Path):
    write_wav_pcm16("a.wav", tone_word(500, 0, 1)[:8000], RATE_HZ)
    code_file("a.wav", settings("SOURCEFORMAT = WAV\nTARGETKIND = WAVEFORM")).write("a.wf")
    text = "TARGETKIND = MFCC_0_D\nTARGETRATE = 100000\n"
    by_wav, by_waveform = settings(f"{text}SOURCEFORMAT = WAV"), settings(text)
    for path, configuration in (("a.wav", by_wav), ("a.wf", by_waveform)):
        whole, _ = load_observations(path, "MFCC_0_D", configuration)
        part, _ = load_observations(path, "MFCC_0_D", configuration, 5, 9)
        assert part.tobytes() == whole[5:10].tobytes()
    sources = [[Source(path, 1_000_000, -1_000_000)] for path in ("a.wav", "a.wf")]
    cut = [code_sources(*one).serialise() for one in zip(sources, (by_wav, by_waveform), strict=True)]
    assert cut[0] == cut[1]
    durations = [source[0].duration(c) for source, c in zip(sources, (by_wav, by_waveform), strict=True)]
    assert durations == [3_000_000, 3_000_000]


def test_parts_that_there_are_not_are_refused(hri, work: Path):
    make(work / "a.mfc", "MFCC_0")
    for first, last in ((-1, 3), (3, 3), (4, 3)):
        with pytest.raises(InvalidArgument):
            ParameterFile.read_frames("a.mfc", first, last)
    with pytest.raises(FormatError, match=r"a\.mfc: has 30 frames, none with number 30"):
        ParameterFile.read_frames("a.mfc", 4, 31)
    for first, last in ((-1, 3), (4, 3), (30, None)):
        with pytest.raises(InvalidArgument, match=r"a\.mfc: there is no frame from"):
            load_observations("a.mfc", "MFCC_0", Configuration(), first, last)
    for kind in ("MFCC_0", "MFCC_0_Z"):  # read in part, and whole
        with pytest.raises(FormatError, match=r"a\.mfc: has 30 frames, none with number 30"):
            load_observations("a.mfc", kind, Configuration(), 4, 30)
    with pytest.raises(IoError):
        read_header("none.mfc")
    with pytest.raises(IoError):
        ParameterFile.read_frames(work, 0, 1)


def test_damaged_files_are_refused(hri, work: Path):
    make(work / "a.mfc", "MFCC_0_K")
    good = Path("a.mfc").read_bytes()
    for damaged in (good[:-1], good[:500], good[:12], good[:5], good + b"\0\0"):
        Path("a.mfc").write_bytes(damaged)
        for refuse in (
            lambda: ParameterFile.read_frames("a.mfc", 0, 1),
            lambda: read_header("a.mfc"),
            lambda: ParameterFile.verify("a.mfc"),
            lambda: load_observations("a.mfc", "MFCC_0", Configuration(), 0, 0),
        ):
            with pytest.raises(FormatError, match=r"a\.mfc: byte 0: the header"):
                refuse()
        assert hri("htk", "list", "-z", "-h", "a.mfc").code == 3
    damage = bytearray(good)
    damage[600] ^= 1
    Path("a.mfc").write_bytes(damage)
    # The checksum is that of the whole: it says nothing of a part that is read alone.
    assert hri("htk", "list", "-s", 0, "-e", 3, "a.mfc").code == 0
    assert hri("htk", "list", "-h", "-z", "a.mfc").code == 0
    refused = hri("htk", "list", "a.mfc")
    assert refused.code == 3 and refused.out == "" and "the checksum is wrong" in refused.err
    Path("a.wav").write_bytes(b"RIFF" + bytes(40))
    assert "a.wav: is a WAV file" in hri("htk", "list", "a.wav").err


def test_tools_read_parts_of_long_files(hri, work: Path):
    rng = np.random.default_rng(1)
    values = np.repeat([[0], [8], [0], [8], [500]], 100, axis=0) + rng.normal(size=(500, 1))
    ParameterFile(values.astype(np.float32), "USER", 100_000).write("long.usr")
    data = bytearray(Path("long.usr").read_bytes())
    data[-4:] = b"\x7f\xc0\0\0"  # not a number, in a frame that no part has
    Path("long.usr").write_bytes(data)
    Path("proto").write_text("~o <VECSIZE> 1 <USER>\n" + model_text("proto"))
    parts = ("b.usr=long.usr[100,299]", "a.usr=long.usr[0,199]", "c.usr=long.usr[200,399]")
    out = succeed(hri("htk", "init", "-T", 1, "-M", "made", "-o", "m", "proto", *parts))
    assert "3 recordings" in out
    refused = hri("htk", "init", "-M", "made", "-o", "m", "proto", "long.usr[400,500]")
    assert refused.code == 3 and "long.usr: has 500 frames, none with number 500" in refused.err
    refused = hri("htk", "init", "-M", "made", "-o", "m", "proto", "long.usr")
    assert refused.code == 3 and "a value is not finite" in refused.err


MEMORY = """
import sys
from hri.htk import Configuration, ParameterFile, Source, code_sources, list_parameters, load_observations, read_header

def peak_kib():
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("VmHWM"))

def use():
    {use}

before = peak_kib()
use()
print((peak_kib() - before) >> 10)
"""


def sparse(path: Path, num_frames: int, code: int, num_columns: int, width: int) -> None:
    """A file of zeros that takes no room on the disk; with _C of scales 1."""
    compressed, checked = code & 0o2000, code & 0o10000
    with path.open("wb") as file:
        file.write(struct.pack(">iihH", num_frames + (4 if compressed else 0), 100_000, num_columns * width, code))
        if compressed:
            file.write(struct.pack(f">{2 * num_columns}f", *num_columns * [1.0], *num_columns * [0.0]))
        file.truncate(file.tell() + num_frames * num_columns * width + (2 if checked else 0))


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="peak memory is read from /proc")
@pytest.mark.parametrize(
    ("use", "most_mib"),
    [
        ("assert read_header('long').num_frames == 10_000_000", 8),
        ("assert len(ParameterFile.read_frames('long', 9_000_000, 9_000_100).values) == 100", 8),
        ("assert len(ParameterFile.read_frames('long_c', 9_000_000, 9_000_100).values) == 100", 8),
        ("assert len(load_observations('long', 'MFCC_0_D_A', Configuration(), 5_000_000, 5_000_099)[0]) == 100", 8),
        ("assert len(list(list_parameters('long', 'x', 9_999_990))) == 20", 8),
        ("assert next(list_parameters('long', 'x')).startswith('0:')", 16),
        ("assert len(code_sources([Source('long', 5e11, 5.00001e11)], Configuration()).values) == 10", 8),
        ("assert Source('long', 10, -10).duration(Configuration()) == 10**12", 8),
        # 256 MiB are checked; 64 MiB are read, and written, without a second copy.
        ("ParameterFile.verify('checked')", 8),
        ("ParameterFile.read('middle').write('copy')", 64 + 16),
    ],
)
def test_memory_is_for_what_is_asked(work: Path, use: str, most_mib: int):
    sparse(Path("long"), 10_000_000, 6 + 0o20000, 13, 4)
    sparse(Path("long_c"), 10_000_000, 6 + 0o20000 + 0o2000, 13, 2)
    sparse(Path("checked"), 1 << 22, 9 + 0o10000, 16, 4)
    sparse(Path("middle"), 1 << 20, 9 + 0o10000, 16, 4)
    done = subprocess.run(
        [sys.executable, "-c", MEMORY.format(use=use)], capture_output=True, text=True, check=False, cwd=work
    )
    assert done.returncode == 0, done.stderr
    assert int(done.stdout) <= most_mib
