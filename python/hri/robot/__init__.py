# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The robots HOAP-2 and NAO: joints, trajectories, gestures and simulation."""

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
from hri.robot.joints import HOAP2, NAO, ROBOTS, Camera, Joint, JointTable
from hri.robot.kinematics import link_poses
from hri.robot.nao_arms import with_nao_arms
from hri.robot.physics import Physics
from hri.robot.plots import plot_trajectory
from hri.robot.postures import POSTURES
from hri.robot.pulse_csv import read_pulse_csv, write_pulse_csv
from hri.robot.repair import Change, repair_pulse_csv
from hri.robot.self_collision import Touch, self_collisions
from hri.robot.shaping import concatenate, resample, slow_to_limits, smooth, spline
from hri.robot.short_csv import read_short_csv, write_short_csv
from hri.robot.simulation import BACKENDS, open_robot, render_still, render_video
from hri.robot.state import Contact, Event, MotionLog, RobotState
from hri.robot.trajectory import Finding, Trajectory, TrajectoryError
from hri.robot.urdf import urdf_text

__all__ = [
    "BACKENDS",
    "GESTURE_JOINTS",
    "HOAP2",
    "NAO",
    "POSTURES",
    "ROBOTS",
    "Camera",
    "Change",
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
    "Touch",
    "Trajectory",
    "TrajectoryError",
    "check_pulse_csv",
    "check_trajectory",
    "concatenate",
    "gesture_trajectory",
    "link_poses",
    "load_gestures",
    "open_robot",
    "plot_trajectory",
    "read_pulse_csv",
    "read_short_csv",
    "render_still",
    "render_video",
    "repair_pulse_csv",
    "require_safe",
    "resample",
    "rest_positions",
    "self_collisions",
    "slow_to_limits",
    "smooth",
    "spline",
    "urdf_text",
    "with_nao_arms",
    "write_gallery",
    "write_pulse_csv",
    "write_short_csv",
]
