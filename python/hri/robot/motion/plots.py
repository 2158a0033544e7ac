# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of motions: every joint over time, against its limits."""

from __future__ import annotations

from os import PathLike

import numpy as np

from hri.core.errors import IoError
from hri.core.optional import import_optional
from hri.robot.model.joints import HOAP2, JointTable
from hri.robot.motion.trajectory import Trajectory

_ACROSS = 4


def plot_trajectory(trajectory: Trajectory, path: str | PathLike[str], table: JointTable = HOAP2) -> None:
    """Draw each joint's angle in degrees in a panel of its own, its limits dashed; the suffix chooses the format.

    Raises
    ------
    ImportError
        When Matplotlib is not installed; the message says how to get it.
    InvalidArgument
        For a joint that the table does not have.
    IoError
        When the picture cannot be written.
    """
    figures = import_optional("matplotlib.figure", "plots", "to draw motions")
    joints = [table[name] for name in trajectory.joint_names]
    down = -(-len(joints) // _ACROSS)
    figure = figures.Figure(figsize=(3.2 * _ACROSS, 1.9 * down), layout="constrained")
    axes = figure.subplots(down, _ACROSS, sharex=True, squeeze=False).ravel()
    times_s = trajectory.period_s * np.arange(len(trajectory))
    for panel, joint, positions in zip(axes, joints, np.degrees(trajectory.positions_rad).T, strict=False):
        panel.plot(times_s, positions, linewidth=1.0)
        for limit in np.degrees((joint.lower_rad, joint.upper_rad)):
            panel.axhline(limit, color="firebrick", linestyle="--", linewidth=0.8)
        panel.set_title(joint.name, fontsize=8)
        panel.tick_params(labelsize=7)
    for panel in axes[len(joints) :]:
        panel.set_axis_off()
    figure.supxlabel("s", fontsize=8)
    figure.supylabel("degrees", fontsize=8)
    try:
        figure.savefig(path, dpi=100)
    except (OSError, ValueError) as error:
        raise IoError(f"{path}: {error}") from error
