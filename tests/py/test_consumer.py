# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""An outside C++ project builds against an installed libhri without OpenCV and gives Python's scores to the bit."""

from __future__ import annotations

import os
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest

import hri
from hri.io import model_as_cpp, write_wav_pcm16
from hri.recognition import SentenceStream
from hri.synthetic.speech import make_speaker, make_speech_corpus, speak

ROOT = Path(__file__).resolve().parents[2]
BUILD = os.environ.get("HRI_BUILD_DIR")

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not BUILD, reason="HRI_BUILD_DIR names no CMake build; ./run test --all sets it"),
]


def run(*command: object, **environment: str) -> str:
    """Standard output of a command that has to succeed."""
    done = subprocess.run(
        [str(part) for part in command], env={**os.environ, **environment}, capture_output=True, text=True
    )
    assert done.returncode == 0, f"{command}\n{done.stdout}\n{done.stderr}"
    return done.stdout


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What `cmake --install` writes, without the Python modules."""
    prefix = tmp_path_factory.mktemp("installed")
    run("cmake", "--install", BUILD, "--component", "development", "--prefix", prefix)
    return prefix


@pytest.fixture(scope="module")
def programs(installed: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The example project, built with OpenCV hidden."""
    build = tmp_path_factory.mktemp("consumer")
    run(
        *("cmake", "-S", ROOT / "examples" / "consumer", "-B", build, "-DCMAKE_BUILD_TYPE=Release"),
        *(f"-DCMAKE_PREFIX_PATH={installed}", "-DCMAKE_DISABLE_FIND_PACKAGE_OpenCV=ON"),
    )
    run("cmake", "--build", build)
    return build


