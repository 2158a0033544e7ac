# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Entry point: the commands, loaded when called, and errors as one line with an exit code."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib import import_module

try:
    import click
except ImportError:  # the base install has no command line
    sys.exit("hri: the command line needs click: pip install libhri[cli]")

from hri import __version__
from hri.errors import FormatError, Interrupted, InvalidArgument, IoError

EXIT_BAD_DATA = 3
EXIT_INTERRUPTED = 130

COMMANDS = {
    "demo": ("hri.demo.cli:demo", "Make a corpus, train, recognise a word and a sign, move the robot."),
    "train": ("hri.cli.train:train", "Train a recogniser on a folder of recordings."),
    "recognise": ("hri.cli.recognise:recognise", "Recognise a word, a sign or both, and let the robot answer."),
    "evaluate": ("hri.cli.evaluate:evaluate", "Measure accuracy on people who were not trained on."),
    "study": ("hri.cli.study:study", "Repeat a measured claim of the project."),
    "robot": ("hri.robot.cli:robot", "Check motions of HOAP-2, carry them out in simulation, film them."),
    "info": ("hri.cli.info:info", "Tell what is installed, or what a model file holds."),
}


class LazyGroup(click.Group):
    """Loads a command's module when the command is called, so that ``hri --help`` answers at once."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in COMMANDS:
            return None
        module, _, name = COMMANDS[cmd_name][0].partition(":")
        command = getattr(import_module(module), name)
        assert isinstance(command, click.Command)
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        with formatter.section("Commands"):
            formatter.write_dl([(name, summary) for name, (_, summary) in COMMANDS.items()])


@click.group(cls=LazyGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="hri")
def hri() -> None:
    """Command a humanoid robot with spoken words and signed gestures.

    \b
    Start here:
      hri demo
      hri train speech --data spoken/
      hri train gesture --data signed/
      hri recognise --speech seven.wav --gesture seven.jpg --robot robot.webm
      hri evaluate speech --data spoken/

    Exit codes: 0 done (also for "unknown"), 1 a target was missed, 2 wrong usage, 3 bad data, 130 interrupted.
    """


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code; errors become one line on standard error."""
    try:
        result = hri.main(args=arguments, prog_name="hri", standalone_mode=False)
        return result if isinstance(result, int) else 0
    except click.UsageError as error:
        error.show()
        return error.exit_code
    except click.exceptions.Exit as error:
        return error.exit_code
    except (click.Abort, KeyboardInterrupt, Interrupted):
        click.echo("hri: interrupted", err=True)
        return EXIT_INTERRUPTED
    except (InvalidArgument, FormatError, IoError, ImportError, OSError) as error:
        click.echo(f"hri: error: {' '.join(str(error).split())}", err=True)
        return EXIT_BAD_DATA


def run() -> None:
    """The console script."""
    try:
        sys.exit(main())
    except BrokenPipeError:  # standard output went to a program that has ended, such as head
        sys.stderr.close()
        sys.exit(0)
