#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Each rule of sema/checks/rules.def has a file that begins with what it forbids, and the pages of its messages quote that
# sentence.
exec "$(dirname "$0")/../rules.py"
