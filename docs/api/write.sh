#!/usr/bin/env bash
# Writes docs/api.md from the public headers; with --check says whether it is what they give.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

version=$(doxygen --version | cut -d' ' -f1)
# Versions lay out declarations in ways of their own.
if [ "${1:-}" = --check ] && ! grep -q "with Doxygen $version;" docs/api.md; then
  echo "SKIPPED: docs/api.md was written by another Doxygen than $version"
  exit 0
fi
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT
{ cat docs/api/Doxyfile; echo "OUTPUT_DIRECTORY = $made"; } | doxygen -
python3 docs/api/write_api.py "$made/xml" "$made/api.md" "$version"
if [ "${1:-}" = --check ]; then
  cmp -s "$made/api.md" docs/api.md || { echo "docs/api.md is not what the headers say: ./run api"; exit 1; }
else
  cp "$made/api.md" docs/api.md
fi
