# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Which recordings the rows of a table of what was said stand for."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from hri.cli.evaluate_connected import read_strings
from hri.cli.transcript_tables import Recording, read_said, recordings_among, recordings_below
from hri.core.errors import FormatError


@pytest.fixture
def table(tmp_path: Path) -> Callable[..., str]:
    """Writes a table, and empty recordings below its folder."""

    def write(text: str, *files: str) -> str:
        root = tmp_path / "data" / "numbers"
        for file in (*files, "said.txt"):
            (root / file).parent.mkdir(parents=True, exist_ok=True)
            (root / file).touch()
        (root / "said.txt").write_text(text)
        return str(root / "said.txt")

    return write


def master(*entries: tuple[str, str]) -> str:
    """A master label file of patterns and words."""
    lines = ["#!MLF!#"]
    for pattern, words in entries:
        lines += [f'"{pattern}"', *words.split(), "."]
    return "\n".join(lines) + "\n"


def said_in(recordings: list[Recording], table: str) -> dict[str, str]:
    """The words of each recording, by its path from the folder of the table."""
    root = Path(table).parent
    return {
        os.path.relpath(recording.name, root): " ".join(recording.said.words)
        for recording in recordings
        if recording.said is not None
    }


def faults(recordings: list[Recording]) -> list[str]:
    return [recording.fault for recording in recordings if recording.said is None]


TRN = "1 (monday)\n2 (monday.anna)\n3 (tuesday.wav)\n"
MLF = master(("*/monday.lab", "1"), ("*/monday.anna.lab", "2"), ("*/tuesday.rec", "3"))


@pytest.mark.parametrize("text", [TRN, MLF, master(("*/monday.anna", "2"), ("monday", "1"), ("tuesday.wav", "3"))])
def test_a_dot_is_part_of_a_name(table: Callable[..., str], text: str) -> None:
    path = table(text, "monday.wav", "monday.anna.wav", "tuesday.wav", "tuesday.flac.ogg")
    meant = {"monday.wav": "1", "monday.anna.wav": "2", "tuesday.wav": "3"}
    assert said_in(recordings_below(path), path) == meant and faults(recordings_below(path)) == []
    for name, words in meant.items():
        given = recordings_among([str(Path(path).parent / name)], path)
        assert said_in(given, path) == {name: words}


def test_a_recording_whose_name_begins_alike_is_another_one(table: Callable[..., str]) -> None:
    path = table("2 (monday.anna)\n", "monday.wav")
    (fault,) = faults(recordings_below(path))
    assert fault.startswith(f"{path}: row 1: 'monday.anna' is the name of 0 recordings")


def test_patterns_match_as_htk_has_it(table: Callable[..., str]) -> None:
    names = ("monday.wav", "march.wav", "tuesday.wav", "sub/x.wav", "x.wav")
    # The folders above the table, which begin with "n" and "d" too, have no say.
    for pattern, found in (
        ("*/m*.lab", {"monday.wav", "march.wav"}),
        ("m*.lab", {"monday.wav", "march.wav"}),
        ("./m*.rec", {"monday.wav", "march.wav"}),
        ("*/?arch.lab", {"march.wav"}),
        ("?arch", {"march.wav"}),
        ("*/s?b/x.lab", {"sub/x.wav"}),
        ("s?b/*", {"sub/x.wav"}),
        ("*/n*.lab", set()),
        ("*.lab", set(names)),
    ):
        path = table(master((pattern, "1")), *names)
        recordings = recordings_below(path)
        assert set(said_in(recordings, path)) == found, pattern
        assert bool(faults(recordings)) == (not found)
        given = recordings_among([str(Path(path).parent / name) for name in names], path)
        assert set(said_in(given, path)) == found, pattern
    path = table(master(("*/n*.lab", "1")), *names)
    (fault,) = faults(recordings_below(path))
    assert "row 2: '*/n*.lab' is the name of 0 recordings" in fault


