# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The commands, loaded when called, and errors as one line with an exit code; `hri.cli.entry` is the entry point."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Sequence
from importlib import import_module

try:
    import click
except ImportError:  # the base install has no command line
    sys.exit("hri: error: the command line needs click: pip install libhri[cli]")

from hri import __version__, set_num_threads
from hri.cli.groups import SuggestingGroup
from hri.cli.in_commands import of_models
from hri.cli.messages import set_verbosity
from hri.cli.output import print_any_name
from hri.core.errors import Error

EXIT_USAGE = 2
EXIT_BAD_DATA = 3
EXIT_UNEXPECTED = 70
EXIT_INTERRUPTED = 130

COMMANDS = {
    "demo": ("hri.cli.demo:demo", "See everything work: made-up recordings, training, fusion, a moving robot."),
    "train": ("hri.cli.train:train", "Train a recogniser on a folder of recordings."),
    "train-connected": (
        "hri.cli.connected:train_connected",
        "Train a recogniser of connected words, on isolated ones.",
    ),
    "train-units": (
        "hri.cli.units:train_units",
        "Train a recogniser to which words are added by their spelling.",
    ),
    "train-sentences": (
        "hri.cli.sentences:train_sentences",
        "Train a recogniser of signed sentences, on tracks of both hands.",
    ),
    "train-fusion": (
        "hri.cli.train_fusion:train_fusion",
        "Train a learned fusion on words and signs of persons held out.",
    ),
    "add-word": (
        "hri.cli.vocabulary:add_word",
        "Add a word to a trained recogniser, from few recordings or by its spelling.",
    ),
    "remove-word": ("hri.cli.vocabulary:remove_word", "Remove a word from a trained recogniser."),
    "add-gesture": ("hri.cli.vocabulary:add_gesture", "Add a gesture to a trained recogniser, from few clips."),
    "recognise": ("hri.cli.recognise:recognise", "Recognise a word, a sign or both, and let the robot answer."),
    "transcribe": ("hri.cli.transcribe:transcribe", "Recognise several words in one recording, with their times."),
    "align": ("hri.cli.align:align", "Find when words that are known were spoken in a recording."),
    "read-sentences": ("hri.cli.sentences:read_sentences", "Recognise signed sentences in tracks of both hands."),
    "split": ("hri.cli.split:split", "Split a film of signs into gestures where the hand stands still."),
    "listen": ("hri.cli.listen:listen", "Recognise words as they are spoken, from a microphone or a recording."),
    "watch": ("hri.cli.watch:watch", "Recognise gestures as they are shown, to a camera or in a video."),
    "session": ("hri.cli.session:session", "Command a robot by words and signs, live or from recordings."),
    "serve": ("hri.cli.serve:serve", "Command a robot from a page in the browser, by its camera and microphone."),
    "export": ("hri.cli.export:export", "Write a model as a C++ header or as JSON."),
    "adapt": ("hri.cli.adapt:adapt", "Adapt a word recogniser to a speaker, a microphone or a room."),
    "evaluate": ("hri.cli.evaluate:evaluate", "Measure accuracy on unseen persons, with cross-validation."),
    "record": ("hri.cli.record:record", "Record a data set of your own words or gestures."),
    "corpus": ("hri.cli.corpus:corpus", "Make synthetic recordings: words by espeak-ng, signs by drawn persons."),
    "hands": ("hri.cli.hands:hands", "Show the hand found in a clip: mask, outline, track and features."),
    "options": ("hri.cli.options:options", "List the options of recognisers, with their ranges."),
    "features": ("hri.cli.features:features", "Compute features of sound or of hands, as a table or a plot."),
    "denoise": ("hri.cli.denoise:denoise", "Reduce noise in a recording by wavelets."),
    "study": ("hri.cli.study:study", "Repeat a published measurement (accuracy, rejection, robustness)."),
    "robot": ("hri.cli.robot:robot", "Check, simulate and film motions of the robots HOAP-2 and NAO."),
    "htk": ("hri.cli.htk:htk", "HTK's tools on HTK's files: copy, list, parse, vite, results and others."),
    "info": ("hri.cli.info:info", "Show what is installed, or what a model file holds."),
}


class LazyGroup(SuggestingGroup):
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
@click.option("-v", "--verbose", count=True, help="Also say what the library does; -vv every detail.")
@click.option("-q", "--quiet", is_flag=True, help="Results and errors only.")
@click.option(
    "--threads",
    type=click.IntRange(0, 4096),
    metavar="N",
    help="Train on at most N threads; 0, the default: one for each processor. The result is the same to the bit.",
)
def hri(verbose: int, quiet: bool, threads: int | None) -> None:
    """Command a humanoid robot with spoken words and signed gestures.

    \b
    Start here:
      hri demo
      hri train speech --data spoken/
      hri train gesture --data signed/
      hri recognise seven.wav seven.jpg --robot robot.webm
      hri evaluate speech --data spoken/
      hri train --help

    Exit codes: 0 done (also for "unknown"), 1 target of a study not met, a replay decided otherwise, or the robot fell,
    2 wrong usage, 3 bad data, 70 a fault of hri itself, 129, 130 and 143 ended by SIGHUP, Ctrl-C or SIGTERM, 141 the
    output is no longer read. A robot that moves is stopped first.
    """
    if verbose and quiet:
        raise click.UsageError("--verbose and --quiet exclude each other")
    set_verbosity(-1 if quiet else verbose)
    if threads is not None:
        set_num_threads(threads)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code; errors become one line on standard error."""
    try:
        result = hri.main(args=arguments, prog_name="hri", standalone_mode=False)
        return result if isinstance(result, int) else 0
    except click.exceptions.NoArgsIsHelpError as error:
        error.show()
        return EXIT_USAGE
    except click.UsageError as error:
        place = error.ctx.command_path if error.ctx else "hri"
        return _fail(f"{error.format_message()} (see '{place} --help')", EXIT_USAGE)
    except click.exceptions.Exit as error:
        return error.exit_code
    except SystemExit as error:
        return error.code if isinstance(error.code, int) else EXIT_BAD_DATA
    except (click.Abort, KeyboardInterrupt):  # which hri.core.errors.Interrupted is too
        click.echo("hri: interrupted", err=True)
        return EXIT_INTERRUPTED
    except click.ClickException as error:
        return _fail(error.format_message(), EXIT_BAD_DATA)
    except (Error, ImportError) as error:
        return _fail(of_models(str(error)), EXIT_BAD_DATA)
    except OSError as error:
        return _fail(f"{error.filename}: {error.strerror}" if error.filename else str(error), EXIT_BAD_DATA)
    except Exception as error:
        if os.environ.get("HRI_TRACEBACK"):
            raise
        return _fail(f"unexpected {type(error).__name__}: {error} (HRI_TRACEBACK=1 shows where)", EXIT_UNEXPECTED)


def _fail(message: str, exit_code: int) -> int:
    click.echo(f"hri: error: {' '.join(message.split())}", err=True)
    return exit_code


def run() -> None:
    """Do what the arguments of this process say, and end it."""
    if hasattr(signal, "SIGPIPE"):
        # Standard output may go to a program that ends early, such as head: then end as other tools do, silently.
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)
        # Who started this may have blocked the signal, which would make it an error after all.
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGPIPE})
    print_any_name()
    sys.exit(main())
