# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri demo``."""

from __future__ import annotations

import shutil
import sys
import time
from pathlib import Path

import click

from hri.cli.groups import CheckedCommand
from hri.cli.messages import note
from hri.cli.output import write_json
from hri.cli.progress import progress_bars
from hri.core.errors import InvalidArgument, IoError
from hri.core.files import write_text
from hri.core.optional import import_opencv, import_optional
from hri.media import write_image

MARKER = ".hri-demo"
"""A folder with this file was made by the demo, and may be made anew."""

MADE = ("index.html", "result.json", "signer_and_robot.webm", "corpus", "models", "scenes")
"""What the demo writes there besides; nothing else is ever removed."""


@click.command(cls=CheckedCommand)
@click.option(
    "--out",
    type=click.Path(file_okay=False, path_type=Path),
    default=Path("hri_demo"),
    show_default=True,
    help="Folder to write; one from an earlier demo is replaced.",
)
@click.option("--seed", type=click.IntRange(0), default=0, show_default=True, help="Seed of voices, signers and noise.")
@click.option("--backend", type=click.Choice(["pybullet", "kinematic"]), default="pybullet", show_default=True)
@click.option("--keep-corpus/--no-keep-corpus", default=True, show_default=True, help="Keep the training data.")
@click.option("--quick", is_flag=True, help="A small corpus: faster, less accurate.")
def demo(out: Path, seed: int, backend: str, keep_corpus: bool, quick: bool) -> None:
    """Show everything at once, on recordings that the demo makes itself; prints the page to open.

    Synthetic voices say digits in English and Hindi, drawn signers show them. Recognisers are trained on both; voices
    and signers that are in no training data command the robot, and a page explains what happened. Takes less than a
    minute and a half.

    \b
    Examples:
      hri demo
      hri demo --out show --backend kinematic --quick
    """
    from hri.demo.corpus import FULL, QUICK, make_corpus
    from hri.demo.film import make_film
    from hri.demo.page import make_page
    from hri.demo.scenes import SCRIPTS, play, save
    from hri.demo.training import train_both

    started = time.monotonic()
    _require_tools(backend)
    _prepare(out)
    with progress_bars() as progress:
        _say("making the corpus: synthetic voices and drawn signers")
        corpus = make_corpus(out / "corpus", QUICK if quick else FULL, seed, progress)
        _say("training on all but the people held out, testing on those")
        trained = train_both(corpus, progress)
        for folder in ("models", "scenes"):
            (out / folder).mkdir()
        trained.words.save(out / "models" / "speech.hri")
        trained.signs.save(out / "models" / "gesture.hri")
        _say(f"playing {len(SCRIPTS)} scenes with unseen voices and signers")
        scenes = []
        for number, script in enumerate(SCRIPTS):
            scenes.append(play(number, script, trained.words, trained.signs, seed))
            save(scenes[-1], out / "scenes", number)
            progress("playing scenes", number + 1, len(SCRIPTS))
        _say(f"filming the robot ({backend})")
        film = out / "signer_and_robot.webm"
        answers = make_film(film, scenes, backend, lambda done, total: progress("filming the robot", done, total))
        for number, answer in enumerate(answers):
            write_image(out / "scenes" / f"scene{number + 1}.jpg", answer.still)
        facts = {
            "seed": seed,
            "backend": backend,
            "num_words": len(corpus.spoken),
            "num_voices": len(corpus.spoken.persons),
            "num_signs": len(corpus.signed),
            "num_signers": len(corpus.signed.persons),
        }
        seconds = round(time.monotonic() - started)
        _say("writing the page")
        page = make_page(scenes, answers, trained, film, {**facts, "seconds": seconds}, progress)
    write_text(out / "index.html", page)
    write_json(
        str(out / "result.json"),
        {
            "synthetic": True,
            **facts,
            "words": trained.words_result.to_dict(),
            "signs": trained.signs_result.to_dict(),
            "scenes": [scene.to_dict() for scene in scenes],
        },
    )
    if not keep_corpus:
        shutil.rmtree(out / "corpus")
    for scene in scenes:
        note(f"{scene.script.title}: {scene.decision.label} ({scene.decision.confidence:.2f}), {scene.decision.rule}")
    click.echo(str((out / "index.html").resolve()))


def _say(what: str) -> None:
    """One plain line a step where no bars are drawn."""
    if sys.stderr is None or not sys.stderr.isatty():
        note(what)


def _require_tools(backend: str) -> None:
    """Miss what is not installed now, not after the training."""
    if shutil.which("espeak-ng") is None:
        raise IoError("the demo needs the program espeak-ng: install the package espeak-ng")
    import_opencv("to draw signs")
    import_optional("matplotlib", "plots", "to draw plots")
    if backend == "pybullet":
        import_optional("pybullet", "robot", "to simulate the robot (or choose --backend kinematic)")


def _prepare(out: Path) -> None:
    """Make the folder, or remove what an earlier demo made in it; anything else is left alone."""
    if out.is_dir() and any(out.iterdir()) and not (out / MARKER).is_file():
        raise InvalidArgument(f"{out} is not empty and was not made by the demo; give another folder with --out")
    out.mkdir(parents=True, exist_ok=True)
    (out / MARKER).touch()
    for name in MADE:
        path = out / name
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path)
        else:
            path.unlink(missing_ok=True)
