#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes static HTML of the documentation that can be read from disk: docs/ with the library and error pages, and the files
# that they link to.
#   tools/site/site.sh [-o DIR]     (default: build/site, which is replaced); needs the package python3-markdown-it
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
out=$root/build/site
[ "${1-}" != -o ] || { out=${2?-o needs a folder}; shift 2; }
[ $# -eq 0 ] || { echo "usage: tools/site/site.sh [-o DIR]" >&2; exit 2; }
if [ -n "$(ls -A "$out" 2>/dev/null)" ] && [ ! -e "$out/search-index.js" ]; then
  echo "$out has files that are not a site; choose another folder" >&2
  exit 2
fi
for python in /usr/bin/python3 python3; do  # Debian's has Debian's packages
  "$python" -c 'import markdown_it' 2>/dev/null || continue
  mkdir -p "$(dirname "$out")"
  rm -rf "$out.new"
  "$python" "$root/tools/site/site.py" "$out.new" || { rm -rf "$out.new"; exit 1; }
  rm -rf "$out"
  mv "$out.new" "$out"
  exit
done
echo "no module markdown_it: install the package python3-markdown-it (tools/install-packages.sh --tests does)" >&2
exit 2
