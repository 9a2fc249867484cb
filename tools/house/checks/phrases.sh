#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# No phrase of tools/house/phrases.tsv in messages, docs and comments.
exec python3 "$(dirname "$0")/../phrases.py"
