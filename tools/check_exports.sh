#!/usr/bin/env bash
# check_exports.sh BUILD_DIR: what shared libraries built there export is the public interface and nothing of hri::detail.
set -euo pipefail

build=${1:?usage: tools/check_exports.sh BUILD_DIR}
failed=0
shopt -s nullglob
libraries=("$build"/cpp/libhri_*.so)
((${#libraries[@]})) || { echo "no shared library in $build/cpp" >&2; exit 1; }
for library in "${libraries[@]}"; do
  fine=1
  exported=$(nm --dynamic --demangle --defined-only "$library" | cut -d' ' -f3-)
  private=$(grep -E '(^|(vtable|typeinfo|typeinfo name|guard variable) for )hri::detail::' <<<"$exported" || true)
  public=$(grep -c '^hri::' <<<"$exported" || true)
  if [[ -n $private ]]; then
    printf '%s exports private code:\n%s\n' "$library" "$private" >&2
    fine=0
  fi
  if ((public == 0)); then
    printf '%s exports nothing of hri\n' "$library" >&2
    fine=0
  fi
  # Exceptions are caught in other libraries than those that throw them.
  if [[ $library == */libhri_core.so ]] && ! grep -q '^typeinfo for hri::InvalidArgument$' <<<"$exported"; then
    printf '%s hides the exceptions\n' "$library" >&2
    fine=0
  fi
  if ((fine)); then printf '%s: %d symbols of hri, none private\n' "${library##*/}" "$public"; else failed=1; fi
done
exit "$failed"
