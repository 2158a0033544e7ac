# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The joints and links of the robots, read from hoap2.toml and nao.toml: the one place that knows them."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import cached_property
from importlib import resources
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.display import short_repr, summary
from hri.core.errors import InvalidArgument
from hri.core.suggest import did_you_mean

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class Shape:
    """A box, sphere or capsule in its link's frame.

    Attributes
    ----------
    kind : "box", "sphere" or "capsule"
    start, end : three floats, m
        The axis of a capsule; both are the centre of a box or a sphere.
    size : three floats, m
        Edges of a box, else zeros.
    radius : float, m
        Of a sphere or capsule, else 0.
    colour : three floats, 0..1
        Red, green, blue.
    solid : bool
        Takes part in collisions.
    """

    kind: str
    start: Vector
    end: Vector
    size: Vector
    radius: float
    colour: Vector
    solid: bool


@dataclass(frozen=True)
@short_repr
class Link:
    """A rigid part: mass, centre of mass, inertia (ixx iyy izz ixy ixz iyz) and shapes."""

    name: str
    mass_kg: float
    com_m: Vector
    inertia_kg_m2: tuple[float, ...]
    shapes: tuple[Shape, ...]

    @property
    def solid(self) -> tuple[Shape, ...]:
        """The shapes that take part in collisions."""
        return tuple(shape for shape in self.shapes if shape.solid)


@dataclass(frozen=True)
class Joint:
    """A revolute joint and the link it carries.

    Attributes
    ----------
    name, meaning, parent, child : str
    axis, origin_m : three floats
        In the parent's frame.
    lower_rad, upper_rad : float
    rest_rad : float
        Where it is when nothing is to do.
    column : str
        Letter of its column in a pulse CSV, as a spreadsheet names it; empty for a robot that has no such files.
    pulses_per_degree : int or None
        Signed; None where no counter is known.
    link : Link
        The child.
    """

    name: str
    meaning: str
    parent: str
    child: str
    axis: Vector
    origin_m: Vector
    lower_rad: float
    upper_rad: float
    rest_rad: float
    column: str
    pulses_per_degree: int | None
    link: Link

    @property
    def column_index(self) -> int:
        """Index of `column`, A being 0."""
        index = 0
        for letter in self.column:
            index = index * 26 + ord(letter) - ord("A") + 1
        return index - 1


@dataclass(frozen=True)
class Camera:
    """A camera that is part of a robot.

    Attributes
    ----------
    name, link : str
    origin_m : three floats
        In the link's frame.
    down_rad : float
        By how much it looks down from x, which is forward.
    field_of_view_rad : two floats
        Horizontal and vertical.
    size_px : two ints
        Width and height.
    fps : float
    """

    name: str
    link: str
    origin_m: Vector
    down_rad: float
    field_of_view_rad: tuple[float, float]
    size_px: tuple[int, int]
    fps: float


@dataclass(frozen=True)
class JointTable:
    """A robot: base, joints (each parent before its children), limits of motors, links it stands on, cameras."""

    name: str
    max_speed_rad_s: float
    max_acceleration_rad_s2: float
    peak_acceleration_rad_s2: float
    max_torque_n_m: float
    standing_height_m: float
    feet: tuple[str, ...]
    base: Link
    joints: tuple[Joint, ...]
    cameras: tuple[Camera, ...] = ()

    def __repr__(self) -> str:
        return summary("JointTable", repr(self.name), f"{len(self.joints)} joints", f"base {self.base.name!r}")

    def __getitem__(self, name: str) -> Joint:
        return self.joints[self.index(name)]

    def __len__(self) -> int:
        return len(self.joints)

    def index(self, name: str) -> int:
        """Position of a joint in `joints`; InvalidArgument when there is none of that name."""
        try:
            return self._indices[name]
        except KeyError:
            raise InvalidArgument(f"{self.name} has no joint {name!r}; {did_you_mean(name, self._indices)}") from None

    @property
    def names(self) -> tuple[str, ...]:
        """The joints' names, in order."""
        return tuple(self._indices)

    @property
    def counted(self) -> tuple[Joint, ...]:
        """The joints with a pulse counter, by column of the pulse CSV."""
        joints = (joint for joint in self.joints if joint.pulses_per_degree is not None)
        return tuple(sorted(joints, key=lambda joint: joint.column_index))

    @cached_property
    def limits_rad(self) -> NDArray[np.float64]:
        """Lower and upper limits, shape (joints, 2)."""
        return np.array([(joint.lower_rad, joint.upper_rad) for joint in self.joints])

    @property
    def rest_rad(self) -> dict[str, float]:
        """Where the joints are when nothing is to do, by name."""
        return {joint.name: joint.rest_rad for joint in self.joints}

    @cached_property
    def links(self) -> dict[str, Link]:
        """All links by name, the base first."""
        return {link.name: link for link in (self.base, *(joint.link for joint in self.joints))}

    @cached_property
    def adjoining(self) -> frozenset[frozenset[str]]:
        """Pairs of solid links with no other solid link between them: about their joint their boxes may overlap."""
        carriers = {joint.child: joint for joint in self.joints}
        pairs = set()
        for joint in self.joints:
            above = joint.parent
            while above in carriers and not carriers[above].link.solid:
                above = carriers[above].parent
            if joint.link.solid:
                pairs.add(frozenset((joint.child, above)))
        return frozenset(pairs)

    @cached_property
    def _indices(self) -> dict[str, int]:
        return {joint.name: index for index, joint in enumerate(self.joints)}


