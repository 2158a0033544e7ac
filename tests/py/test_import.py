# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What an import loads, and what it offers."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

import hri
from hri.core.optional import import_pybullet


def loaded_by(statement: str) -> set[str]:
    code = f"import sys; {statement}; print(*sys.modules)"
    return set(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split())


@pytest.mark.parametrize(
    "statement",
    [
        "import hri",
        "import hri; hri.WordRecognizer; hri.Dataset; hri.fuse; hri.cross_validate; hri.train; hri.render_video",
        "import hri.robot, hri.media, hri.evaluation, hri.studies, hri.recognition",
        "import hri.cli.main",
    ],
)
def test_import_loads_no_heavy_library(statement: str) -> None:
    heavy = {"cv2", "pybullet", "matplotlib", "soundfile", "scipy", "librosa"}
    assert loaded_by(statement) & heavy == set()


def test_every_public_name_is_there() -> None:
    for name in hri.__all__:
        assert getattr(hri, name) is not None
    assert set(dir(hri)) >= set(hri.__all__)
    with pytest.raises(AttributeError, match="no_such_name"):
        _ = hri.no_such_name


def test_version_stands_once() -> None:
    from pathlib import Path

    cmake = (Path(__file__).parents[2] / "CMakeLists.txt").read_text()
    assert f"project(hri VERSION {hri.__version__} " in cmake


def test_what_pybullet_prints_when_it_is_imported_is_not_shown(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "pybullet.py").write_text("import os; os.write(2, b'build time\\n')")
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.setitem(sys.modules, "pybullet", None)
    monkeypatch.delitem(sys.modules, "pybullet")
    assert import_pybullet().__file__ == str(tmp_path / "pybullet.py")
    print("after", file=sys.stderr)
    assert capfd.readouterr().err == "after\n"
