#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Functions over 100 lines and classes with over 60 member functions, see sizes.py.
exec python3 "$(dirname "$0")/sizes.py" "$@"
