# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What goes wrong outside ends well: one line that names the place, no wrong answer, and the robot stays where it is.

Through the command line where that is what a user meets; single functions are shown in test_media, test_model_files,
test_recognition and test_robot_motion.
"""

from __future__ import annotations

import json
import re
import shutil
import signal
import struct
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from conftest import RATE_HZ, CommandResult, tone_word
from hri import _native, read_audio
from hri.core.errors import FormatError
from hri.media import write_video

Run = Callable[..., CommandResult]


@pytest.fixture(scope="module")
def models(spoken: Path, signed: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The user's data folder with a model of each mode."""
    import hri

    folder = tmp_path_factory.mktemp("models")
    (folder / "hri").mkdir()
    hri.train(hri.Dataset.load(spoken), hri.WordRecognizer()).save(folder / "hri" / "speech.hri")
    hri.train(hri.Dataset.load(signed), hri.GestureRecognizer()).save(folder / "hri" / "gesture.hri")
    return folder


@pytest.fixture
def run(hri: Run, monkeypatch: pytest.MonkeyPatch, models: Path) -> Run:
    """Runs the command line, which finds a model of each mode."""
    monkeypatch.setenv("XDG_DATA_HOME", str(models))
    return hri


def refused(result: CommandResult, *words: str) -> None:
    """Exit code 3, nothing on standard output, and one line that says all `words`."""
    assert (result.code, result.out) == (3, ""), result.err
    lines = [line for line in result.err.splitlines() if line.startswith("hri: error: ")]
    assert len(lines) == 1, result.err
    assert all(word in lines[0] for word in words), lines[0]


def chunk(name: bytes, body: bytes, claimed: int | None = None) -> bytes:
    return name + struct.pack("<I", len(body) if claimed is None else claimed) + body


def wav(samples: np.ndarray, rate_hz: int = RATE_HZ, channels: int = 1, codec: int = 1, **claimed: int) -> bytes:
    """A WAV file; `fmt`, `data` and `riff` claim other sizes than the true ones."""
    width = samples.dtype.itemsize
    step = min(channels * width, 0xFFFF)
    fields = struct.pack("<HHIIHH", codec, channels, rate_hz, rate_hz * step, step, 8 * width)
    body = b"WAVE" + chunk(b"fmt ", fields, claimed.get("fmt")) + chunk(b"data", samples.tobytes(), claimed.get("data"))
    return chunk(b"RIFF", body, claimed.get("riff"))


WORD = (32767 * tone_word(550.0, 800.0, 99)).astype("<i2")
"""A recording of the word 1."""


# 1: sizes in the header that are not the file's


@pytest.mark.parametrize("claimed", [0, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF])
def test_recording_whose_header_was_never_filled_in_is_recognised_with_a_note(
    run: Run, tmp_path: Path, claimed: int
) -> None:
    (tmp_path / "stream.wav").write_bytes(wav(WORD, data=claimed, riff=claimed))
    result = run("recognise", "--speech", tmp_path / "stream.wav")
    assert result.code == 0 and result.out.startswith("1\t")
    assert result.err.count("note: ") == 1


