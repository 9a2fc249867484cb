#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Functions over 60 lines, and classes with over 60 member functions or 30 data members, see sizes.py.
exec python3 "$(dirname "$0")/sizes.py" "$@"