def load_joint_table(resource: str = "hoap2.toml") -> JointTable:
    """Read a robot from a TOML file of this package."""
    text = resources.files("hri.robot.model").joinpath(resource).read_text(encoding="utf-8")
    table = tomllib.loads(text)
    colours = {name: _vector(value) for name, value in table["colours"].items()}
    joints = tuple(_joint(entry, colours) for entry in table["joint"])
    return JointTable(
        name=table["name"],
        max_speed_rad_s=table["max_speed_rad_s"],
        max_acceleration_rad_s2=table["max_acceleration_rad_s2"],
        peak_acceleration_rad_s2=table["peak_acceleration_rad_s2"],
        max_torque_n_m=table["max_torque_n_m"],
        standing_height_m=table["standing_height_m"],
        feet=tuple(table["feet"]),
        base=_link(table["base"]["name"], table["base"], colours),
        joints=joints,
        cameras=tuple(_camera(entry) for entry in table.get("camera", ())),
    )


def _camera(entry: dict[str, Any]) -> Camera:
    across, upright = (float(np.radians(value)) for value in entry["field_of_view_deg"])
    width, height = entry["size_px"]
    return Camera(
        name=entry["name"],
        link=entry["link"],
        origin_m=_vector(entry["origin_m"]),
        down_rad=float(np.radians(entry["down_deg"])),
        field_of_view_rad=(across, upright),
        size_px=(width, height),
        fps=entry["fps"],
    )


def _joint(entry: dict[str, Any], colours: dict[str, Vector]) -> Joint:
    return Joint(
        name=entry["name"],
        meaning=entry["meaning"],
        parent=entry["parent"],
        child=entry["child"],
        axis=_vector(entry["axis"]),
        origin_m=_vector(entry["origin_m"]),
        lower_rad=entry["lower_rad"],
        upper_rad=entry["upper_rad"],
        rest_rad=float(np.radians(entry.get("rest_deg", 0.0))),
        column=entry.get("column", ""),
        pulses_per_degree=entry.get("pulses_per_degree"),
        link=_link(entry["child"], entry["link"], colours),
    )


def _link(name: str, entry: dict[str, Any], colours: dict[str, Vector]) -> Link:
    return Link(
        name=name,
        mass_kg=entry["mass_kg"],
        com_m=_vector(entry["com_m"]),
        inertia_kg_m2=tuple(float(value) for value in entry["inertia_kg_m2"]),
        shapes=tuple(_shape(shape, colours) for shape in entry["shapes"]),
    )


def _shape(entry: dict[str, Any], colours: dict[str, Vector]) -> Shape:
    start = _vector(entry["start"] if entry["kind"] == "capsule" else entry["centre"])
    return Shape(
        kind=entry["kind"],
        start=start,
        end=_vector(entry["end"]) if entry["kind"] == "capsule" else start,
        size=_vector(entry.get("size", (0, 0, 0))),
        radius=float(entry.get("radius", 0)),
        colour=colours[entry["colour"]],
        solid=entry.get("solid", False),
    )


def _vector(values: Any) -> Vector:
    x, y, z = (float(value) for value in values)
    return x, y, z


HOAP2 = load_joint_table()
NAO = load_joint_table("nao.toml")
ROBOTS = {"hoap2": HOAP2, "nao": NAO}
