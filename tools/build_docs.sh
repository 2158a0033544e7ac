#!/usr/bin/env bash
# The reference of both languages: C++ by Doxygen, Python by pdoc, into build/docs. A warning is an error.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

mkdir -p build/docs
doxygen docs/Doxyfile
.venv/bin/python tools/build_python_docs.py build/docs/python
for page in cpp/index.html cpp/annotated.html python/hri.html; do
  [[ -s build/docs/$page ]] || { echo "build/docs/$page was not written" >&2; exit 1; }
done
cat >build/docs/index.html <<'HTML'
<!doctype html><html lang="en"><meta charset="utf-8"><title>libhri</title>
<h1>libhri</h1>
<ul><li><a href="python/hri.html">Python reference</a></li><li><a href="cpp/annotated.html">C++ reference</a></li></ul></html>
HTML
echo "build/docs/index.html"
