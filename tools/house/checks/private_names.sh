#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# No two files that a unity build compiles together declare the same private name.
exec python3 "$(dirname "$0")/../private_names.py"
