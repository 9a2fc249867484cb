#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Links of Markdown files point to files and headings that exist, see links.py.
exec python3 "$(dirname "$0")/../links.py"
