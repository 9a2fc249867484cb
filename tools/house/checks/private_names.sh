#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# No private name of a file clashes with one of the files that a unity build compiles with it.
exec python3 "$(dirname "$0")/../private_names.py"