@pytest.fixture(scope="module")
def spoken(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A small synthetic corpus of spoken digits."""
    folder = tmp_path_factory.mktemp("spoken")
    make_speech_corpus(folder, words={"en": ["one", "two", "three"]}, num_speakers=3, seed=0)
    return folder


@pytest.mark.parametrize("kind", ["hmm", "ptbhmm"])
def test_cpp_gives_the_scores_of_python_to_the_bit(programs: Path, spoken: Path, tmp_path: Path, kind: str) -> None:
    dataset = hri.Dataset.load(spoken)
    recognizer = hri.train(dataset, hri.WordRecognizer(model=kind))
    assert isinstance(recognizer, hri.WordRecognizer)
    model = tmp_path / "words.hri"
    recognizer.save(model)
    for sample in dataset.samples[::5]:
        audio = hri.read_audio(sample.path)
        ours = recognizer.scores(audio.samples, audio.sample_rate_hz)
        lines = run(programs / "print_scores", model, sample.path).splitlines()
        labels, texts = zip(*(line.split("\t") for line in lines), strict=True)
        theirs = np.array([float.fromhex(text) for text in texts], dtype=np.float32)
        assert list(labels) == list(recognizer.classes_)
        np.testing.assert_array_equal(theirs.view(np.uint32), ours.view(np.uint32))
        label, confidence = run(programs / "recognise_word", model, sample.path).split()
        decision = recognizer.recognise(audio.samples, audio.sample_rate_hz)
        assert (label, float(confidence)) == (decision.label, pytest.approx(decision.confidence, abs=1e-5))


def test_words_in_a_stream_are_found_and_recognised(programs: Path, spoken: Path, tmp_path: Path) -> None:
    """The tutorial's program, on two words with a second of quiet room around each."""
    words = hri.train(hri.Dataset.load(spoken), hri.WordRecognizer())
    assert isinstance(words, hri.WordRecognizer)
    words.save(tmp_path / "words.hri")
    clips = [speak(word, "en", make_speaker(20)) for word in ("one", "three")]
    rate_hz = clips[0].sample_rate_hz
    room = 1e-4 * np.random.default_rng(0).standard_normal(rate_hz).astype(np.float32)
    stream = np.concatenate([room, clips[0].samples, room, clips[1].samples, room])
    write_wav_pcm16(str(tmp_path / "stream.wav"), stream, rate_hz)
    lines = run(programs / "stream_words", tmp_path / "words.hri", tmp_path / "stream.wav").splitlines()
    assert [line.split("\t")[1] for line in lines] == ["one", "three"]
    begins_ms = [int(line.split()[0]) for line in lines]
    assert 1000 <= begins_ms[0] < 1200 and begins_ms[1] > 2000 + 1000 * len(clips[0].samples) / rate_hz


def test_signed_sentences_in_a_stream_are_those_of_python(programs: Path, tmp_path: Path) -> None:
    sentences = [signed(number, words) for number, words in enumerate(("ball cat", "cat", "ball", "cat ball") * 3)]
    signs = hri.SentenceRecognizer().fit([tracks for tracks, _ in sentences], [spans for _, spans in sentences])
    signs.save(tmp_path / "signs.hri")
    tracks, _ = signed(50, "cat ball")
    frames = np.concatenate([tracks, np.repeat(tracks[-1:], 40, axis=0), tracks])
    frames[10, 2] = np.nan  # the head out of sight
    stream, expected = SentenceStream(signs), []
    for event in [*(stream.push(frame, number / 25) for number, frame in enumerate(frames)), stream.finish()]:
        if event is not None and event.kind in ("partial", "end"):
            words = [w if i < event.num_stable else f"[{w}]" for i, w in enumerate(event.labels)]
            expected.append("\t".join([{"end": "sentence"}.get(event.kind, "so far"), *words]))
    lines = [" ".join(map(str, (number / 25, *frame.ravel()))) for number, frame in enumerate(frames)]
    (tmp_path / "tracks.txt").write_text("\n".join(lines))
    program = [programs / "read_signs", tmp_path / "signs.hri"]
    with (tmp_path / "tracks.txt").open() as given:
        done = subprocess.run(program, stdin=given, capture_output=True, text=True)
    assert done.returncode == 0 and done.stdout.splitlines() == expected
    assert expected.count("sentence\tcat\tball") == 2
    for bad in ("0.04 1 2 3", "0.04 1 2 3 4 5 6 7", "0.04 1 2 3 4 5 6 seven", ""):
        done = subprocess.run(program, input=f"{lines[0]}\n{bad}\n", capture_output=True, text=True)
        assert done.returncode == 3 and done.stderr == "line 2: expected 7 numbers\n"


def signed(seed: int, text: str) -> tuple[np.ndarray, list[tuple[str, int, int]]]:
    """Synthetic tracks of a sentence, and the frames of its words."""
    rest = [(-30.0, 120.0), (30.0, 120.0)]
    signs = {
        "ball": [[(-40.0, 40.0), (40.0, 40.0)], [(-10.0, 60.0), (10.0, 60.0)]],
        "cat": [[(-30.0, 120.0), (20.0, 10.0)], [(-30.0, 120.0), (60.0, 10.0)]],
    }
    places, spans = [np.array(rest)] * 8, []
    for word in text.split():
        first = len(places)
        for place, frames in zip(signs[word], (5, 12), strict=True):
            places += [places[-1] + (np.array(place) - places[-1]) * t / frames for t in range(1, frames + 1)]
        spans.append((word, first, len(places)))
    places += [np.array(rest)] * 8
    hands = np.array([160, 60]) + np.array(places)
    hands += np.random.default_rng(seed).standard_normal(hands.shape)
    return np.concatenate([hands, np.broadcast_to([160, 60], (len(hands), 1, 2))], axis=1), spans


def test_a_model_is_compiled_into_the_program_of_the_tutorial(installed: Path, spoken: Path, tmp_path: Path) -> None:
    words = hri.train(hri.Dataset.load(spoken), hri.WordRecognizer(num_vtlp_factors=1, num_noisy_copies=0))
    assert isinstance(words, hri.WordRecognizer)
    (tmp_path / "words_model.hpp").write_text(model_as_cpp(words.to_model_file(), "words_model"))
    tutorial = (ROOT / "docs" / "tutorial_cpp.md").read_text(encoding="utf-8")
    (block,) = re.findall(r"```cpp\n(#include \"words_model.hpp\".*?)```", tutorial, re.DOTALL)
    (tmp_path / "program.cpp").write_text(block)
    flags = run("pkg-config", "--cflags", "--libs", "hri-core", PKG_CONFIG_PATH=str(installed / "lib" / "pkgconfig"))
    run("g++", "-std=c++17", tmp_path / "program.cpp", "-o", tmp_path / "program", *flags.split())
    assert run(tmp_path / "program").split() == list(words.classes_)


def test_core_knows_no_opencv(installed: Path) -> None:
    symbols = run("nm", "-C", "--undefined-only", installed / "lib" / "libhri_core.a")
    assert "hri::" in symbols and "cv::" not in symbols
    config = run("pkg-config", "--libs", "hri-core", PKG_CONFIG_PATH=str(installed / "lib" / "pkgconfig"))
    assert "-lhri_core" in config and "opencv" not in config


def test_a_program_builds_with_pkg_config_alone(installed: Path, tmp_path: Path) -> None:
    flags = run(
        *("pkg-config", "--cflags", "--libs", "hri-core"),
        PKG_CONFIG_PATH=str(installed / "lib" / "pkgconfig"),
    ).split()
    source = tmp_path / "version.cpp"
    source.write_text(
        "#include <hri/core/version.hpp>\n#include <hri/signal/wavelet.hpp>\n#include <cstdio>\n"
        'int main() { std::printf("%s %zu\\n", HRI_VERSION, hri::wavelet("db4").dec_lo.size()); }\n'
    )
    run("g++", "-std=c++17", source, "-o", tmp_path / "version", *flags)
    assert run(tmp_path / "version").split() == [hri.__version__, "8"]


def test_a_program_for_this_processor_frees_what_libhri_allocated(installed: Path, tmp_path: Path) -> None:
    """Eigen frees the matrices of AVX code in another way than those of the library, unless both allocate alike."""
    flags = run("pkg-config", "--cflags", "--libs", "hri-core", PKG_CONFIG_PATH=str(installed / "lib" / "pkgconfig"))
    source = ROOT / "examples" / "consumer" / "recognise_word.cpp"
    built = ["g++", "-std=c++17", "-O2", "-march=native", source, "-o", tmp_path / "recognise_word"]
    run(*built, *flags.split())
    clip = speak("one", "en", make_speaker(20))
    write_wav_pcm16(str(tmp_path / "one.wav"), clip.samples, clip.sample_rate_hz)
    for model in sorted((ROOT / "tests" / "py" / "models_v2").glob("words_*.hri")):
        assert run(tmp_path / "recognise_word", model, tmp_path / "one.wav"), model.name
    other = [flag.replace("BYTES=64", "BYTES=16") for flag in flags.split()]
    refused = subprocess.run([str(part) for part in (*built, *other)], capture_output=True, text=True)
    assert refused.returncode != 0 and "EIGEN_MAX_ALIGN_BYTES=64" in refused.stderr


def test_vision_links_with_pkg_config(installed: Path, tmp_path: Path) -> None:
    flags = run("pkg-config", "--cflags", "--libs", "hri-vision", PKG_CONFIG_PATH=str(installed / "lib" / "pkgconfig"))
    source = ROOT / "examples" / "gestures" / "recognise_gesture.cpp"
    run("g++", "-std=c++17", source, "-o", tmp_path / "recognise_gesture", *flags.split())


def test_without_opencv_the_core_is_found_alone(installed: Path, tmp_path: Path) -> None:
    (tmp_path / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.22)\nproject(x LANGUAGES CXX)\nfind_package(hri CONFIG REQUIRED)\n"
        "if(NOT TARGET hri::core OR TARGET hri::vision)\n  message(FATAL_ERROR other targets)\nendif()\n"
    )
    hidden = "-DCMAKE_DISABLE_FIND_PACKAGE_OpenCV=ON"
    run("cmake", "-S", tmp_path, "-B", tmp_path / "build", f"-DCMAKE_PREFIX_PATH={installed}", hidden)


