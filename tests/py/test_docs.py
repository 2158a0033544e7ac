# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What the documentation shows works: Python blocks run, links lead somewhere, the C++ block is the built example."""

from __future__ import annotations

import importlib
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

import hri
from hri.synthetic.signer import draw_still, make_gesture_corpus, make_signer
from hri.synthetic.speech import make_speaker, make_speech_corpus, speak

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]

pytestmark = pytest.mark.usefixtures("few_fillers", "few_copies")


def blocks(page: Path, language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)


@pytest.mark.parametrize(
    "page",
    [page for page in PAGES if page.name not in ("README.md", "nao.md") and blocks(page, "python")],
    ids=lambda page: page.name,
)
def test_python_blocks_run(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The blocks of a page follow on one another, in an empty folder."""
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    for block in blocks(page, "python"):
        exec(compile(block, str(page), "exec"), names)


def test_blocks_about_nao_run_against_services_like_naos(capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("qi")
    from nao_services import Nao

    nao = Nao()
    names: dict[str, object] = {}
    for block in blocks(ROOT / "docs" / "nao.md", "python"):
        exec(compile(block.replace("tcp://nao.local", nao.url), "nao.md", "exec"), names)
    nao.close()
    out = capsys.readouterr().out
    assert "LElbowRoll" in out and "(240, 320, 3) 0.0" in out
    assert nao.motion.postures == ["wakeUp", "rest"] and nao.voice.said == [("Hello.", "English")]


def test_readme_runs_on_folders_as_it_names_them(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    words = {"en": {"1": "one", "7": "seven"}}
    make_speech_corpus(tmp_path / "spoken", words, num_speakers=3, takes=1)
    make_gesture_corpus(tmp_path / "signed", labels=["1", "7"], num_persons=4)
    audio = speak("seven", "en", make_speaker(9))
    hri._native.write_wav_pcm16("seven.wav", audio.samples, audio.sample_rate_hz)
    hri.media.write_image("seven.jpg", draw_still(make_signer(20), "7"))
    (block,) = blocks(ROOT / "README.md", "python")
    # The kinematic robot films sooner; everything else is as printed.
    exec(compile(block.replace('"robot.webm")', '"robot.webm", "kinematic")'), "README.md", "exec"), {})
    assert capsys.readouterr().out.startswith("7 ")
    assert Path("speech.hri").is_file() and len(hri.read_frames("robot.webm").frames) > 10
    assert len(block.strip().splitlines()) <= 12


def test_cpp_of_the_readme_is_the_example_that_is_built() -> None:
    (block,) = blocks(ROOT / "README.md", "cpp")
    assert block in (ROOT / "examples" / "consumer" / "recognise_word.cpp").read_text()
    assert len(block.splitlines()) <= 12


@pytest.mark.parametrize("program", sorted((ROOT / "examples").glob("*/*.cpp")), ids=lambda program: program.stem)
def test_programs_in_cpp_say_how_they_are_used_and_what_failed(program: Path) -> None:
    text = program.read_text()
    assert "usage: " in text and "catch (const hri::Error& error)" in text and "return 3;" in text


def test_manifests_shown_are_read(tmp_path: Path) -> None:
    from hri.datasets.manifest import read_manifest

    shown = blocks(ROOT / "docs" / "datasets.md", "toml")
    assert shown
    for number, text in enumerate(shown):
        (tmp_path / f"{number}.toml").write_text(text, encoding="utf-8")
        assert read_manifest(tmp_path / f"{number}.toml").kind in ("speech", "gesture")


@pytest.mark.parametrize("page", [*PAGES, ROOT / "CONTRIBUTING.md"], ids=lambda page: page.name)
def test_links_lead_somewhere(page: Path) -> None:
    prose = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
    targets = [target for target in re.findall(r"\]\(([^)\s]+)\)", prose) if "://" not in target]
    missing = []
    for target in targets:
        name, _, anchor = target.partition("#")
        place = page.parent / name if name else page
        if not place.exists() or (anchor and place.suffix == ".md" and anchor not in anchors_of(place)):
            missing.append(target)
    assert missing == []


def anchors_of(page: Path) -> set[str]:
    """What links may name of a page: its headings, as GitHub writes them."""
    prose = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
    headings = re.findall(r"^#+ +(.+?) *$", prose, re.MULTILINE)
    texts = [re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).lower() for heading in headings]
    return {re.sub(r"[^\w\- ]", "", text).replace(" ", "-") for text in texts}


@pytest.mark.parametrize("page", [*PAGES, ROOT / "CHANGELOG.md"], ids=lambda page: page.name)
def test_names_of_the_package_exist(page: Path) -> None:
    """Every `hri.room.name` that a page names can be imported."""
    schemas = {"hri.Event", "hri.Timing"}  # in MCAP files
    names = set(re.findall(r"`(hri(?:\.\w+)+)", page.read_text(encoding="utf-8"))) - schemas
    assert [name for name in sorted(names) if not can_be_named(name)] == []


def can_be_named(name: str) -> bool:
    found: object = hri
    at = "hri"
    for part in name.split(".")[1:]:
        at += f".{part}"
        try:
            found = getattr(found, part)
        except AttributeError:
            try:
                found = importlib.import_module(at)
            except ImportError:
                return False
    return True


def test_commands_shown_exist() -> None:
    """Every hri command in a block of the console is one that the command line has, with options that it knows."""
    import click

    from hri.cli.main import hri as group

    for page in PAGES:
        shown = "\n".join(blocks(page, "console") + blocks(page, "sh"))
        for line in re.findall(r"^(?:\$ |\./run )?(?:\w+=\S+ )?hri ([a-z][^#\n]*)", shown, re.MULTILINE):
            words = line.split()
            command = group.get_command(click.Context(group), words[0])
            assert command is not None, f"{page.name}: hri {line}"
            if isinstance(command, click.Group):
                command = command.get_command(click.Context(command), words[1])
                assert command is not None, f"{page.name}: hri {line}"
            known = {option for parameter in command.params for option in (*parameter.opts, *parameter.secondary_opts)}
            assert {word for word in words if word.startswith("--")} <= known, f"{page.name}: hri {line}"


def test_every_option_stands_in_a_page() -> None:
    """The name of every option is in some page, not in --help alone; those of `hri htk` are HTK's."""
    import click

    from hri.cli.main import hri as group

    text = "\n".join(page.read_text(encoding="utf-8") for page in PAGES)
    written = set(re.findall(r"(?<![\w-])--?[a-z][\w-]*", text))

    def options(command: click.Command, name: str) -> Iterator[tuple[str, set[str]]]:
        if isinstance(command, click.Group):
            context = click.Context(command)
            for sub in set(command.list_commands(context)) - {"htk"}:
                found = command.get_command(context, sub)
                assert found is not None
                yield from options(found, f"{name} {sub}")
        else:
            for parameter in command.params:
                if isinstance(parameter, click.Option) and not parameter.hidden:
                    yield name, {*parameter.opts, *parameter.secondary_opts}

    found = list(options(group, "hri"))
    assert len(found) > 300  # it looked at all commands
    assert [f"{name} {min(names)}" for name, names in found if not names & written] == []
