# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Where everything is installed nothing is skipped, other than what not every system has."""

from __future__ import annotations

from typing import Any

import pytest

from conftest import NO_SKIPS, no_skip


def skipped(reason: str) -> pytest.TestReport:
    place: Any = ("test_any.py", 7, f"Skipped: {reason}")
    return pytest.TestReport("test_any.py::test", ("test_any.py", 7, "test"), {}, "skipped", place, "call")


@pytest.mark.parametrize(
    ("reason", "fails"),
    [
        ("could not import 'pybullet': No module named 'pybullet'", True),
        ("no espeak-ng", True),
        ("HRI_BUILD_DIR names no CMake build; ./run test --all sets it", True),
        ("could not import 'qi': No module named 'qi'", False),
        ("HRI_DATA names no folder of recordings", False),
        ("julius is not installed", False),
        ("pandas is not installed: not checking estimators for pandas objects.", False),
    ],
)
def test_what_is_skipped_fails_where_nothing_may_be(reason: str, fails: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(NO_SKIPS, raising=False)
    report = skipped(reason)
    no_skip(report)
    assert report.skipped
    monkeypatch.setenv(NO_SKIPS, "1")
    no_skip(report)
    assert report.failed == fails and (not fails or reason in str(report.longrepr))


def test_modules_that_are_skipped_fail_and_expected_failures_do_not(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(NO_SKIPS, "1")
    module = pytest.CollectReport("test_any.py", "skipped", ("test_any.py", 3, "Skipped: could not import 'cv2'"), [])
    no_skip(module)
    assert module.failed
    expected = skipped("no espeak-ng")
    expected.wasxfail = "it is known"  # type: ignore[attr-defined]
    no_skip(expected)
    assert expected.skipped
