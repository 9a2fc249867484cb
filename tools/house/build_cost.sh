#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What a build costs, see build_cost.py. A few minutes, so no check of tools/precommit.sh.
exec python3 "$(dirname "$0")/build_cost.py" "$@"
