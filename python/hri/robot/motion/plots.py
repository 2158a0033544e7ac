# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of motions: every joint over time, against its limits."""

from __future__ import annotations

from os import PathLike
from typing import Any

import numpy as np

from hri.core.plotting import new_figure, save_figure
from hri.robot.model.joints import HOAP2, JointTable
from hri.robot.motion.trajectory import Trajectory

_ACROSS = 4


def plot_trajectory(
    trajectory: Trajectory, path: str | PathLike[str] | None = None, table: JointTable = HOAP2, *, ax: Any = None
) -> Any:
    """Draw each joint's angle in degrees, its limits dashed.

    Parameters
    ----------
    trajectory : Trajectory
    path : path-like, optional
        Also write it as a picture; the suffix chooses the format.
    table : JointTable
    ax : matplotlib.axes.Axes, optional
        Draw all joints there, with a legend and without limits; by default each has a panel of its own.

    Returns
    -------
    matplotlib.axes.Axes, or ndarray of them, one a joint

    Raises
    ------
    ImportError
        When Matplotlib is not installed; the message says how to get it.
    InvalidArgument
        For a joint that the table does not have.
    IoError
        When the picture cannot be written.
    """
    joints = [table[name] for name in trajectory.joint_names]
    times_s = trajectory.period_s * np.arange(len(trajectory))
    degrees = np.degrees(trajectory.positions_rad).T
    if ax is not None:
        for joint, positions in zip(joints, degrees, strict=True):
            ax.plot(times_s, positions, linewidth=1.0, label=joint.name)
        ax.set(xlabel="s", ylabel="degrees")
        ax.legend(fontsize="x-small")
        drawn, figure = ax, ax.figure
    else:
        down = -(-len(joints) // _ACROSS)
        figure = new_figure((3.2 * _ACROSS, 1.9 * down), "to draw motions")
        panels = figure.subplots(down, _ACROSS, sharex=True, squeeze=False).ravel()
        for panel, joint, positions in zip(panels, joints, degrees, strict=False):
            panel.plot(times_s, positions, linewidth=1.0)
            for limit in np.degrees((joint.lower_rad, joint.upper_rad)):
                panel.axhline(limit, color="firebrick", linestyle="--", linewidth=0.8)
            panel.set_title(joint.name, fontsize=8)
            panel.tick_params(labelsize=7)
        for panel in panels[len(joints) :]:
            panel.set_axis_off()
        figure.supxlabel("s", fontsize=8)
        figure.supylabel("degrees", fontsize=8)
        drawn = panels[: len(joints)]
    if path is not None:
        save_figure(figure, path, dpi=100)
    return drawn