def test_a_recording_that_is_played_as_a_stream_says_what_is_wrong_with_it(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "cut.wav"
    path.write_bytes(wav(np.repeat(WORD, 2), channels=2)[:-4000])
    recorded = ("record", "word", "1", "--person", "asha", "--takes", "1", "--out", tmp_path / "words")
    for command in (("listen", "--json-lines", path), (*recorded, "--from", path)):
        result = run(*command)
        assert result.code == 0, result.err
        assert f"{path}: file ends early" in result.err and f"{path}: 2 channels averaged to mono" in result.err


def test_wav_cut_anywhere_is_read_in_part_with_a_note_or_refused_by_name(tmp_path: Path) -> None:
    whole, path = wav(WORD[:200]), tmp_path / "cut.wav"
    for length in range(len(whole)):
        path.write_bytes(whole[:length])
        if length < 44 + 2:  # not one sample is left
            with pytest.raises(FormatError, match=r"cut\.wav"):
                read_audio(path)
            continue
        audio = read_audio(path)
        np.testing.assert_array_equal(audio.samples, WORD[: (length - 44) // 2] / np.float32(32768))
        assert len(audio.notes) == 1


# 2: sizes that would fill the memory


def test_sizes_without_sense_take_no_memory(tmp_path: Path) -> None:
    """Read where no more than 256 MB can be had, each file is refused as damaged, not for want of memory."""
    tensor = {"dtype": "F64", "shape": [1 << 31, 1 << 31], "data_offsets": [0, 1 << 60]}
    header = json.dumps({"__metadata__": {"format_version": "1", "kind": "test"}, "a": tensor}).encode()
    files = {
        "fmt.wav": wav(WORD, fmt=0xFFFFFFF0),
        "negative.wav": wav(WORD, fmt=0x80000000),
        "list.wav": wav(WORD)[:12] + chunk(b"LIST", b"INFO", 0xFFFFFF00) + wav(WORD)[12:],
        "channels.wav": wav(WORD, channels=65535),
        "header.hri": struct.pack("<Q", 1 << 62) + b"{}",
        "negative.hri": struct.pack("<q", -8) + b"{}",
        "tensor.hri": struct.pack("<Q", len(header)) + header + bytes(64),
        "motion.csv": b"1" * (1 << 20),
    }
    for name, content in files.items():
        (tmp_path / name).write_bytes(content)
    script = """
import resource, sys
from pathlib import Path
from hri import _native, read_audio
from hri.core.errors import FormatError
from hri.robot import read_pulse_csv
readers = {".wav": read_audio, ".hri": lambda path: _native.ModelFile.read(str(path)), ".csv": read_pulse_csv}
pages = int(Path("/proc/self/statm").read_text().split()[0])
limit = pages * resource.getpagesize() + (256 << 20)
resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
for path in sorted(Path(sys.argv[1]).iterdir()):
    try:
        readers[path.suffix](path)
    except FormatError as error:
        assert path.name in str(error), error
        print(path.name)
"""
    done = subprocess.run([sys.executable, "-c", script, str(tmp_path)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == sorted(files)


# 3 and 4: nothing to hear


@pytest.mark.parametrize("num_samples", [0, 1, 399])
def test_less_than_a_frame_of_sound_is_too_short_by_name(run: Run, tmp_path: Path, num_samples: int) -> None:
    (tmp_path / "short.wav").write_bytes(wav(WORD[:num_samples]))
    refused(run("recognise", "--speech", tmp_path / "short.wav"), "too short")


@pytest.mark.parametrize("samples", [np.zeros(16000, "<i2"), np.full(16000, 9000, "<i2"), np.zeros(16000, "<f4")])
def test_silence_is_no_input_and_moves_nothing(run: Run, tmp_path: Path, samples: np.ndarray) -> None:
    (tmp_path / "silent.wav").write_bytes(wav(samples, codec=3 if samples.dtype == np.float32 else 1))
    film = tmp_path / "robot.mp4"
    result = run("recognise", "--speech", tmp_path / "silent.wav", "--robot", film, "--json", "-")
    reported = json.loads(result.out, parse_constant=lambda word: pytest.fail(f"{word} is no JSON"))
    assert (result.code, reported["status"], reported["confidence"]) == (0, "no_input", 0.0)
    assert reported["robot"] == {"moved": False, "reason": "no_input"} and not film.exists()


def test_silent_recording_among_others_is_counted_as_no_input(run: Run, spoken: Path, tmp_path: Path) -> None:
    folder = shutil.copytree(spoken, tmp_path / "spoken")
    (folder / "1_low_0.wav").write_bytes(wav(np.zeros(16000, "<i2")))
    result = run("evaluate", "speech", "--data", folder, "--json", "-", "--front-end", "cepstra", "--no-network")
    reported = json.loads(result.out, parse_constant=lambda word: pytest.fail(f"{word} is no JSON"))
    assert reported["confusion"] == [[8, 0, 1], [0, 9, 0]]


# 5: numbers that are none


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("command", ["recognise", "train", "evaluate"])
def test_sample_that_is_not_finite_is_named_by_file_and_index(
    run: Run, spoken: Path, tmp_path: Path, command: str, bad: float
) -> None:
    samples = (WORD / 32768).astype("<f4")
    samples[1234] = bad
    folder = shutil.copytree(spoken, tmp_path / "spoken")
    (folder / "2_high_1.wav").write_bytes(wav(samples, codec=3))
    kept = tmp_path / "kept.hri"
    arguments = {
        "recognise": ("--speech", folder / "2_high_1.wav"),
        "train": ("speech", "--data", folder, "--out", kept),
        "evaluate": ("speech", "--data", folder),
    }[command]
    refused(run(command, *arguments), "2_high_1.wav", "1234")
    assert not kept.exists()


# 6: other rates, channels and codecs


def test_other_rate_and_stereo_are_converted_and_said(run: Run, tmp_path: Path) -> None:
    slower = np.clip(_native.resample((WORD / 32768).astype("f4"), RATE_HZ, 22050) * 32767, -32768, 32767)
    (tmp_path / "stereo.wav").write_bytes(wav(np.repeat(slower.astype("<i2"), 2), rate_hz=22050, channels=2))
    result = run("recognise", "--speech", tmp_path / "stereo.wav")
    assert result.code == 0 and result.out.startswith("1\t")
    notes = [line for line in result.err.splitlines() if "note: " in line]
    assert any("2 channels" in note for note in notes) and any("22050 to 16000 Hz" in note for note in notes)


@pytest.mark.parametrize("codec", [2, 6, 7, 0x11, 0x55])
def test_other_codec_is_refused_naming_it_and_those_there_are(run: Run, tmp_path: Path, codec: int) -> None:
    (tmp_path / "coded.wav").write_bytes(wav(WORD, codec=codec))
    refused(
        run("recognise", "--speech", tmp_path / "coded.wav"), "coded.wav", f"codec {codec} ", "PCM (1)", "float (3)"
    )


# 7: clips that are none


def test_video_without_frames_names_its_path_and_moves_nothing(run: Run, tmp_path: Path) -> None:
    path, film = tmp_path / "empty.avi", tmp_path / "robot.mp4"
    write_video(path, [np.full((48, 64, 3), 9, np.uint8)] * 3, fps=10.0)
    path.write_bytes(path.read_bytes()[: path.read_bytes().index(b"movi") + 4])
    refused(run("recognise", "--gesture", path, "--robot", film), "empty.avi")
    assert not film.exists()


def test_video_whose_time_runs_backwards_names_its_path_and_moves_nothing(run: Run, tmp_path: Path) -> None:
    path, film = tmp_path / "back.mkv", tmp_path / "robot.mp4"
    write_video(path, [np.full((48, 64, 3), 9, np.uint8)] * 8, fps=10.0)
    data = bytearray(path.read_bytes())
    pictures = [i for i in range(4, len(data)) if data[i : i + 3] == b"\xff\xd8\xff" and data[i - 4] == 0x81]
    struct.pack_into(">h", data, pictures[5] - 3, 150)  # a block's time stands before its flags and its picture
    path.write_bytes(bytes(data))
    refused(run("recognise", "--gesture", path, "--robot", film), "back.mkv", "time runs backwards", "frame 5")
    assert not film.exists()


# 10: motions that no robot may be given


@pytest.mark.parametrize(
    ("column", "cell", "message"),
    [
        (8, "999999", "row 6, column I"),  # far out of range
        (8, "nan", "row 6, column I"),
        (8, "-3000", "row 6, column I"),  # within range, but nothing gets there in a millisecond
        (26, None, "row 6, column AA"),  # missing
    ],
)
def test_whole_motion_is_checked_before_anything_moves(
    run: Run, tmp_path: Path, column: int, cell: str | None, message: str
) -> None:
    path, film = tmp_path / "motion.csv", tmp_path / "robot.mp4"
    assert run("robot", "convert", "namaste", path).code == 0
    rows = [line.split(",") for line in path.read_text().splitlines()]
    rows[5][column : column + 1] = [] if cell is None else [cell]
    path.write_text("".join(",".join(row) + "\n" for row in rows))
    refused(run("robot", "render", path, film, "--backend", "kinematic"), message)
    refused(run("robot", "play", path, "--backend", "kinematic"), message)
    assert not film.exists()
    checked = run("robot", "check", path)
    place = message.replace("row ", "error\t").replace(", column ", "\t")
    assert checked.code == 3 and any(line.startswith(place) for line in checked.out.splitlines())


# 11: models whose numbers make no sense


def test_model_whose_probabilities_do_not_sum_to_one_is_refused(tmp_path: Path) -> None:
    topology = _native.Topology(kind="left_right", num_states=3)
    rng = np.random.default_rng(0)
    model = _native.GaussianMixtureHmm(
        _native.MarkovChain.initial(topology),
        np.ones((3, 1)),
        rng.normal(size=(3, 2)),
        np.ones((3, 2)),
    )
    file = _native.ModelFile()
    model.write(file, "m.")
    _native.GaussianMixtureHmm.read(file, "m.")
    file.set_matrix_d("m.transition", 0.9 * file.matrix_d("m.transition"))
    with pytest.raises(FormatError, match=r"m\.transition"):
        _native.GaussianMixtureHmm.read(file, "m.")


# 15: killed while saving


def test_killed_while_saving_leaves_a_whole_file(tmp_path: Path) -> None:
    path = tmp_path / "m.hri"
    script = f"""
import itertools, numpy as np
from hri import _native
for number in itertools.count():
    file = _native.ModelFile()
    file.set_text("kind", "test")
    file.set_matrix_d("values", np.full((300, 300), float(number)))
    file.write({str(path)!r})
    if number == 0:
        print("saved", flush=True)
"""
    for delay_s in (0.0, 0.003, 0.011):
        process = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE)
        assert process.stdout is not None and process.stdout.readline() == b"saved\n"
        time.sleep(delay_s)
        process.kill()
        assert process.wait() == -signal.SIGKILL
        process.stdout.close()
        values = _native.ModelFile.read(str(path)).matrix_d("values")
        assert values.shape == (300, 300) and (values == values[0, 0]).all()


def test_every_fault_names_tests_that_there_are() -> None:
    root = Path(__file__).parents[2]
    rows = [
        line for line in (root / "docs/faults.md").read_text("utf-8").splitlines() if re.match(r"\| *\d+ *\|", line)
    ]
    assert [int(row.split("|")[1]) for row in rows] == list(range(1, 19))
    cpp = "".join(path.read_text("utf-8") for path in (root / "tests/cpp").rglob("*_test.cpp"))
    for row in rows:
        names = re.findall(r"`([\w.]+(?:::|\.)[A-Za-z_]\w+)`", row.split("|")[4])
        assert names, row
        for name in names:
            if "::" in name:
                file, test = name.split("::")
                assert f"def {test}(" in (root / "tests/py" / file).read_text("utf-8"), name
            else:
                suite, test = name.split(".")
                assert re.search(rf"TEST(_[FP])?\({suite}, {test}\)", cpp), name
