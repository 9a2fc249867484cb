#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The grammars of the extension against the files in grammar/, with those of XML and C++ that an editor has.
#   tools/vscode/test/grammar.sh
set -eu -o pipefail
cd "$(dirname "$0")/../../.."
tools/vscode/package.sh >/dev/null
tools/vscode/test/editor/install.sh
editor=$PWD/build/vscode-editor/node_modules/code-server/lib/vscode/extensions
cd build/vscode
npm exec --offline -- vscode-tmgrammar-test -g "$editor/xml/syntaxes/xml.tmLanguage.json" -g "$editor/cpp/syntaxes/cpp.tmLanguage.json" \
  'test/grammar/*' 2>&1 | grep -v '^grammar not found for'  # by C++, for what programs do not have
