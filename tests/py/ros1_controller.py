# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A joint trajectory controller as a ROS 1 node, for tests: joints are where they are sent, states go out at 100 Hz.

Writes every command to a file, one JSON line each. Arguments: file, names of the joints that have no states.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

import rospy
from sensor_msgs.msg import JointState
from trajectory_msgs.msg import JointTrajectory

from hri.robot import HOAP2


def main(written: str, *silent: str) -> None:
    positions = dict(HOAP2.rest_rad)
    rospy.init_node("controller")
    states = rospy.Publisher("/hoap2/joint_states", JointState, queue_size=1)
    with Path(written).open("a", buffering=1) as file:

        def follow(message: JointTrajectory) -> None:
            point = message.points[-1]
            positions.update(zip(message.joint_names, point.positions, strict=True))
            file.write(json.dumps([point.time_from_start.to_sec(), list(point.positions)]) + "\n")

        rospy.Subscriber("/hoap2/joint_trajectory_controller/command", JointTrajectory, follow, queue_size=100)
        rate = rospy.Rate(100)
        while not rospy.is_shutdown():
            message = JointState(name=[name for name in HOAP2.names if name not in silent])
            message.position = [positions[name] for name in message.name]
            message.header.stamp = rospy.Time.now()
            states.publish(message)
            rate.sleep()


if __name__ == "__main__":
    main(*sys.argv[1:])
