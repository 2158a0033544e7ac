# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Dependence runs one way: signal -> features -> models -> recognition -> fusion -> robot."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
INCLUDE_ROOT, SOURCE_ROOT, PYTHON_ROOT = ROOT / "cpp/include/hri", ROOT / "cpp/src", ROOT / "python/hri"

# Each folder may use those named; what is not here may not exist.
CPP = {
    "core": set(),
    "io": {"core"},
    "signal": {"core"},
    "features": {"core", "signal"},
    "models": {"core", "io"},
    "language": {"core", "io", "models"},
    "recognition": {"core", "io", "signal", "features", "models", "language", "htk"},
    "htk": {"core", "io", "signal", "features", "models", "language"},
    "vision": {"core", "io", "signal", "features"},
}
PYTHON = {
    "core": set(),
    "signal": {"core"},
    "features": {"core"},
    "models": {"core", "io"},
    "language": {"core", "models"},
    "io": {"core"},
    "htk": {"core", "io", "language"},
    "media": {"core", "io"},
    "vision": {"core", "features", "media"},
    "datasets": {"core", "media"},
    "synthetic": {"core", "io", "signal", "media", "datasets"},
    "recognition": {"core", "io", "media", "vision", "language", "htk"},
    "live": {"core", "io", "signal", "media", "datasets", "vision", "recognition"},
    "evaluation": {"core", "signal", "media", "datasets", "language", "recognition"},
    "training": {"core", "media", "datasets", "vision", "recognition", "evaluation"},
    "fusion": {"core", "io", "models", "recognition.decision"},
    "robot": {"core", "media"},
    "session": {"core", "media", "signal", "features", "vision", "recognition", "live", "fusion", "robot", "language"},
    "page": {"core", "robot"},
    "serve": {
        *("core", "io", "media", "signal", "features", "vision", "recognition", "language", "live", "fusion", "robot"),
        *("session", "page"),
    },
}
PYTHON["studies"] = {*PYTHON}
PYTHON["demo"] = {*PYTHON, "cli"} - {"studies"}
PYTHON["cli"] = {*PYTHON}
PYTHON["__main__"] = {"cli"}
# Within a package, too: what a robot is, how it moves, what controls it, who simulates it.
WITHIN = {
    "robot/model": set(),
    "robot/motion": {"model"},
    "robot/control": {"model", "motion"},
    "robot/nao": {"model", "motion", "control", "imitation"},
    "robot/simulation": {"model", "motion", "control"},
    "robot/imitation": {"model", "motion", "control", "simulation"},
}
ONLY_IN = {"pybullet": {"robot/simulation/pybullet_backend.py"}}
AT_THE_ROOT = {"__init__.py", "__main__.py"}
# The compiled modules are imported by the rooms that mirror those of C++; all else takes what these offer.
NATIVE_ROOMS = {"__init__.py", "core", "io", "signal", "features", "models", "language", "htk", "vision", "recognition"}
MAX_LINES = 450


def cpp_violations(folder: str, text: str) -> Iterator[str]:
    """What a C++ file of `folder` includes that it may not."""
    for included in re.findall(r'^\s*#include\s+[<"]([^>"]+)[>"]', text, re.MULTILINE):
        ours = re.match(r"hri/(\w+)/", included)
        if ours and ours[1] != folder and ours[1] not in CPP[folder]:
            yield f"{folder} includes {included}"
        if included.startswith("opencv2/") and folder != "vision":
            yield f"{folder} includes {included}"


def python_violations(module: str, text: str) -> Iterator[str]:
    """What a Python file, "package/file.py" or "file.py", imports that it may not."""
    package = Path(module).parts[0].removesuffix(".py")
    for imported in re.findall(r"^\s*(?:from|import)\s+([\w.]+)", text, re.MULTILINE):
        parts = imported.split(".")
        if parts[0] == "hri" and len(parts) > 1 and not parts[1].startswith("_") and package != "__init__":
            used = ".".join(parts[1:])
            allowed = {package, *PYTHON[package]}
            if not any(used == name or used.startswith(f"{name}.") for name in allowed):
                yield f"{module} imports {imported}"
            room = "/".join(Path(module).parts[:2])
            if room in WITHIN and parts[1] == package and len(parts) > 2:
                own = room.split("/")[1]
                if parts[2] != own and parts[2] not in WITHIN[room]:
                    yield f"{module} imports {imported}"
        if parts[0] in ONLY_IN and module not in ONLY_IN[parts[0]]:
            yield f"{module} imports {imported}"


def cpp_files() -> list[Path]:
    return [p for root in (INCLUDE_ROOT, SOURCE_ROOT) for p in sorted(root.rglob("*")) if p.suffix in (".hpp", ".cpp")]


def python_files() -> list[Path]:
    return sorted(PYTHON_ROOT.rglob("*.py"))


def test_cpp_folders_depend_one_way() -> None:
    found = []
    for path in cpp_files():
        folder = path.relative_to(INCLUDE_ROOT if INCLUDE_ROOT in path.parents else SOURCE_ROOT).parts[0]
        found += cpp_violations(folder, path.read_text())
    assert found == []


