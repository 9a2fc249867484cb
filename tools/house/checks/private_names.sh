#!/usr/bin/env bash
# No two files that a unity build compiles together declare the same private name.
exec python3 "$(dirname "$0")/../private_names.py"
