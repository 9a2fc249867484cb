#!/usr/bin/env bash
# The pages of docs/library say what the doc comments of stdlib/ say.
set -eu
exec "$(dirname "$0")/../../library_pages/library_pages.sh" --check
