#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes the extension for Visual Studio Code, build/rung-VERSION.vsix. Needs npm and the network, for the packages that
# package-lock.json names; nothing is installed outside of build/vscode.
#   tools/vscode/package.sh [-o DIR]
set -eu
cd "$(dirname "$0")/../.."
output=$PWD/build
[ "${1-}" != -o ] || output=$(mkdir -p "$2" && cd "$2" && pwd)
command -v npm >/dev/null || { echo "npm is not installed" >&2; exit 2; }
work=$PWD/build/vscode
mkdir -p "$work"
find "$work" -mindepth 1 -maxdepth 1 ! -name node_modules -exec rm -r {} +
cp -r tools/vscode/. "$work"
cp LICENSE "$work"
cp stdlib/runtime/host/page/picture.js "$work/media"
cd "$work"
if ! cmp -s package-lock.json node_modules/.installed; then
  npm ci --no-audit --no-fund --loglevel=error
  cp package-lock.json node_modules/.installed
fi
npm exec --offline -- vsce package --no-dependencies --allow-missing-repository --no-rewrite-relative-links --skip-license -o "$output" >vsce.log 2>&1 ||
  { cat vsce.log; exit 1; }
ls "$output"/rung-*.vsix
