# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The robots HOAP-2 and NAO: joints, trajectories, gestures and simulation."""

from hri.robot.control.backend import Robot
from hri.robot.control.state import Contact, Event, MotionLog, RobotState, SelfContact
from hri.robot.control.stopping import stopped_by_signals
from hri.robot.model.joints import HOAP2, NAO, ROBOTS, Camera, Joint, JointTable
from hri.robot.model.kinematics import link_poses
from hri.robot.model.physics import Physics
from hri.robot.model.postures import POSTURES
from hri.robot.model.urdf import urdf_text
from hri.robot.motion.checks import check_pulse_csv, check_trajectory, require_safe
from hri.robot.motion.commands import command_trajectory, mirrored, needs_feet
from hri.robot.motion.gestures import (
    GESTURE_JOINTS,
    Gesture,
    gesture_trajectory,
    load_gestures,
    rest_positions,
)
from hri.robot.motion.joint_trajectory import (
    joint_trajectory_message,
    read_joint_trajectory,
    trajectory_of_message,
    write_joint_trajectory,
)
from hri.robot.motion.nao_arms import with_nao_arms
from hri.robot.motion.plots import plot_trajectory
from hri.robot.motion.pulse_csv import read_pulse_csv, write_pulse_csv
from hri.robot.motion.reading import MOTION_SUFFIXES, read_motion
from hri.robot.motion.repair import Change, repair_pulse_csv
from hri.robot.motion.self_collision import Touch, self_collisions
from hri.robot.motion.shaping import concatenate, resample, slow_to_limits, smooth, spline
from hri.robot.motion.short_csv import read_short_csv, write_short_csv
from hri.robot.motion.trajectory import Finding, Trajectory, TrajectoryError
from hri.robot.motion.walking import walking_trajectory
from hri.robot.nao.gestures import NaoGesture, nao_gesture, nao_gesture_trajectory
from hri.robot.nao.robot import NaoqiRobot
from hri.robot.simulation.eyesight import Screen
from hri.robot.simulation.gallery import write_gallery
from hri.robot.simulation.run import BACKENDS, open_robot, render_still, render_video

__all__ = [
    "BACKENDS",
    "GESTURE_JOINTS",
    "HOAP2",
    "MOTION_SUFFIXES",
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
    "NaoGesture",
    "NaoqiRobot",
    "Physics",
    "Robot",
    "RobotState",
    "Screen",
    "SelfContact",
    "Touch",
    "Trajectory",
    "TrajectoryError",
    "check_pulse_csv",
    "check_trajectory",
    "command_trajectory",
    "concatenate",
    "gesture_trajectory",
    "joint_trajectory_message",
    "link_poses",
    "load_gestures",
    "mirrored",
    "nao_gesture",
    "nao_gesture_trajectory",
    "needs_feet",
    "open_robot",
    "plot_trajectory",
    "read_joint_trajectory",
    "read_motion",
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
    "stopped_by_signals",
    "trajectory_of_message",
    "urdf_text",
    "walking_trajectory",
    "with_nao_arms",
    "write_gallery",
    "write_joint_trajectory",
    "write_pulse_csv",
    "write_short_csv",
]
