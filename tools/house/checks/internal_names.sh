#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# No expected output shows a name of generated code.
exec python3 "$(dirname "$0")/../internal_names.py"