def test_python_packages_depend_one_way() -> None:
    found = []
    for path in python_files():
        found += python_violations(path.relative_to(PYTHON_ROOT).as_posix(), path.read_text())
    assert found == []


def test_compiled_modules_are_imported_by_the_rooms_of_cpp_alone() -> None:
    pattern = re.compile(r"^\s*(?:from hri\._native|from hri import .*_native|import hri\._native)|hri\._native", re.M)
    users = {p.relative_to(PYTHON_ROOT).parts[0] for p in python_files() if pattern.search(p.read_text())}
    assert users <= NATIVE_ROOMS
    texts = [p for root in ("docs", "benchmarks") for p in (ROOT / root).rglob("*") if p.suffix in (".md", ".py")]
    assert [p.name for p in [ROOT / "README.md", *texts] if re.search(r"(?<!kaldi)_native", p.read_text())] == []


@pytest.mark.parametrize(
    ("folder", "text"),
    [
        ("signal", '#include "hri/models/pca.hpp"\n'),
        ("core", "  #include <hri/io/file.hpp>\n"),
        ("features", "#include <opencv2/imgproc.hpp>\n"),
    ],
)
def test_a_wrong_include_is_seen(folder: str, text: str) -> None:
    assert len(list(cpp_violations(folder, text))) == 1


@pytest.mark.parametrize(
    ("module", "text"),
    [
        ("fusion/fuse.py", "from hri.recognition.word.recognizer import WordRecognizer\n"),
        ("robot/model/joints.py", "    import hri.fusion\n"),
        ("robot/model/joints.py", "import pybullet\n"),
        ("robot/model/joints.py", "from hri.robot.motion.trajectory import Trajectory\n"),
        ("media/audio.py", "from hri.datasets import Dataset\n"),
    ],
)
def test_a_wrong_import_is_seen(module: str, text: str) -> None:
    assert len(list(python_violations(module, text))) == 1
    assert list(python_violations("fusion/fuse.py", "from hri.recognition.decision import Decision\n")) == []


# Files are opened in these modules alone, so that each is written whole and read as a regular file (`hri.core.files`,
# hri/io/file.hpp); elsewhere only what belongs to the package, a buffer in memory or a device is.
OPENING = {
    ".py": re.compile(
        r"(?<![\w.])open\(|\.open\(|\.(?:read|write)_(?:text|bytes)\(|imread\(|imwrite\(|VideoWriter\(|VideoCapture\("
        r"|np\.(?:load|save|savez\w*|savetxt|loadtxt|genfromtxt|fromfile|memmap)\(|\.tofile\(|\.savefig\("
        r"|\btomllib\b|\bjson\.loads?\(|\bjson\.dump\(|\bcsv\.|\bfileinput\b|\bmkstemp\b|NamedTemporaryFile"
        r"|\bshutil\.(?:copy|move)|\bos\.(?:replace|rename)\(|\bsoundfile\.(?:read|write)\("
    ),
    ".cpp": re.compile(
        r"\bfopen\(|fstream\b|(?<!\w)::open\(|freopen\(|imread\(|imwrite\(|VideoWriter\b|VideoCapture\b|\brename\("
    ),
}
OPENING[".hpp"] = OPENING[".cpp"]
MAY_OPEN = {
    "core/files.py": r".",
    "io/file.cpp": r"::open\(",
    "io/atomic_file.cpp": r"::open\(|rename\(",
    "vision/video.cpp": r"cv::VideoCapture",
    "media/video.py": r"cv2\.VideoCapture\(name\)",
    "media/video_writer.py": r"_cv2\.VideoWriter\(name|class VideoWriter|with VideoWriter\(",
    "core/quiet.py": r"os\.open\(os\.devnull",
    "live/camera.py": r"VideoCapture\(self\._device\)",
    "cli/result_screen.py": r"VideoWriter\(in_a_folder\(video_path",
    "vision/film.py": r"with VideoWriter\(",
    "cli/features.py": r"np\.save(?:txt)?\((?:stored|text)",
    "core/plotting.py": r"savefig\(drawn",
    "demo/plots.py": r"savefig\(buffer",
    "demo/page.py": r"wave\.open\(buffer|files\(.*read_text",
    "cli/serve.py": r"webbrowser\.open\(",
    "cli/output.py": r"files\.write_",
    "recognition/word/fillers.py": r"np\.load\(data|files\(.*read_bytes",
    "robot/model/joints.py": r"tomllib|resources\.files\(.*read_text",
    "robot/nao/couplings.py": r"resources\.files\(.*read_text",
    "core/phrases.py": r"tomllib|files\(.*read_text",
    "robot/motion/gestures.py": r"resources\.files\(.*read_text",
    "page/components.py": r"files\(.*read_bytes",
    "serve/app.py": r"files\(.*read_bytes",
    "studies/endurance.py": r"/proc/self/status",
    "studies/kept.py": r"json\.loads\(json\.dumps",
    "studies/provenance.py": r"path\.read_bytes\(\)|path\.open\(\"rb\"\)",
    "studies/rendering.py": r"csv\.DictWriter\(text",
    "studies/webcam.py": r"files\(.*read_text",
    "synthetic/sentences.py": r"resources\.files\(.*read_text",
}


