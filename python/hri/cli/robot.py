# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The commands of ``hri robot``: data on stdout, messages on stderr, errors to the caller."""

from __future__ import annotations

import sys
from contextlib import ExitStack
from pathlib import Path

import click
import numpy as np

from hri.cli.check import check
from hri.cli.groups import FiniteRange, SuggestingGroup, refuse_given
from hri.cli.imitate import imitate
from hri.cli.messages import note
from hri.cli.motions import named_motion, require_safe_motion, robot_option
from hri.cli.output import OutputFile, json_option, say, write_json
from hri.core.errors import InvalidArgument
from hri.core.files import write_text
from hri.media import IMAGE_SUFFIXES, VIDEO_SUFFIXES
from hri.robot.control.state import MotionLog
from hri.robot.control.stopping import stopped_by_signals
from hri.robot.model.joints import HOAP2, NAO, JointTable
from hri.robot.model.postures import POSTURES
from hri.robot.model.urdf import urdf_text
from hri.robot.motion.checks import require_safe
from hri.robot.motion.gestures import load_gestures
from hri.robot.motion.joint_trajectory import SUFFIXES as MESSAGE_SUFFIXES
from hri.robot.motion.joint_trajectory import write_joint_trajectory
from hri.robot.motion.plots import plot_trajectory
from hri.robot.motion.pulse_csv import write_pulse_csv
from hri.robot.motion.shaping import slow_to_limits
from hri.robot.motion.short_csv import (
    write_short_csv,
)
from hri.robot.nao.gestures import nao_gesture
from hri.robot.nao.robot import NaoqiRobot
from hri.robot.simulation.gallery import write_gallery
from hri.robot.simulation.run import BACKENDS, open_robot, render_still, render_video

EXIT_FELL = 1
EXIT_SIGNAL = 128  # and the signal's number, as in a shell

_backend = click.option(
    "--backend",
    type=click.Choice(BACKENDS),
    default="pybullet",
    show_default=True,
    help="With physics, or without.",
)
nao_url_option = click.option("--url", metavar="tcp://HOST", help="A real NAO at this address instead of a simulation.")


@click.group(cls=SuggestingGroup)
def robot() -> None:
    """Check motions of the robot HOAP-2 or NAO, carry them out in simulation and film them.

    \b
    Examples:
      hri robot gestures
      hri robot render 7 seven.mp4
    """


robot.add_command(check)
robot.add_command(imitate)


@robot.command(short_help="Draw every joint of a motion against its limits.")
@click.argument("motion")
@click.argument("out", type=OutputFile((".png", ".svg", ".pdf"), path_type=Path))
@robot_option
def plot(motion: str, out: Path, table: JointTable) -> None:
    """Draw every joint of MOTION over time, its limits dashed, as OUT (.png, .svg, .pdf).

    \b
    Example:
      hri robot plot namaste namaste.png
      hri robot plot wave wave.svg --robot nao
    """
    plot_trajectory(named_motion(motion, table), out, table)
    click.echo(str(out))