def test_vision_brings_opencv_to_those_who_ask(installed: Path, tmp_path: Path) -> None:
    (tmp_path / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.22)\nproject(x LANGUAGES CXX)\n"
        "find_package(hri CONFIG REQUIRED)\n"
        "add_executable(x x.cpp)\ntarget_link_libraries(x PRIVATE hri::hri)\n"
    )
    (tmp_path / "x.cpp").write_text(
        "#include <hri/vision/silhouette.hpp>\n#include <cstdio>\n#include <vector>\n"
        "int main() {\n  const std::vector<std::uint8_t> wall(3 * 64 * 48, 90);\n"
        '  std::printf("%g\\n", hri::SilhouetteExtractor({}).extract({wall.data(), 64, 48, 3, 192}).quality);\n}\n'
    )
    build = tmp_path / "build"
    run("cmake", "-S", tmp_path, "-B", build, f"-DCMAKE_PREFIX_PATH={installed}")
    run("cmake", "--build", build)
    assert run(build / "x") == "0\n"


def test_missing_component_is_named(installed: Path, tmp_path: Path) -> None:
    (tmp_path / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.22)\nproject(x LANGUAGES CXX)\n"
        "find_package(hri CONFIG REQUIRED COMPONENTS core language)\n"
    )
    done = subprocess.run(
        ["cmake", "-S", str(tmp_path), "-B", str(tmp_path / "build"), f"-DCMAKE_PREFIX_PATH={installed}"],
        capture_output=True,
        text=True,
    )
    assert done.returncode != 0
    assert "language" in done.stderr
