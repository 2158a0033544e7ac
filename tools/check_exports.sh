#!/usr/bin/env bash
# check_exports.sh BUILD_DIR: what shared libraries built there export is the public interface and nothing of hri::detail.
set -euo pipefail

build=${1:?usage: tools/check_exports.sh BUILD_DIR}
failed=0
for library in "$build"/cpp/libhri_*.so; do
  exported=$(nm --dynamic --demangle --defined-only "$library" | cut -d' ' -f3-)
  private=$(grep -E '(^|(vtable|typeinfo|typeinfo name|guard variable) for )hri::detail::' <<<"$exported" || true)
  public=$(grep -c '^hri::' <<<"$exported" || true)
  if [[ -n $private ]]; then
    printf '%s exports private code:\n%s\n' "$library" "$private" >&2
    failed=1
  fi
  if ((public == 0)); then
    printf '%s exports nothing of hri\n' "$library" >&2
    failed=1
  fi
  # Exceptions are caught in other libraries than those that throw them.
  if [[ $library == */libhri_core.so ]] && ! grep -q '^typeinfo for hri::InvalidArgument$' <<<"$exported"; then
    printf '%s hides the exceptions\n' "$library" >&2
    failed=1
  fi
  printf '%s: %d symbols of hri, none private\n' "${library##*/}" "$public"
done
exit "$failed"
