#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The extension in a real editor: makes it, installs code-server, and runs editor.mjs in Chromium. A failed step leaves a
# picture in build/vscode-editor/work. RUNG: another program than build/bin/rung.
#   tools/vscode/test/editor/editor.sh [PICTURES]    with PICTURES: those of the README are taken again, in this folder
set -eu
cd "$(dirname "$0")/../../../.."
top=$PWD
vsix=$(tools/vscode/package.sh | tail -1)
tools/vscode/test/editor/install.sh
PATH=$top/build/vscode/node_modules/.bin:$PATH
cd build/vscode-editor
rm -rf work
mkdir work
exec node editor.mjs "$PWD/node_modules/code-server/out/node/entry.js" "$vsix" "${RUNG:-$top/build/bin/rung}" "$PWD/work" ${1:+"$top/$1"}
