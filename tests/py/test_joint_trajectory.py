# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Motions as JointTrajectory of ROS 2, in JSON and MCAP: other people's readers agree, hostile files are refused."""

from __future__ import annotations

import contextlib
import io
import json
import struct
import tempfile
import time
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import CubicHermiteSpline

from hri.core.errors import Error, FormatError, InvalidArgument
from hri.robot import (
    HOAP2,
    NAO,
    Trajectory,
    check_trajectory,
    gesture_trajectory,
    joint_trajectory_message,
    load_gestures,
    nao_gesture_trajectory,
    open_robot,
    read_joint_trajectory,
    trajectory_of_message,
    write_joint_trajectory,
)
from hri.robot.motion.joint_trajectory import MAX_BYTES
from hri.robot.motion.joint_trajectory_mcap import MESSAGE_TYPE, TOPIC
from test_hostile_files import hostile

mcap_reader = pytest.importorskip("mcap.reader")
mcap_ros2 = pytest.importorskip("mcap_ros2.decoder")
SUFFIXES = (".json", ".mcap")


def part(rows: int = 6) -> Trajectory:
    """The beginning of a gesture, of which every file is small."""
    wave = gesture_trajectory("wave")
    return Trajectory(wave.joint_names[:3], wave.period_s, wave.positions_rad[:rows, :3])


@pytest.mark.parametrize("suffix", SUFFIXES)
@pytest.mark.parametrize("table", [HOAP2, NAO], ids=["hoap2", "nao"])
def test_a_gesture_comes_back_to_the_bit_and_is_played(tmp_path: Path, suffix: str, table: Any) -> None:
    motion = gesture_trajectory("wave") if table is HOAP2 else nao_gesture_trajectory("wave")
    path = tmp_path / f"wave{suffix}"
    write_joint_trajectory(path, motion)
    back = read_joint_trajectory(path)
    assert back.joint_names == motion.joint_names and back.period_s == motion.period_s
    assert np.array_equal(back.positions_rad, motion.positions_rad)
    assert check_trajectory(back, table) == []
    with open_robot("kinematic", table=table) as robot:
        assert robot.perform(back)
        assert robot.joint_positions_rad()[motion.joint_names[0]] == pytest.approx(
            motion.positions_rad[-1, 0], abs=1e-3
        )


def between_points(motion: Trajectory) -> Trajectory:
    """What controllers make of the points: cubics through positions and velocities, a thousand times a second."""
    velocities = [point["velocities"] for point in joint_trajectory_message(motion)["points"]]
    cubics = CubicHermiteSpline(motion.period_s * np.arange(len(motion)), motion.positions_rad, velocities)
    return Trajectory(motion.joint_names, 0.001, cubics(0.001 * np.arange(round(1000 * motion.duration_s) + 1)))


def test_what_controllers_interpolate_between_the_points_passes_the_check() -> None:
    assert check_trajectory(between_points(gesture_trajectory("9"))) == []
    assert check_trajectory(between_points(nao_gesture_trajectory("9")), NAO) == []


@pytest.mark.slow
def test_so_does_what_they_interpolate_of_all_gestures() -> None:
    errors = []
    for table, gesture in ((HOAP2, gesture_trajectory), (NAO, nao_gesture_trajectory)):
        for name in load_gestures():
            findings = check_trajectory(between_points(gesture(name)), table)
            errors += [(table.name, name, str(found)) for found in findings if found.severity == "error"]
    assert errors == []


