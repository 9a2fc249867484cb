#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# docs/dialects.md shows the table of dialects, and only the table says what a dialect does.
exec python3 "$(dirname "$0")/../dialects.py" --check
