#!/usr/bin/env bash
# No expected output shows a name of generated code.
exec python3 "$(dirname "$0")/../internal_names.py"
