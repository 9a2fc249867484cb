#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Draws the pictures of README.md that are not networks: from the programs and commands on the page itself.
#   tools/site/pictures.sh [DIR]     (default: docs/pictures); uses the rung of PATH, or build/bin
set -eu
cd "$(dirname "$0")/../.."
root=$PWD
out=${1:-docs/pictures}
mkdir -p "$out"
out=$(cd "$out" && pwd)
PATH=$PATH:$root/build/bin
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
block() { awk -v fence="\`\`\`st $1" '$0 == fence { inside = 1; next } /^```/ { inside = 0 } inside' "$root/README.md" >"$1"; }
block pump.st
block broken.st
rung run pump.st --cycles 40 --interval T#100ms --watch Main.level,Main.pump --plot "$out/pump.svg" >/dev/null
{ rung check broken.st --color=always 2>&1 || :; } | "$root/tools/site/terminal.py" '$ rung check broken.st' >"$out/error.svg"