def opened_elsewhere(name: str, text: str) -> Iterator[str]:
    """Lines of a source file that open files by themselves."""
    allowed = re.compile(MAY_OPEN.get(name, r"(?!)"))
    for number, line in enumerate(text.splitlines(), start=1):
        if OPENING[Path(name).suffix].search(line) and not allowed.search(line):
            yield f"{name}:{number}: {line.strip()}"


def test_files_are_opened_in_one_place() -> None:
    found = []
    for path in (*cpp_files(), *python_files()):
        root = next(root for root in (INCLUDE_ROOT, SOURCE_ROOT, PYTHON_ROOT) if root in path.parents)
        found += opened_elsewhere(path.relative_to(root).as_posix(), path.read_text())
    assert found == []


@pytest.mark.parametrize(
    "line",
    [
        'with open(path, "w") as file:',
        'with path.open("rb") as file:',
        "Path(path).write_text(text)",
        "cv2.imwrite(str(path), image)",
        "writer = cv2.VideoWriter(path, fourcc, fps, size)",
        "table = tomllib.loads(text)",
        "rows = csv.reader(file)",
        "figure.savefig(path)",
    ],
)
def test_a_file_opened_elsewhere_is_seen(line: str) -> None:
    assert len(list(opened_elsewhere("robot/motion/new.py", line))) == 1
    assert list(opened_elsewhere("robot/motion/new.py", "write_text(path, text); self.wait_open(1.0)")) == []


def test_public_headers_hold_no_fixed_size_eigen_types() -> None:
    pattern = re.compile(r"Eigen::(?:Vector|Matrix|Array|RowVector)[1-9]\w*|Matrix<\s*\w+\s*,\s*[1-9]")
    found = [str(p.relative_to(ROOT)) for p in INCLUDE_ROOT.rglob("*.hpp") if pattern.search(p.read_text())]
    assert found == []


HEADER_ONLY = {"Random", "Span"}


def hidden_declarations(text: str) -> Iterator[str]:
    """Declarations of a public header that a shared library would hide: their definition is in a source file, and
    HRI_API is missing."""
    text = re.sub(r"^namespace (?:hri::)?detail \{.*?^\}  // namespace (?:hri::)?detail", "", text, flags=re.M | re.S)
    for line in re.findall(r"^class (?!HRI_API).*\{$", text, re.MULTILINE):
        if line.split()[1] not in HEADER_ONLY:
            yield line
    words = "inline|constexpr|using|extern|namespace|template|struct|enum|static|class|HRI_API|//|#| "
    for line in re.findall(rf"^(?!{words})(?:\[\[\w+\]\] )?(?!{words})[\w:<>, *&]+[ *&]\w+\(.*", text, re.MULTILINE):
        if not line.endswith("{"):
            yield line


def test_public_headers_export_what_sources_define() -> None:
    found = {str(p.relative_to(ROOT)): list(hidden_declarations(p.read_text())) for p in INCLUDE_ROOT.rglob("*.hpp")}
    assert {name: lines for name, lines in found.items() if lines} == {}


def test_a_declaration_without_export_is_seen() -> None:
    hidden = "class Codebook {\n};\nint max_level(int length);\n[[noreturn]] void fail(const char* why,\n"
    assert len(list(hidden_declarations(hidden))) == 3
    exported = "class HRI_API Codebook {\n};\nHRI_API int max_level(int length);\n[[noreturn]] HRI_API void fail();\n"
    private = "namespace detail {\nint max_level(int length);\n}  // namespace detail\n"
    inline = "inline int zero() { return 0; }\n"
    assert list(hidden_declarations(exported + private + inline)) == []


def test_every_source_mirrors_a_folder_of_headers() -> None:
    assert {p.name for p in SOURCE_ROOT.iterdir()} == {p.name for p in INCLUDE_ROOT.iterdir()} == set(CPP)


def test_nothing_is_loose_at_the_root_of_the_package() -> None:
    assert {p.name for p in PYTHON_ROOT.glob("*.py")} == AT_THE_ROOT


def source_files() -> list[Path]:
    roots = ("cpp", "bindings", "tests", "python", "benchmarks", "tools")
    files = [p for root in roots for p in (ROOT / root).rglob("*") if p.suffix in (".hpp", ".cpp", ".py")]
    return sorted(p for p in files if "__pycache__" not in p.parts)


def test_no_file_is_too_long_to_read() -> None:
    found = {str(p.relative_to(ROOT)): n for p in source_files() if (n := len(p.read_text().splitlines())) > MAX_LINES}
    assert found == {}


def test_every_file_names_its_licence() -> None:
    found = [
        str(p.relative_to(ROOT)) for p in source_files() if "SPDX-License-Identifier: Apache-2.0" not in p.read_text()
    ]
    assert found == []
