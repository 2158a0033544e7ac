# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""trajectory_msgs/JointTrajectory in MCAP as ROS 2 records it, in CDR, by mcap-ros2-support (the extra "mcap")."""

from __future__ import annotations

import io
from collections.abc import Iterator
from typing import Any

from hri.core.errors import FormatError
from hri.core.mcap_records import mcap_records
from hri.core.optional import import_optional
from hri.core.ros2_messages import DEFINITIONS, ENCODING, message_decoder, message_definition, message_type

NAME = "trajectory_msgs/JointTrajectory"
MESSAGE_TYPE = message_type(NAME)
TOPIC = "/joint_trajectory"

_COUNTED = "std_msgs/Header header\nstring[] joint_names\nuint32 num_points"  # what stands before the points


def mcap_of_message(message: dict[str, Any]) -> bytes:
    """An MCAP file of ROS 2 that holds one message, at time 0; the same message gives the same bytes."""
    writer_of = import_optional("mcap_ros2.writer", "mcap", "to write a motion as MCAP")
    out = io.BytesIO()
    with writer_of.Writer(out) as writer:
        definition = writer.register_msgdef(MESSAGE_TYPE, message_definition(DEFINITIONS[NAME]))
        writer.write_message(TOPIC, definition, message, log_time=0, publish_time=0)
    return out.getvalue()


def message_of_mcap(data: bytes, name: str, max_bytes: int, max_points: int) -> dict[str, Any]:
    """The only JointTrajectory of an MCAP file, as `joint_trajectory_message` has it.

    Raises
    ------
    FormatError
        For a file, named `name`, that is no MCAP, is damaged, holds none or several, holds more than `max_bytes` once
        decompressed, or more than `max_points` in the message.
    """
    import_optional("mcap_ros2", "mcap", "to read a motion from MCAP")
    try:
        found = list(_messages(data, max_bytes))
        if len(found) != 1:
            raise FormatError(f"{name}: holds {len(found)} messages {MESSAGE_TYPE} in CDR, must be one")
        num_points = message_decoder(NAME, _COUNTED)(found[0]).num_points
        if num_points > max_points:  # each of which would be an object, before anything looks at it
            raise FormatError(f"{name}: points: {num_points}, must be 1 to {max_points}")
        return _message(message_decoder(NAME)(found[0]))
    except FormatError:
        raise
    except Exception as error:  # the libraries raise many kinds for what is damaged
        raise FormatError(f"{name}: not an MCAP file of a motion: {type(error).__name__}: {error}") from error


def _messages(data: bytes, max_bytes: int) -> Iterator[bytes]:
    """What the channels of JointTrajectory hold."""
    from mcap.records import Channel, Message, Schema

    schemas: dict[int, str] = {}
    ours: set[int] = set()
    for record in mcap_records(io.BytesIO(data), max_bytes, max_bytes):
        if isinstance(record, Schema):
            schemas[record.id] = record.name
        elif isinstance(record, Channel):
            if record.message_encoding == ENCODING and schemas.get(record.schema_id) == MESSAGE_TYPE:
                ours.add(record.id)
        elif isinstance(record, Message) and record.channel_id in ours:
            yield record.data


def _message(decoded: Any) -> dict[str, Any]:
    points = [
        {
            "positions": point.positions,
            "velocities": point.velocities,
            "time_from_start": {"sec": point.time_from_start.sec, "nanosec": point.time_from_start.nanosec},
        }
        for point in decoded.points
    ]
    return {"joint_names": decoded.joint_names, "points": points}
