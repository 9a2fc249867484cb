#!/usr/bin/env bash
# No phrase of tools/house/phrases.tsv in messages, docs and comments.
exec python3 "$(dirname "$0")/../phrases.py"
