# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Model files as C++ headers and as JSON hold the same bits."""

from __future__ import annotations

import json
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest

from hri.core.errors import InvalidArgument
from hri.io import ModelFile, model_as_cpp, model_as_json

# A program with a double of Span: the header needs nothing else of libhri.
SPAN = """#pragma once
#include <cstddef>
namespace hri {
template <class T> struct Span {
  const T* data; std::size_t size;
};
}
"""
PROGRAM = """#include <cstdio>
#include "words.hpp"
int main() {
  const auto bytes = words();
  return std::fwrite(bytes.data, 1, bytes.size, stdout) == bytes.size ? 0 : 1;
}
"""


@pytest.fixture
def model() -> ModelFile:
    rng = np.random.default_rng(0)
    file = ModelFile()
    file.kind = "test"
    file.set_text("note", 'दो "words"\n')
    file.set_number("third", 1.0 / 3.0)
    file.set_matrix_f("single", (rng.standard_normal((3, 50)) * 10.0 ** rng.integers(-30, 12, (3, 50))).astype("f4"))
    file.set_matrix_d("double", rng.standard_normal((2, 7)) / 3.0)
    return file


def test_json_has_every_field_and_the_same_bits(model: ModelFile) -> None:
    found = json.loads(model_as_json(model))
    again = ModelFile()
    for key, text in found["metadata"].items():
        again.set_text(key, text)
    for name, tensor in found["tensors"].items():
        values = np.array(tensor["values"], tensor["dtype"])
        assert list(values.shape) == tensor["shape"]
        {"float32": again.set_matrix_f, "float64": again.set_matrix_d}[tensor["dtype"]](name, values)
    assert found["kind"] == "test" and again.to_bytes() == model.to_bytes()


def test_a_program_has_the_bytes_of_the_file(model: ModelFile, tmp_path: Path) -> None:
    (tmp_path / "hri" / "core").mkdir(parents=True)
    (tmp_path / "hri" / "core" / "types.hpp").write_text(SPAN)
    (tmp_path / "words.hpp").write_text(model_as_cpp(model, "words"))
    (tmp_path / "program.cpp").write_text(PROGRAM)
    command = ["g++", "-std=c++17", "-Wall", "-Werror", f"-I{tmp_path}", "program.cpp", "-o", "program"]
    subprocess.run(command, cwd=tmp_path, check=True)
    assert subprocess.run([tmp_path / "program"], capture_output=True, check=True).stdout == model.to_bytes()


@pytest.mark.parametrize("name", ["", "2words", "two words", "wörter", "a;b"])
def test_a_name_that_is_no_identifier_is_refused(model: ModelFile, name: str) -> None:
    with pytest.raises(InvalidArgument, match=re.escape(repr(name))):
        model_as_cpp(model, name)


def test_the_command_writes_both(model: ModelFile, hri, tmp_path: Path) -> None:  # type: ignore[no-untyped-def]
    model.write(str(tmp_path / "my words.hri"))
    result = hri("export", tmp_path / "my words.hri", "-o", tmp_path / "my words.hpp")
    assert result.code == 0 and "my_words()" in result.err
    assert (tmp_path / "my words.hpp").read_text() == model_as_cpp(model, "my_words")
    for stem, name in (("7", "model_7"), ("शब्द", "model"), ("_words", "model_words"), ("int", "int_model")):
        assert hri("export", tmp_path / "my words.hri", "-o", tmp_path / f"{stem}.hpp").code == 0
        assert (tmp_path / f"{stem}.hpp").read_text() == model_as_cpp(model, name)
    assert hri("export", tmp_path / "my words.hri", "-o", tmp_path / "a.json").code == 0
    assert json.loads((tmp_path / "a.json").read_text())["kind"] == "test"
    assert hri("export", tmp_path / "my words.hri", "-o", tmp_path / "a.json", "--name", "x").code == 2
    assert hri("export", tmp_path / "my words.hri", "-o", tmp_path / "a.txt").code == 2
    (tmp_path / "none.hri").write_bytes(b"no model")
    result = hri("export", tmp_path / "none.hri", "-o", tmp_path / "b.json")
    assert result.code == 3 and "none.hri" in result.err and not (tmp_path / "b.json").exists()