@robot.command(short_help="Carry out a motion; print where the joints end.")
@click.argument("motion")
@_backend
@click.option("--gui", is_flag=True, help="Show a window and move in real time (pybullet).")
@click.option("--stand", is_flag=True, help="Stand on the feet instead of holding the torso.")
@click.option("--posture", type=click.Choice(POSTURES), default="standing", show_default=True, help="To begin in.")
@click.option("--log", "log_path", type=OutputFile((".json",), path_type=Path), help="Write states as JSON.")
@robot_option
@nao_url_option
@click.option("--wake-up", is_flag=True, help="Let the real NAO stand up first.")
@click.option("--rest", is_flag=True, help="Let the real NAO crouch and switch its motors off afterwards.")
def play(
    motion: str,
    backend: str,
    gui: bool,
    stand: bool,
    posture: str,
    log_path: Path | None,
    table: JointTable,
    url: str | None,
    wake_up: bool,
    rest: bool,
) -> None:
    """Carry out MOTION, the name of a gesture or a file (.csv, .tsv, .json, .mcap); print where the joints end.

    A robot on its feet begins with the motion's first row, standing or lying; where it ends, and whether it fell (exit
    code 1), is reported on stderr. Ctrl-C or SIGTERM stops the robot, within its limits of speed and acceleration: exit
    code 130 or 143.

    \b
    Example:
      hri robot play namaste --gui
      hri robot play walk.csv --stand --log walk.json
      hri robot play wave --robot nao --url tcp://nao.local --wake-up --rest
    """
    stand = stand or posture != "standing"
    if url is not None and table is not NAO:
        raise click.UsageError("--url is of a real NAO: add --robot nao")
    if url is None and (wake_up or rest):
        raise click.UsageError("--wake-up and --rest are of a real NAO: name its --url")
    if url is not None and (gui or stand):
        raise click.UsageError("--gui, --stand and --posture are of a simulation, --url of a real robot")
    trajectory = named_motion(motion, table)
    require_safe_motion(trajectory, table, motion)
    idle = [name for name in table.names if name not in trajectory.joint_names] if stand and table is HOAP2 else []
    log = MotionLog()
    with ExitStack() as stack:
        opened = stack.enter_context(
            open_robot(backend, gui=gui, fixed_base=not stand, locked=idle, table=table)
            if url is None
            else NaoqiRobot(url)
        )
        if stand:
            first = trajectory.positions_rad[0].tolist()
            opened.reset(dict(zip(trajectory.joint_names, first, strict=True)), posture)
        with stopped_by_signals(opened) as signals:
            if isinstance(opened, NaoqiRobot) and wake_up:
                opened.wake_up()
            opened.perform(trajectory, log=log)
            if isinstance(opened, NaoqiRobot) and rest:
                opened.rest()
        for name, position in opened.joint_positions_rad().items():
            click.echo(f"{name}\t{position:.4f}")
        for event in opened.events:
            note(f"{event.time_s:.2f} s: {event.kind}: {event.message}")
        for contact in opened.self_contacts:
            force = f"up to {contact.force_n:.1f} N, {contact.first_s:.2f} to {contact.last_s:.2f} s"
            note(f"{contact.link} and {contact.other} touched: {force}")
        if stand:
            end = opened.state()
            place = ", ".join(f"{value:.3f}" for value in end.base_position_m)
            turned = ", ".join(f"{np.degrees(value):.1f}" for value in end.base_rpy_rad)
            note(f"base at {place} m; roll, pitch, yaw {turned} deg")
    if log_path is not None:
        log.write(log_path)
        note(f"log: {log_path}")
    ended = [event for event in opened.events if event.ended_motion]
    if ended:
        sys.exit(EXIT_FELL if ended[-1].kind == "fall" else EXIT_SIGNAL + signals[0])


