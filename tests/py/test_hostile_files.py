# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Whatever a text file holds, its reader gives a value or one of hri's errors, in little time.

Files that are sound are changed by tokens that readers may stumble over. HRI_EXAMPLES sets how many are tried of each.
"""

from __future__ import annotations

import contextlib
import json
import os
import re
import tempfile
import time
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from file_kinds import CONDITIONS, KEPT, READERS, TRACK, WRITERS, write_sentences
from hri.cli.recognizers import parse_options
from hri.core.errors import Error
from hri.core.files import parse_csv, parse_json, parse_toml
from hri.datasets import Dataset
from hri.io import ModelFile
from hri.media import read_audio, read_frames
from hri.models import KnnClassifier
from hri.robot import check_pulse_csv, gesture_trajectory
from hri.robot.motion.gestures import parse_gestures
from hri.robot.motion.pulse_csv import write_pulse_csv
from hri.robot.motion.repair import repair_pulse_csv
from hri.robot.motion.short_csv import check_short_csv, write_short_csv
from hri.robot.motion.trajectory import Trajectory

EXAMPLES = int(os.environ.get("HRI_EXAMPLES", "60"))
hostile = settings(
    max_examples=EXAMPLES,
    deadline=60_000,  # what waits; what computes is measured by only_hri_s_errors
    derandomize="HRI_EXAMPLES" not in os.environ,
    database=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)

TOKENS = [
    *(b"", b"\0", b"\xf8", b"\xff\xfe", b"\x1c", b"\x1f", b"\x85", b"\xef\xbb\xbf", b"\xed\xa0\x80", b"\r", b"\n\n"),
    *(
        b'"',
        b"'",
        b"'''",
        b'"""',
        b"\\",
        b"\\u0000",
        b"\\ud800",
        b",",
        b",,",
        b"-",
        b"+",
        b".",
        b"..",
        b"/",
        b"=",
        b"#",
    ),
    *(b"nan", b"inf", b"-inf", b"1e999", b"1e308", b"-1e308", b"1_0", b"0", b"-0", b"1e-320", b"0x10", b"true", b"R"),
    *(
        b"60",
        b"999999999",
        b"2147483648",
        b"9223372036854775808",
        b"9" * 400,
        b"9" * 5000,
        b"0x" + b"f" * 9000,
        "१".encode(),
        b"2026-02-30",
    ),
    *(b"[", b"]", b"[]", b"{", b"}", b"{}", b"[[", b"[" * 3000, b"{a=" * 3000, b'{"a":' * 3000, b"a.b.c = 1", b"12:00"),
    *(b"{label}", b"{person}{take}", b"(?P<a>", b"\xe2\x80\xa8", b"a" * 200_000, b"time_s", b"larm_joint_1", b"keys"),
]


@st.composite
def changed(draw: st.DrawFn, whole: bytes) -> bytes:
    """`whole` with one to four tokens of it, or places between them, replaced; or cut."""
    pieces = re.split(rb"([^\w.]+)", whole)
    for _ in range(draw(st.integers(1, 4))):
        place = draw(st.integers(0, len(pieces) - 1))
        token = draw(st.sampled_from(TOKENS) | st.binary(max_size=4))
        pieces[place] = draw(st.sampled_from([token, pieces[place] + token, token + pieces[place]]))
    data = b"".join(pieces)
    return data[: draw(st.integers(0, len(data)))] if draw(st.integers(0, 9)) == 0 else data


def only_hri_s_errors(read: Callable[[], object]) -> None:
    """Nothing else is raised, and within two seconds of processor time, so that a busy machine changes nothing."""
    begun = time.process_time()
    with contextlib.suppress(Error):
        read()
    assert time.process_time() - begun < 2, "it hangs"


