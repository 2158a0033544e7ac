# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The robot HOAP-2: joints, trajectories, gestures and simulation."""

from hri.robot.backend import Robot
from hri.robot.checks import check_pulse_csv, check_trajectory, require_safe
from hri.robot.gallery import write_gallery
from hri.robot.gestures import (
    GESTURE_JOINTS,
    Gesture,
    gesture_trajectory,
    load_gestures,
    rest_positions,
)
from hri.robot.joints import HOAP2, Joint, JointTable
from hri.robot.kinematics import link_poses
from hri.robot.physics import Physics
from hri.robot.postures import POSTURES
from hri.robot.pulse_csv import read_pulse_csv, write_pulse_csv
from hri.robot.simulation import BACKENDS, open_robot, render_video
from hri.robot.state import Contact, Event, MotionLog, RobotState
from hri.robot.trajectory import Finding, Trajectory, TrajectoryError
from hri.robot.urdf import urdf_text

__all__ = [
    "BACKENDS",
    "GESTURE_JOINTS",
    "HOAP2",
    "POSTURES",
    "Contact",
    "Event",
    "Finding",
    "Gesture",
    "Joint",
    "JointTable",
    "MotionLog",
    "Physics",
    "Robot",
    "RobotState",
    "Trajectory",
    "TrajectoryError",
    "check_pulse_csv",
    "check_trajectory",
    "gesture_trajectory",
    "link_poses",
    "load_gestures",
    "open_robot",
    "read_pulse_csv",
    "render_video",
    "require_safe",
    "rest_positions",
    "urdf_text",
    "write_gallery",
    "write_pulse_csv",
]
