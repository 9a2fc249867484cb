#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Checks that the pages of docs/library agree with the doc comments of stdlib/.
set -eu
exec "$(dirname "$0")/../../library_pages/library_pages.sh" --check
