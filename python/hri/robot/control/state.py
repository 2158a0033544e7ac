# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a robot is doing: base, joints, torques, contacts and events, and a log of them as JSON."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, field
from os import PathLike
from typing import Any

from hri.core.display import short_repr
from hri.core.errors import InvalidArgument
from hri.core.files import write_text
from hri.robot.model.joints import Vector

FLOOR = "floor"


@dataclass(frozen=True)
class Contact:
    """A link that touches the floor (`other` is "floor") or another link, and how hard."""

    link: str
    other: str
    force_n: float


@dataclass(frozen=True)
class SelfContact:
    """Two links that touched one another: when for the first and the last time, and how hard at most."""

    link: str
    other: str
    first_s: float
    last_s: float
    force_n: float


class SelfContacts:
    """Collects contacts of links with one another, one entry a pair."""

    def __init__(self) -> None:
        self._found: dict[tuple[str, str], SelfContact] = {}

    def add(self, contact: Contact, time_s: float) -> None:
        """Note a contact of this moment."""
        pair = (contact.link, contact.other)
        before = self._found.get(pair)
        first_s = time_s if before is None else before.first_s
        force_n = contact.force_n if before is None else max(contact.force_n, before.force_n)
        self._found[pair] = SelfContact(*pair, first_s, time_s, force_n)

    def found(self) -> list[SelfContact]:
        """By time of the first contact."""
        return list(self._found.values())


@dataclass(frozen=True)
class Event:
    """Something that ended a motion: `kind` is "stop", "fall", or "fault", a robot that takes no commands.

    "lag" ends none: a joint could not follow, for longer than a quarter of a second, at its greatest torque.
    """

    time_s: float
    kind: str
    message: str

    @property
    def ended_motion(self) -> bool:
        """Whether the motion under way ended by it."""
        return self.kind != "lag"


@dataclass(frozen=True)
@short_repr
class RobotState:
    """One moment.

    Attributes
    ----------
    time_s : float
        Since the robot was opened, in its own time.
    base_position_m, base_rpy_rad : three floats
        Origin of the base link's frame in the world; roll, pitch and yaw.
    positions_rad, torques_n_m : dict of joint name to float
        No torques without physics.
    contacts : tuple of Contact
        One for each pair that touches, the first link by name first; none without physics.
    """

    time_s: float
    base_position_m: Vector
    base_rpy_rad: Vector
    positions_rad: dict[str, float]
    torques_n_m: dict[str, float] = field(default_factory=dict)
    contacts: tuple[Contact, ...] = ()


class MotionLog:
    """Collects states while a robot moves.

    Parameters
    ----------
    period_s : float
        Time between two states, above 0.
    """

    def __init__(self, period_s: float = 0.01) -> None:
        if not 0.0 < period_s < float("inf"):
            raise InvalidArgument(f"period_s is {period_s}, must be above 0 and finite")
        self.period_s = period_s
        self.states: list[RobotState] = []
        self.events: list[Event] = []
        self.touched = SelfContacts()

    def as_dict(self) -> dict[str, Any]:
        """What `write` writes."""
        return {
            "period_s": self.period_s,
            "events": [asdict(event) for event in self.events],
            "self_contacts": [asdict(contact) for contact in self.touched.found()],
            "states": [asdict(state) for state in self.states],
        }

    def write(self, path: str | PathLike[str]) -> None:
        """Write everything as JSON; the file appears whole or not at all, IoError if it fails."""
        write_text(path, json.dumps(self.as_dict()) + "\n")