@pytest.fixture(scope="module")
def motions(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """Few rows of a motion in either form."""
    folder = tmp_path_factory.mktemp("motions")
    wave = gesture_trajectory("wave")
    rows = Trajectory(wave.joint_names, wave.period_s, wave.positions_rad[:6])
    write_pulse_csv(folder / "pulses.csv", rows)
    write_short_csv(folder / "degrees.csv", rows)
    return {path.name: path.read_bytes() for path in folder.iterdir()}


@hostile
@given(data=st.data())
def test_pulses(tmp_path: Path, motions: dict[str, bytes], data: st.DataObject) -> None:
    path = tmp_path / "pulses.csv"
    path.write_bytes(data.draw(changed(motions["pulses.csv"])))
    only_hri_s_errors(lambda: READERS["pulses.csv"](path))
    only_hri_s_errors(lambda: check_pulse_csv(path))
    only_hri_s_errors(lambda: repair_pulse_csv(path, tmp_path / "repaired.csv"))


@hostile
@given(data=st.data())
def test_degrees(tmp_path: Path, motions: dict[str, bytes], data: st.DataObject) -> None:
    path = tmp_path / "degrees.csv"
    path.write_bytes(data.draw(changed(motions["degrees.csv"])))
    only_hri_s_errors(lambda: READERS["degrees.csv"](path))
    only_hri_s_errors(lambda: check_short_csv(path))


@hostile
@given(text=changed(TRACK.encode()))
def test_tracks(tmp_path: Path, text: bytes) -> None:
    (tmp_path / "track.csv").write_bytes(text)
    only_hri_s_errors(lambda: READERS["track.csv"](tmp_path / "track.csv"))


MANIFESTS = (
    b'format_version = 1\nkind = "speech"\nname = "a"\nlabels = ["go"]\nsynthetic = true\n[made_by]\nseed = 1\n'
    b'[[samples]]\npath = "go.wav"\nlabel = "go"\nperson = "ann"\ntake = "1"\n',
    b'kind = "gesture"\npattern = "{label}/{person}_{take}.jpg"\nlabels = []\n',
)


@hostile
@given(text=st.sampled_from(MANIFESTS).flatmap(changed))
def test_manifests(tmp_path: Path, text: bytes) -> None:
    (tmp_path / "go.wav").touch()
    (tmp_path / "dataset.toml").write_bytes(text)
    only_hri_s_errors(lambda: Dataset.load(tmp_path))


GESTURES = b"""period_s = 0.01
speed_rad_s = 3.0
acceleration_rad_s2 = 20.0
least_move_s = 0.45
[arms]
down = [80, 8, 0, -18]
flat = { at_cm = [14, 0, -7], elbow = 45, hand = 60 }
[[gesture]]
name = "1"
meaning = "right arm low"
lacks = "fingers"
keys = [{ right = [90, 48, 0, 0, 0], left = "flat", head = [0, 5], hold_s = 0.8, slower = 2.0 }]
"""


@hostile
@given(text=changed(GESTURES))
def test_gestures(text: bytes) -> None:
    def read() -> None:
        for gesture in parse_gestures(text.decode("utf-8", "replace")).values():
            assert np.isfinite(gesture.trajectory().positions_rad).all()

    only_hri_s_errors(read)


@hostile
@given(name=st.sampled_from(["hands.csv", "words.csv", "signers.csv"]), data=st.data())
def test_sentences(tmp_path: Path, name: str, data: st.DataObject) -> None:
    write_sentences(tmp_path)
    path = tmp_path / name
    path.write_bytes(data.draw(changed(path.read_bytes())))
    only_hri_s_errors(lambda: READERS["signers.csv"](tmp_path / "signers.csv"))


@hostile
@given(kept=changed(KEPT.encode()), conditions=changed(CONDITIONS.encode()))
def test_files_of_studies(tmp_path: Path, kept: bytes, conditions: bytes) -> None:
    (tmp_path / "kept.json").write_bytes(kept)
    (tmp_path / "conditions.toml").write_bytes(conditions)
    only_hri_s_errors(lambda: READERS["kept.json"](tmp_path / "kept.json"))
    only_hri_s_errors(lambda: READERS["conditions.toml"](tmp_path / "conditions.toml"))


@hostile
@given(text=st.text() | changed(MANIFESTS[0]).map(lambda data: data.decode("utf-8", "surrogateescape")))
def test_plain_parsers(text: str) -> None:
    for parse in (parse_toml, parse_json, parse_csv):
        only_hri_s_errors(lambda parse=parse: parse(text, "here"))
    only_hri_s_errors(lambda: parse_options([f"cepstra.num_filters={text}", f"{text}=1"]))


MEDIA = ("sound.wav", "picture.png", "picture.jpg", "clip.avi", "clip.mp4", "clip.webm", "clip.mkv")


@cache
def media() -> dict[str, bytes]:
    """Small sounds, pictures and videos."""
    with tempfile.TemporaryDirectory() as folder:
        for name in MEDIA:
            WRITERS[name](Path(folder, name))
        return {name: Path(folder, name).read_bytes() for name in MEDIA}


CHANGES = st.tuples(st.floats(0.0, 1.0), st.integers(0, 4), st.sampled_from(TOKENS[:30]) | st.binary(max_size=4))


@hostile
@given(name=st.sampled_from(MEDIA), near=st.integers(16, 20_000), changes=st.lists(CHANGES, max_size=5))
def test_sounds_pictures_and_videos(
    tmp_path: Path, name: str, near: int, changes: list[tuple[float, int, bytes]]
) -> None:
    """Bytes of the first `near` of a file are replaced or left out, others come between."""
    data = bytearray(media()[name])
    for place, length, token in changes:
        at = int(place * min(near, len(data)))
        data[at : at + length] = token
    (tmp_path / name).write_bytes(data)
    only_hri_s_errors(lambda: (read_audio if name == "sound.wav" else read_frames)(tmp_path / name))


JSON = st.recursive(
    st.none()
    | st.booleans()
    | st.integers()
    | st.floats()
    | st.text()
    | st.sampled_from(
        ["str", "int", "float", "bool", "O", "<U4", "|O", "<i8", "U999999999", "V8", "(1", "a,b", 10**400]
    ),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=5), inner, max_size=4),
    max_leaves=6,
)


@cache
def classifier() -> bytes:
    rows = np.random.default_rng(0).normal(size=(12, 3))
    return KnnClassifier(num_neighbours=1).fit(rows, ["a", "b", "c"] * 4).to_model_file().to_bytes()


@hostile
@given(field=st.sampled_from(["params", "classes", "kind"]), name=st.text(max_size=3), value=JSON)
def test_texts_in_models(field: str, name: str, value: Any) -> None:
    """With a checksum that fits, as one who knows the format makes it."""
    for change in (value, {name: value}, None):
        file = ModelFile.from_bytes(classifier())
        held = json.loads(file.text(field)) if field != "kind" else file.kind
        if change is None:
            change = {**held, data_key(held, name): value} if isinstance(held, dict) else [held, value]
        file.set_text(field, json.dumps(change))
        only_hri_s_errors(lambda file=file: KnnClassifier.from_model_file(file))


def data_key(held: dict[str, Any], name: str) -> str:
    """A key that is there, chosen by `name`."""
    return sorted(held)[sum(map(ord, name)) % len(held)]


def test_model_with_a_tensor_that_nobody_knows_is_refused() -> None:
    file = ModelFile.from_bytes(classifier())
    file.set_matrix_d("model.extra", np.zeros((2, 2)))
    with pytest.raises(Error, match=r"extra.*unknown"):
        KnnClassifier.from_model_file(ModelFile.from_bytes(file.to_bytes()))