@pytest.mark.parametrize("period_s", [0.001, 1 / 30, 0.04, 7.3])
def test_times_are_whole_nanoseconds_and_rates_central_differences(period_s: float) -> None:
    positions = np.random.default_rng(0).normal(size=(40, 2))
    message = joint_trajectory_message(Trajectory(["a", "b"], period_s, positions))
    times = [point["time_from_start"] for point in message["points"]]
    seconds = np.array([time["sec"] + 1e-9 * time["nanosec"] for time in times])
    np.testing.assert_allclose(seconds, period_s * np.arange(40), rtol=0, atol=1e-9)
    velocities = np.array([point["velocities"] for point in message["points"]])
    np.testing.assert_allclose(velocities[1:-1], np.gradient(positions, period_s, axis=0)[1:-1], rtol=1e-12)
    assert not velocities[[0, -1]].any(), "at rest at both ends"
    back = trajectory_of_message(json.loads(json.dumps(message)))
    assert np.array_equal(back.positions_rad, positions)
    assert back.period_s == pytest.approx(period_s, rel=1e-6)


def test_other_readers_of_mcap_find_the_same_message(tmp_path: Path) -> None:
    typesys = pytest.importorskip("rosbags.typesys")
    path, motion = tmp_path / "wave.mcap", gesture_trajectory("wave")
    write_joint_trajectory(path, motion)
    message = joint_trajectory_message(motion)
    with path.open("rb") as file:
        reader = mcap_reader.make_reader(file, validate_crcs=True, decoder_factories=[mcap_ros2.DecoderFactory()])
        ((schema, channel, record, decoded),) = reader.iter_decoded_messages()
        assert reader.get_header().profile == "ros2"
    assert (schema.name, schema.encoding) == (MESSAGE_TYPE, "ros2msg")
    assert (channel.topic, channel.message_encoding) == (TOPIC, "cdr")
    other = typesys.get_typestore(typesys.Stores.ROS2_HUMBLE).deserialize_cdr(record.data, MESSAGE_TYPE)
    for found in (decoded, other):
        assert list(found.joint_names) == message["joint_names"] and found.header.stamp.sec == 0
        assert len(found.points) == len(message["points"])
        for point, expected in zip(found.points, message["points"], strict=True):
            assert list(point.positions) == expected["positions"]
            assert list(point.velocities) == expected["velocities"]
            assert len(point.accelerations) == len(point.effort) == 0
            time = point.time_from_start
            assert {"sec": time.sec, "nanosec": time.nanosec} == expected["time_from_start"]


def raw(path: Path) -> bytes:
    """The bytes of the only message."""
    with path.open("rb") as file:
        ((_, _, message),) = mcap_reader.make_reader(file).iter_messages()
    return message.data


