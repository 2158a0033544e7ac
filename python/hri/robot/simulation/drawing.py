# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A small renderer: flat shaded faces, the most distant painted first."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from hri.core.optional import import_opencv
from hri.robot.model.joints import JointTable, Shape
from hri.robot.model.kinematics import Pose
from hri.robot.simulation import scene

_AROUND = 14  # faces round a capsule
_CELL_M = 0.035  # faces of boxes are cut to about this, so that the order by depth holds
_OVERSAMPLING = 2
_DETAIL_M = 0.01  # a plate thinner than this lies on a face, so that it is painted after it
_NEARER_M = 0.03
_SHADOW = 0.90  # of the floor's brightness
Quads = NDArray[np.float64]  # (faces, 4 corners, 3), corners anticlockwise from outside


def draw_robot(poses: dict[str, Pose], table: JointTable, width: int, height: int) -> NDArray[np.uint8]:
    """Draw a robot from the front on its floor.

    Parameters
    ----------
    poses : dict from link name to ndarray, shape (4, 4)
    table : JointTable
    width, height : int, px

    Returns
    -------
    ndarray of uint8, shape (height, width, 3)
        RGB.
    """
    scene.check_size(width, height)
    cv2 = import_opencv("to draw the robot")
    eye, axes = scene.camera_axes()
    full_width, full_height = width * _OVERSAMPLING, height * _OVERSAMPLING
    focal = 0.5 * full_height / np.tan(np.radians(scene.FIELD_OF_VIEW_DEG) / 2.0)

    def project(points: NDArray[np.float64]) -> NDArray[np.int32]:
        seen = (points - eye) @ axes.T
        scaled = focal * seen[..., :2] / np.maximum(seen[..., 2:], 1e-3)
        pixels = np.array((full_width, full_height)) / 2.0 + scaled * (1.0, -1.0)
        return np.rint(np.clip(pixels, -1e6, 1e6)).astype(np.int32)

    quads, colours, nearer = _world_faces(poses, table)
    normals = np.cross(quads[:, 1] - quads[:, 0], quads[:, 2] - quads[:, 1])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
    centres = quads.mean(axis=1)
    front = np.einsum("ij,ij->i", normals, eye - centres) > 0.0
    depths = np.linalg.norm(centres - eye, axis=1) - nearer
    order = np.flatnonzero(front)[np.argsort(-depths[front])]
    to_light = np.array(scene.TO_LIGHT) / np.linalg.norm(scene.TO_LIGHT)
    light = 0.70 + 0.36 * np.clip(normals @ to_light, 0.0, 1.0)
    shades = np.clip(255.0 * colours * light[:, np.newaxis], 0.0, 255.0)

    image = np.ascontiguousarray(scene.backdrop(full_width, full_height))
    floor = 255.0 * np.array(scene.FLOOR_COLOUR)
    board = scene.FLOOR_HALF_M * np.array([[1, -1, 0], [1, 1, 0], [-1, 1, 0], [-1, -1, 0.0]])
    cv2.fillConvexPoly(image, project(board), floor.tolist())
    flat = quads[front] - quads[front][..., 2:] * (to_light / to_light[2])
    for polygon in project(flat):
        cv2.fillConvexPoly(image, polygon, (floor * _SHADOW).tolist())
    for polygon, shade in zip(project(quads[order]), shades[order].tolist(), strict=True):
        cv2.fillConvexPoly(image, polygon, shade)
    small = cv2.resize(image, (width, height), interpolation=cv2.INTER_AREA)
    return np.asarray(small, dtype=np.uint8)


def _world_faces(poses: dict[str, Pose], table: JointTable) -> tuple[Quads, NDArray[np.float64], NDArray[np.float64]]:
    """Faces of all links, their colours, and by how much to take them for nearer in the order."""
    quads, colours, nearer = [], [], []
    for link in (table.base, *(joint.link for joint in table.joints)):
        pose = poses[link.name]
        for shape in link.shapes:
            local = _local_faces(shape)
            quads.append(local @ pose[:3, :3].T + pose[:3, 3])
            colours.append(np.broadcast_to(np.array(shape.colour), (len(local), 3)))
            detail = shape.kind == "box" and not shape.solid and min(shape.size) < _DETAIL_M
            nearer.append(np.full(len(local), _NEARER_M if detail else 0.0))
    return np.concatenate(quads), np.concatenate(colours), np.concatenate(nearer)


@lru_cache(maxsize=256)
def _local_faces(shape: Shape) -> Quads:
    if shape.kind == "box":
        return _box_faces(np.array(shape.size)) + np.array(shape.start)
    return _capsule_faces(np.array(shape.start), np.array(shape.end), shape.radius)


def _box_faces(size: NDArray[np.float64]) -> Quads:
    faces = []
    for axis in range(3):
        first, second = (axis + 1) % 3, (axis + 2) % 3
        counts = [max(1, round(size[side] / _CELL_M)) for side in (first, second)]
        for sign in (-1.0, 1.0):
            for i in range(counts[0]):
                for j in range(counts[1]):
                    face = np.zeros((4, 3))
                    face[:, axis] = sign * size[axis] / 2.0
                    along = np.array([i, i + 1, i + 1, i]) / counts[0] - 0.5
                    across = np.array([j, j, j + 1, j + 1]) / counts[1] - 0.5
                    face[:, first], face[:, second] = along * size[first], across * size[second]
                    faces.append(face if sign > 0.0 else face[::-1])
    return np.array(faces)


def _capsule_faces(start: NDArray[np.float64], end: NDArray[np.float64], radius: float) -> Quads:
    axis = end - start
    length = float(np.linalg.norm(axis))
    axis = axis / length if length > 0.0 else np.array([0.0, 0.0, 1.0])
    side = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    side /= np.linalg.norm(side)
    turns = 2.0 * np.pi * np.arange(_AROUND + 1) / _AROUND
    ring = np.cos(turns)[:, None] * side + np.sin(turns)[:, None] * np.cross(axis, side)
    angles = np.linspace(-np.pi / 2.0, np.pi / 2.0, _AROUND // 2 + 2)
    half = len(angles) // 2
    profile = [(start, angle) for angle in angles[:half]]
    profile += [(start, 0.0), (end, 0.0)] if length > 0.0 else []
    profile += [(end, angle) for angle in angles[len(angles) - half :]]
    rows = np.array([centre + radius * (np.cos(a) * ring + np.sin(a) * axis) for centre, a in profile])
    low, high = rows[:-1], rows[1:]
    faces = np.stack((low[:, :-1], low[:, 1:], high[:, 1:], high[:, :-1]), axis=2)
    return faces.reshape(-1, 4, 3)