@robot.command(short_help="Film a motion.")
@click.argument("motion")
@click.argument("out", type=OutputFile((*VIDEO_SUFFIXES, *IMAGE_SUFFIXES), path_type=Path))
@_backend
@click.option("--fps", type=FiniteRange(1, 120), default=12.0, show_default=True)
@click.option("--size", type=(int, int), default=(480, 360), show_default=True, help="Pixels.")
@click.option("--still", type=FiniteRange(0), metavar="SECONDS", help="One picture (.png, .jpg) of this moment.")
@robot_option
def render(
    motion: str, out: Path, backend: str, fps: float, size: tuple[int, int], still: float | None, table: JointTable
) -> None:
    """Film MOTION, the name of a gesture or a file (.csv, .tsv, .json, .mcap), as the video OUT, or take one picture of
    it.

    \b
    Example:
      hri robot render 7 seven.mp4
      hri robot render motion.csv motion.webm --backend kinematic --size 640 480
      hri robot render namaste namaste.png --still 1.5
    """
    if still is None and out.suffix.lower() in IMAGE_SUFFIXES:
        raise click.UsageError(f"{out} is a picture: say of which moment by --still")
    trajectory = named_motion(motion, table)
    require_safe_motion(trajectory, table, motion)
    if still is not None:
        render_still(trajectory, out, still, backend, size, table)
    elif sys.stderr is not None and sys.stderr.isatty():
        with click.progressbar(length=1000, label="Filming", file=sys.stderr) as bar:

            def show(made: int, total: int) -> None:
                bar.update(1000 * made // total - bar.pos)

            render_video(trajectory, out, backend, fps, size, show, table)
    else:
        render_video(trajectory, out, backend, fps, size, table=table)
    click.echo(str(out))


@robot.command(short_help="Write a motion as pulses, degrees or a message of ROS 2.")
@click.argument("motion")
@click.argument("out", type=OutputFile((".csv", ".tsv", *MESSAGE_SUFFIXES), path_type=Path))
@click.option("--short", is_flag=True, help="A .csv in degrees with named columns instead of pulses.")
@click.option("--slow", is_flag=True, help="Slow the whole motion down to the limits of speed and acceleration.")
@robot_option
def convert(motion: str, out: Path, short: bool, slow: bool, table: JointTable) -> None:
    """Write MOTION as OUT: pulses with .csv, times and degrees, tab-separated, with .tsv, a JointTrajectory of ROS 2
    with .json (as rosbridge has it) or .mcap (in CDR); the latter only if the check finds no error.

    MOTION is the name of a gesture, a pulse CSV file, one in the short form, a table (.tsv), or a JointTrajectory
    (.json, .mcap).

    \b
    Example:
      hri robot convert namaste namaste.csv
      hri robot convert motion.csv motion.tsv
      hri robot convert wave wave.csv --short
      hri robot convert wave wave.mcap --robot nao
    """
    if out.suffix.lower() != ".csv":
        refuse_given(("short",), "is a form of .csv")
    trajectory = named_motion(motion, table)
    if slow:
        slower = slow_to_limits(trajectory, table)
        if slower is not trajectory:
            note(f"slowed from {trajectory.duration_s:g} to {slower.duration_s:g} s")
        trajectory = slower
    if out.suffix.lower() == ".csv" and short:
        write_short_csv(out, trajectory)
    elif out.suffix.lower() == ".csv":
        if table is not HOAP2:
            raise InvalidArgument(f"{out}: pulses are HOAP-2's: add --short")
        left_out = write_pulse_csv(out, trajectory)
        if left_out:
            note(f"left out, as the format has no count: {', '.join(left_out)}")
    elif out.suffix.lower() == ".tsv":
        trajectory.write_tsv(out)
    else:
        (require_safe if slow else require_safe_motion)(trajectory, table, motion)
        write_joint_trajectory(out, trajectory)
    click.echo(str(out))


@robot.command(short_help="Write the robot as URDF.")
@click.argument("out", type=OutputFile(path_type=Path))
@robot_option
def urdf(out: Path, table: JointTable) -> None:
    """Write the robot as OUT, a URDF file that ROS reads: joints with axes and limits, masses, simple shapes.

    \b
    Examples:
      hri robot urdf hoap2.urdf
      hri robot urdf nao.urdf --robot nao
    """
    write_text(out, urdf_text(table, capsules=False))
    click.echo(str(out))


@robot.command(short_help="List the joints with limits, CSV columns and pulses.")
@click.option("--markdown", is_flag=True, help="As a table for a Markdown page.")
@robot_option
@json_option
def joints(markdown: bool, table: JointTable, json_path: str | None) -> None:
    """List the joints with limits in degrees, CSV column and pulses per degree.

    \b
    Example:
      hri robot joints --markdown
    """
    rows = [("joint", "meaning", "lower deg", "upper deg", "column", "pulses/deg")]
    listed = []
    for joint, limits in zip(table.joints, np.degrees(table.limits_rad), strict=True):
        pulses = "" if joint.pulses_per_degree is None else str(joint.pulses_per_degree)
        degrees = (f"{limits[0]:.1f}", f"{limits[1]:.1f}")
        rows.append((joint.name, joint.meaning, *degrees, joint.column, pulses))
        listed.append(
            {
                "joint": joint.name,
                "meaning": joint.meaning,
                "limits_deg": limits.tolist(),
                "column": joint.column,
                "pulses_per_degree": joint.pulses_per_degree,
            }
        )
    if markdown:
        rows.insert(1, ("---",) * 6)
    for row in rows:
        say(f"| {' | '.join(row)} |" if markdown else "\t".join(row), json_path)
    write_json(json_path, {"robot": table.name, "joints": listed})


@robot.command(short_help="Write a page with pictures of every gesture.")
@click.argument("directory", type=click.Path(file_okay=False, path_type=Path))
@click.option("--videos", is_flag=True, help="Also film every gesture (.webm).")
@click.option("--backend", type=click.Choice(BACKENDS), default="kinematic", show_default=True)
def gallery(directory: Path, videos: bool, backend: str) -> None:
    """Write gallery.md, and a picture of every gesture in images/gallery, into DIRECTORY.

    \b
    Examples:
      hri robot gallery docs
      hri robot gallery all/ --videos
    """
    with click.progressbar(length=len(load_gestures()), label="Drawing", file=sys.stderr) as bar:
        page = write_gallery(directory, videos, backend, lambda done, _: bar.update(done - bar.pos))
    click.echo(str(page))


@robot.command(short_help="List the gestures by name.")
@robot_option
@json_option
def gestures(table: JointTable, json_path: str | None) -> None:
    """List the gestures: name, seconds and what it looks like.

    For NAO two more columns: by how many cm a hand is elsewhere than HOAP-2's would be, in proportion to the arm, and
    why NAO cannot make it, if so.

    \b
    Examples:
      hri robot gestures
      hri robot gestures --robot nao
    """
    listed = []
    for gesture in load_gestures().values():
        row: dict[str, str | float] = {"gesture": gesture.name, "duration_s": float(gesture.times_s[-1])}
        row["meaning"] = gesture.meaning
        fields = [gesture.meaning]
        if table is not HOAP2:
            own = nao_gesture(gesture.name)
            row |= {"duration_s": own.trajectory.duration_s, "hand_m": own.hand_m, "why_not": own.why_not}
            fields += [f"{100 * own.hand_m:.1f}", own.why_not]
        listed.append(row)
        say("\t".join((gesture.name, f"{row['duration_s']:.1f}", *fields)), json_path)
    write_json(json_path, {"robot": table.name, "gestures": listed})