def points(times_s: list[float], positions: Any, velocities: Any = None) -> dict[str, Any]:
    made = []
    for row, time_s in enumerate(times_s):
        ns = round(time_s * 1e9)
        stamp = {"sec": ns // 10**9, "nanosec": ns % 10**9}
        made.append({"positions": list(map(float, positions[row])), "time_from_start": stamp})
        if velocities is not None:
            made[-1]["velocities"] = list(map(float, velocities[row]))
    return {"joint_names": ["a", "b"], "points": made}


def test_points_at_uneven_times_are_interpolated_as_controllers_do() -> None:
    """As a planner gives them: the last step is shorter, the first point is to be reached after a while."""
    times = np.array([0.5, 0.6, 0.7, 1.13])
    positions, velocities = np.random.default_rng(1).normal(size=(2, 4, 2))
    smooth = trajectory_of_message(points(times.tolist(), positions, velocities))
    straight = trajectory_of_message(points(times.tolist(), positions))
    at = 0.5 + smooth.period_s * np.arange(len(smooth))
    assert len(smooth) == len(straight) == 64 and smooth.period_s <= 0.01 and at[-1] == pytest.approx(1.13)
    np.testing.assert_allclose(smooth.positions_rad, CubicHermiteSpline(times, positions, velocities)(at), atol=1e-9)
    for joint in range(2):
        np.testing.assert_allclose(
            straight.positions_rad[:, joint], np.interp(at, times, positions[:, joint]), atol=1e-9
        )


def test_single_point_is_a_single_row() -> None:
    assert trajectory_of_message(points([2.0], [[0.1, 0.2]])).positions_rad.tolist() == [[0.1, 0.2]]


def changed(**fields: Any) -> dict[str, Any]:
    message = joint_trajectory_message(part())
    for name, value in fields.items():
        (message if name in message else message["points"][2])[name] = value
    return message


STAMP = {"sec": 0, "nanosec": 20_000_000}


@pytest.mark.parametrize(
    ("message", "says"),
    [
        ([], "m: must be an object"),
        ({}, "m: joint_names: must be a list"),
        (changed(points={}), "m: points: must be a list"),
        (changed(points=[]), "m: points: 0, must be 1 to 500000"),
        (changed(points=[{}] * 500_001), "m: points: 500001, must be 1 to 500000"),
        (changed(joint_names=["a", "a", "b"]), "m: joint_names names a joint twice"),
        (changed(joint_names=["a", 1, "b"]), "m: joint_names is"),
        (changed(joint_names=["a"]), "m: point 1: positions: has 3 numbers, joint_names has 1"),
        (changed(positions=[0.0]), "m: point 3: positions: has 1 numbers, joint_names has 3"),
        (changed(positions=None), "m: point 3: positions: must be a list of numbers"),
        (changed(positions=[0, True, 0]), "m: point 3: positions: must be a list of numbers"),
        (changed(positions=[0, "1", 0]), "m: point 3: positions: must be a list of numbers"),
        (changed(positions=[0, 10**400, 0]), "m: point 3: positions: has a number that is not finite"),
        (changed(positions=[0, float("nan"), 0]), "m: point 3: positions: has a number that is not finite"),
        (changed(velocities=[0.0]), "m: point 3: velocities: has 1 numbers"),
        (changed(velocites=[0.0]), "m: point 3: no field velocites"),
        (changed(time_from_start=0.02), "m: point 3: time_from_start: must be an object"),
        (changed(time_from_start={"secs": 0, "nsecs": 1}), "m: point 3: time_from_start: no field nsecs, secs"),
        (changed(time_from_start={**STAMP, "sec": -1}), "m: point 3: time_from_start: must be sec"),
        (changed(time_from_start={**STAMP, "nanosec": 10**9}), "m: point 3: time_from_start: must be sec"),
        (changed(time_from_start={**STAMP, "sec": 2**31}), "m: point 3: time_from_start: must be sec"),
        (changed(time_from_start={**STAMP, "nanosec": 10**7}), "m: point 3: time_from_start: is not after"),
        (points([0, 1, 2**31 - 1], np.zeros((3, 2))), "m: 2.14748e[+]09 s of points at uneven times are too many"),
    ],
)
def test_message_that_is_none_is_refused_by_point_and_field(message: Any, says: str) -> None:
    with pytest.raises(FormatError, match=f"^{says}"):
        trajectory_of_message(message, "m")


def test_what_no_message_holds_is_not_written(tmp_path: Path) -> None:
    with pytest.raises(InvalidArgument, match="row 2: a position is not known"):
        write_joint_trajectory(tmp_path / "a.json", Trajectory(["a"], 0.1, [[0.0], [np.nan]]))
    with pytest.raises(InvalidArgument, match="lasts 3"):
        joint_trajectory_message(Trajectory(["a"], 3600.0, np.zeros((900_000, 1))))
    for refused in (lambda path: write_joint_trajectory(path, part()), read_joint_trajectory):
        with pytest.raises(InvalidArgument, match=r"a\.yaml: suffix must be"):
            refused(tmp_path / "a.yaml")
    assert list(tmp_path.iterdir()) == []


@cache
def files() -> dict[str, bytes]:
    """A motion as either file."""
    with tempfile.TemporaryDirectory() as folder:
        for suffix in SUFFIXES:
            write_joint_trajectory(Path(folder, f"motion{suffix}"), part())
        return {suffix: Path(folder, f"motion{suffix}").read_bytes() for suffix in SUFFIXES}


@hostile
@given(suffix=st.sampled_from(SUFFIXES), places=st.lists(st.tuples(st.floats(0, 1), st.binary(max_size=4)), max_size=4))
def test_whatever_a_file_holds_it_gives_a_motion_or_an_error(
    tmp_path: Path, suffix: str, places: list[tuple[float, bytes]]
) -> None:
    path = tmp_path / f"motion{suffix}"
    data = bytearray(files()[suffix])
    for place, token in places:
        at = int(place * len(data))
        data[at : at + len(token)] = token
    path.write_bytes(data)
    begun = time.process_time()
    with contextlib.suppress(Error):
        read_joint_trajectory(path)
    assert time.process_time() - begun < 2


def mcap_of(messages: list[bytes], name: str = MESSAGE_TYPE, compression: str = "ZSTD", encoding: str = "cdr") -> bytes:
    from mcap.writer import CompressionType, Writer

    out = io.BytesIO()
    writer = Writer(out, compression=CompressionType[compression])
    writer.start("ros2", "someone else")
    channel = writer.register_channel("/any", encoding, writer.register_schema(name, "ros2msg", b"uint8 other"))
    for number, data in enumerate(messages):
        writer.add_message(channel, number, data, number)
    writer.finish()
    return out.getvalue()


def test_files_of_others_are_read_by_what_the_message_is_and_not_by_what_they_say_of_it(tmp_path: Path) -> None:
    path = tmp_path / "other.mcap"
    path.write_bytes(files()[".mcap"])
    data = raw(path)
    for compression in ("NONE", "LZ4", "ZSTD"):
        path.write_bytes(mcap_of([data], compression=compression))
        assert np.array_equal(read_joint_trajectory(path).positions_rad, part().positions_rad)
    many = bytearray(data)
    at = data.index(struct.pack("<I", 6), 40)  # the number of points
    many[at : at + 4] = b"\xff\xff\xff\xff"
    whole = mcap_of([data])
    for wrong, says in (
        (mcap_of([]), "holds 0 messages"),
        (mcap_of([data, data]), "holds 2 messages"),
        (mcap_of([data], "std_msgs/msg/String"), "holds 0 messages"),
        (mcap_of([data], encoding="json"), "holds 0 messages"),
        (mcap_of([data[:50]]), "not an MCAP file of a motion"),
        (mcap_of([b""]), "not an MCAP file of a motion"),
        (mcap_of([bytes(many)]), "points: 4294967295, must be 1 to 500000"),
        (whole[: len(whole) // 2], "not an MCAP file of a motion"),
        (b"", "not an MCAP file of a motion"),
    ):
        path.write_bytes(wrong)
        with pytest.raises(FormatError, match=rf"other\.mcap: {says}"):
            read_joint_trajectory(path)


@pytest.mark.parametrize("compression", ["LZ4", "ZSTD"])
@pytest.mark.parametrize("honest", [True, False])
def test_chunk_that_unfolds_to_more_than_a_file_may_hold_is_refused_at_once(
    tmp_path: Path, compression: str, honest: bool
) -> None:
    from mcap.records import Chunk
    from mcap.stream_reader import StreamReader

    vast = mcap_of([bytes(MAX_BYTES if honest else 1 << 22)], compression=compression)
    if not honest:
        records = StreamReader(io.BytesIO(vast), emit_chunks=True).records
        size = next(record.uncompressed_size for record in records if isinstance(record, Chunk))
        vast = vast.replace(struct.pack("<Q", size), struct.pack("<Q", 1024), 1)
    path = tmp_path / "vast.mcap"
    path.write_bytes(vast)
    begun = time.process_time()
    with pytest.raises(FormatError, match=r"holds more than|a chunk holds 1025 bytes or more"):
        read_joint_trajectory(path)
    assert time.process_time() - begun < 1
