# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A ROS 1 node that moves a robot's joints: checks, approach, stop and log are those of the simulated ones.

Every `step_s` one trajectory_msgs/JointTrajectory of all joints goes to NAMESPACE/joint_trajectory_controller/command.
It holds one point, to be reached a step later, and takes the place of the one before, as joint_trajectory_controller of
ros_control has it. Where the joints are is read from NAMESPACE/joint_states. When these fall silent for longer than the
timeout, the motion ends with an error and the robot is stopped until `resume`.

    python ros1_robot.py namaste --namespace hoap2
"""

from __future__ import annotations

import argparse
import json
import math
import sys
import threading
import time
from collections.abc import Mapping

import rosgraph
import rospy
from sensor_msgs.msg import JointState
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from hri.core.errors import Error, IoError
from hri.robot import HOAP2, JointTable, Robot, RobotState, gesture_trajectory
from hri.robot.control.filming import Image
from hri.robot.control.stopping import stopped_by_signals


class Ros1Robot(Robot):
    """Talks to the controller of a robot; begins by waiting until it listens and says where the joints are.

    Parameters
    ----------
    namespace : str
        Of the robot's topics.
    table : JointTable
        Joints and limits; the controller knows the joints by the same names.
    timeout_s : float
        How long joint states may be silent.

    Raises
    ------
    IoError
        Without a ROS master, a controller that listens, or joint states that name every joint; also of every motion.
    """

    step_s = 0.02

    def __init__(self, namespace: str = "hoap2", table: JointTable = HOAP2, timeout_s: float = 0.5) -> None:
        super().__init__(table)
        if not rosgraph.is_master_online():  # init_node would wait for it without end
            raise IoError(f"no ROS master answers at {rosgraph.get_master_uri()}; start roscore")
        if not rospy.core.is_initialized():
            rospy.init_node("hri", anonymous=True, disable_signals=True)
        self._timeout_s = timeout_s
        self._news = threading.Condition()
        self._state_of: dict[str, tuple[float, float]] = {}  # position, and when it was heard
        self._due_s = time.monotonic()
        command = f"/{namespace}/joint_trajectory_controller/command"
        self._publisher = rospy.Publisher(command, JointTrajectory, queue_size=1)
        self._subscriber = rospy.Subscriber(f"/{namespace}/joint_states", JointState, self._hear, queue_size=1)
        try:
            # Topics are joined by the master, which takes a while.
            self._commanded.update(self._wait_for_states(10 * timeout_s, -math.inf))
            self._wait_for_listener(command, time.monotonic() + 10 * timeout_s)
        except IoError:
            self._close()
            raise

    def _hear(self, message: JointState) -> None:
        now_s = time.monotonic()
        with self._news:
            self._state_of.update((n, (float(p), now_s)) for n, p in zip(message.name, message.position, strict=False))
            self._news.notify_all()

    def _wait_for_listener(self, command: str, until_s: float) -> None:
        while self._publisher.get_num_connections() == 0:
            if time.monotonic() > until_s:
                raise IoError(f"no controller listens to {command}")
            time.sleep(0.01)

    def _wait_for_states(self, timeout_s: float, after_s: float) -> dict[str, float]:
        """Where all joints are, each heard of after a time; several nodes may publish some of them each."""

        def silent() -> list[str]:
            return [name for name in self.table.names if self._state_of.get(name, (0.0, -math.inf))[1] <= after_s]

        with self._news:
            if not self._news.wait_for(lambda: not silent(), timeout_s):
                missing = silent()
                if len(missing) == len(self.table.names):
                    raise IoError(f"the robot's joint states are silent for {timeout_s:g} s")
                raise IoError(f"the robot's joint states lack {', '.join(missing)} for {timeout_s:g} s")
            found = {name: self._state_of[name][0] for name in self.table.names}
        wrong = [name for name, position in found.items() if not math.isfinite(position)]
        if wrong:
            raise IoError(f"the robot's joint states are not finite: {', '.join(wrong)}")
        return found

    def _state(self) -> RobotState:
        nowhere = (0.0, 0.0, 0.0)  # joint states do not say where the base is
        return RobotState(self.time_s, nowhere, nowhere, self._joint_positions())

    def _joint_positions(self) -> dict[str, float]:
        return self._wait_for_states(self._timeout_s, after_s=time.monotonic() - self._timeout_s)

    def _command(self, positions_rad: Mapping[str, float]) -> None:
        point = JointTrajectoryPoint(
            positions=[self._commanded[name] for name in self.table.names],
            time_from_start=rospy.Duration.from_sec(self.step_s),
        )
        self._publisher.publish(JointTrajectory(joint_names=list(self.table.names), points=[point]))
        self._due_s = max(self._due_s + self.step_s, time.monotonic())
        time.sleep(max(0.0, self._due_s - time.monotonic()))
        self._joint_positions()  # a controller that has died is found out here

    def _place(self, positions_rad: Mapping[str, float], posture: str | None) -> None:
        raise Error("a real robot cannot be put anywhere at once; use perform")

    def _render(self, width: int, height: int) -> Image:
        raise Error("a real robot has no picture to render")

    def _close(self) -> None:
        self._subscriber.unregister()
        self._publisher.unregister()


def main() -> int:
    """Performs a gesture; Ctrl-C stops the robot within its limits. Prints where its joints are then."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("gesture")
    parser.add_argument("--namespace", default="hoap2")
    arguments = parser.parse_args()
    try:
        with Ros1Robot(arguments.namespace) as robot, stopped_by_signals(robot):
            print(json.dumps({"begins_at_rad": robot.joint_positions_rad()}), flush=True)
            finished = robot.perform(gesture_trajectory(arguments.gesture))
            robot.hold(0.2)
            print(json.dumps({"finished": finished, "joints_rad": robot.joint_positions_rad()}), flush=True)
    except Error as error:
        print(f"ros1_robot: {error}", file=sys.stderr)
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main())
