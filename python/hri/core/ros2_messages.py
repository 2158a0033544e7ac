# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Messages of ROS 2 that files hold: their definitions, and CDR by mcap-ros2-support (the extra "mcap")."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import Any

from hri.core.optional import import_optional

ENCODING, SCHEMA_ENCODING = "cdr", "ros2msg"
"""Of channels and schemas of MCAP."""

DEFINITIONS = {
    "audio_common_msgs/AudioData": "uint8[] data",
    "audio_common_msgs/AudioInfo": "uint8 channels\nuint32 sample_rate\nstring sample_format\nuint32 bitrate\n"
    "string coding_format",
    "builtin_interfaces/Duration": "int32 sec\nuint32 nanosec",
    "builtin_interfaces/Time": "int32 sec\nuint32 nanosec",
    "sensor_msgs/CompressedImage": "std_msgs/Header header\nstring format\nuint8[] data",
    "sensor_msgs/JointState": "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\n"
    "float64[] effort",
    "std_msgs/Header": "builtin_interfaces/Time stamp\nstring frame_id",
    "trajectory_msgs/JointTrajectory": "std_msgs/Header header\nstring[] joint_names\n"
    "trajectory_msgs/JointTrajectoryPoint[] points",
    "trajectory_msgs/JointTrajectoryPoint": "float64[] positions\nfloat64[] velocities\n"
    "float64[] accelerations\nfloat64[] effort\nbuiltin_interfaces/Duration time_from_start",
}
_END = "\n" + "=" * 80 + "\n"
_PART = re.compile(r"^(\w+/\w+)(?:\[\])? ", re.MULTILINE)


def message_type(name: str) -> str:
    """The full name, as of schemas in MCAP: of "std_msgs/Header" it is "std_msgs/msg/Header"."""
    return name.replace("/", "/msg/")


def message_definition(text: str) -> str:
    """A definition, by its own text, with those of all that it is made of."""
    parts, names = [text], _PART.findall(text)
    for name in names:  # grows on the way
        parts.append(f"MSG: {name}\n{DEFINITIONS[name]}")
        names += [inner for inner in _PART.findall(DEFINITIONS[name]) if inner not in names]
    return _END.join(parts)


def message_encoder(name: str) -> Callable[[Mapping[str, Any]], bytes]:
    """What makes CDR of the fields of a message. Raises ImportError without mcap-ros2-support."""
    writer = import_optional("mcap_ros2.writer", "mcap", "to write messages of ROS 2")
    encode: Callable[[Mapping[str, Any]], bytes] = writer.serialize_dynamic(
        message_type(name), message_definition(DEFINITIONS[name])
    )[message_type(name)]
    return encode


def message_decoder(name: str, text: str | None = None) -> Callable[[bytes], Any]:
    """What reads CDR by our definition, or by another `text`, whatever a file says of its own.

    Fields of the message are attributes of what it gives; bytes that are missing at the end of an array are missing
    there, other damage raises an exception of any kind. Raises ImportError without mcap-ros2-support.
    """
    decoder = import_optional("mcap_ros2.decoder", "mcap", "to read messages of ROS 2")
    from mcap.records import Schema

    definition = message_definition(DEFINITIONS[name] if text is None else text)
    schema = Schema(id=1, name=message_type(name), encoding=SCHEMA_ENCODING, data=definition.encode())
    decode: Callable[[bytes], Any] = decoder.DecoderFactory().decoder_for(ENCODING, schema)
    return decode
