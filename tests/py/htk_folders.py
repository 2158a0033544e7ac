# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Folders that tests of HTK's tools run in: a plugin of pytest."""

from __future__ import annotations

from pathlib import Path

import pytest

from htk_toys import make_words, make_work


@pytest.fixture
def work(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with what `make_work` writes, in which the test runs."""
    monkeypatch.chdir(tmp_path)
    make_work(tmp_path)
    return tmp_path


@pytest.fixture
def words(work: Path) -> Path:
    """The same with what `make_words` writes."""
    make_words(work)
    return work