def test_patterns_may_have_the_folders_of_the_table(
    table: Callable[..., str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path / "..")
    relative = f"{tmp_path.name}/data/numbers"
    for folder in (relative, str(tmp_path / "data" / "numbers")):
        table(master((f"{folder}/m?nday.lab", "1")), "monday.wav", "sub/monday.wav")
        (recording,) = recordings_below(f"{relative}/said.txt")
        assert recording.said is not None and recording.name == f"{relative}/monday.wav"


def test_the_first_entry_that_matches_counts(table: Callable[..., str]) -> None:
    for text, meant in (
        (master(("*/s?b/x.lab", "1"), ("*/x.lab", "2")), {"sub/x.wav": "1", "x.wav": "2"}),
        (master(("*/sub/x.lab", "1"), ("*/x.lab", "2")), {"sub/x.wav": "1", "x.wav": "2"}),
        (master(("*/sub/*", "1"), ("*.lab", "2"), ("*/x.lab", "3")), {"sub/x.wav": "1", "x.wav": "2"}),
    ):
        path = table(text, "sub/x.wav", "x.wav")
        assert said_in(recordings_below(path), path) == meant and faults(recordings_below(path)) == []
        for name, words in meant.items():
            assert said_in(recordings_among([str(Path(path).parent / name)], path), path) == {name: words}
    alone = table(master(("*/s?b/y.lab", "1"), ("*/y.lab", "2")), "sub/y.wav")
    assert said_in(recordings_below(alone), alone) == {"sub/y.wav": "1"} and faults(recordings_below(alone)) == []


@pytest.mark.parametrize(
    ("text", "rows"),
    [
        ("1 (monday)\n\n2 (tuesday)\n1 (monday)\n", (1, 4)),
        ("1 (monday)\n2 (tuesday)\n1 (monday.wav)\n3 (numbers/monday)\n", (1, 3, 4)),
        (master(("*/monday.lab", "1"), ("*/tuesday.lab", "2"), ("monday.rec", "1")), (2, 8)),
        (master(("*/m*.lab", "1 1"), ("*/m*.lab", "1"), ("*/tuesday.lab", "2")), (2, 6)),
    ],
    ids=["trn", "trn, other names", "mlf", "pattern"],
)
def test_a_recording_that_stands_twice_is_named_with_its_rows(
    table: Callable[..., str], text: str, rows: tuple[int, ...]
) -> None:
    path = table(text, "monday.wav", "tuesday.wav")
    file = Path(path).parent / "monday.wav"
    named = ", ".join(f"row {row}" for row in rows)
    fault = f"{path}: says {len(rows)} times what was said in {file}, not once: {named}"
    below = recordings_below(path)
    assert said_in(below, path) == {"tuesday.wav": "2"} and faults(below) == [fault]
    assert [recording.name for recording in below if recording.said is None] == [str(file)]
    assert faults(recordings_among([str(file)], path)) == [fault]
    with pytest.raises(FormatError) as refused:
        read_strings(path, ["anna"])
    assert str(refused.value) == fault


def test_a_name_of_no_recording_or_of_several_has_its_row(table: Callable[..., str]) -> None:
    path = table("1 (gone)\n1 (x)\n2 (gone)\n2 (a/x)\n", "a/x.wav", "b/x.wav")
    recordings = recordings_below(path)
    assert said_in(recordings, path) == {"a/x.wav": "2"}
    gone, several = faults(recordings)
    assert gone.count("'gone' is the name of 0 recordings") == 2 and "row 1: " in gone and "row 3: " in gone
    assert f"{path}: row 2: 'x' is the name of 2 recordings in {Path(path).parent}, not of one" in several
    path = table(master(("*/a/x.lab", ""), ("*/gone.lab", "1")))
    (first, second) = read_said(path)
    assert (first.place, second.place) == (f"{path}: row 2", f"{path}: row 4")


def test_rows_of_a_master_label_file_are_counted_as_they_stand(table: Callable[..., str]) -> None:
    text = '#!MLF!#\r\n\r\n  "*/a.lab"  \r\n"."\r\n1\r\n.\r\n\'*/b "c".lab\'\n///\n. 2\n.\n"*/\\"d\\\\.lab"\n.\n'
    rows = {said.name: (said.row, said.words) for said in read_said(table(text))}
    assert rows == {"*/a.lab": (3, [".", "1"]), '*/b "c".lab': (7, []), '*/"d\\.lab': (11, [])}


@pytest.mark.parametrize("arrow", ["->", "=>"])
def test_a_folder_of_label_files_is_refused(table: Callable[..., str], arrow: str) -> None:
    path = table(master(("*/a.lab", "1")) + f'"*/" {arrow} "dir"\n', "a.wav")
    with pytest.raises(FormatError, match=r"said\.txt: row 5: '\*/' names a folder of label files"):
        recordings_below(path)


@pytest.mark.parametrize("text", ["", "\n\n", "#!MLF!#\n"])
def test_a_table_without_recordings_is_refused(table: Callable[..., str], text: str) -> None:
    path = table(text, "a.wav")
    for read in (recordings_below, lambda said: recordings_among([str(Path(said).parent / "a.wav")], said)):
        with pytest.raises(FormatError, match=r"said\.txt: names no recording"):
            read(path)
