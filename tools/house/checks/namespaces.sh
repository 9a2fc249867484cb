#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Namespaces are named as folders, see namespaces.py.
exec python3 "$(dirname "$0")/../namespaces.py"
