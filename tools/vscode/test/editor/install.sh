#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs code-server from npm in build/vscode-editor, where it is not there yet. Needs npm, the network, g++ and, for a module
# of code-server, the headers of Kerberos (libkrb5-dev). After tools/vscode/package.sh, whose Node.js it takes.
#   tools/vscode/test/editor/install.sh
set -eu
cd "$(dirname "$0")/../../../.."
modules=$PWD/build/vscode/node_modules
[ -e /usr/include/gssapi/gssapi.h ] || { echo "install libkrb5-dev: a module of code-server needs gssapi.h" >&2; exit 2; }
headers=$(find -L "$modules" -path '*/include/node/node_api.h' | head -1)
export npm_config_nodedir="${headers%/include/node/node_api.h}" PATH="$modules/.bin:$PATH"
mkdir -p build/vscode-editor
cp -r tools/vscode/test/editor/. build/vscode-editor
cd build/vscode-editor
cmp -s package-lock.json node_modules/.installed && exit 0
npm ci --no-audit --no-fund --loglevel=error
cp package-lock.json node_modules/.installed
