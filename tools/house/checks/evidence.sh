#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Checks that a test has, and asserts, each feature and each name of a manual that its `features:` and `covers:` lines name.
set -eu
cd "$(dirname "$0")/../../compliance"
python3 evidence_test.py
exec python3 evidence.py
