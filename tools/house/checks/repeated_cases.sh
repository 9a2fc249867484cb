#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# No more switches repeat a list of kinds than repeated_cases.tsv allows.
exec python3 "$(dirname "$0")/../repeated_cases.py" --check
