#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The first line of each commit that is not upstream yet has at most 72 characters and is followed by an empty line. Without
# git, or without an upstream branch, only the last commit is looked at, or none.
cd "$(dirname "$0")/../../.." || exit 2
git rev-parse --verify -q HEAD >/dev/null 2>&1 || exit 0
range=-1
git rev-parse --verify -q '@{upstream}' >/dev/null 2>&1 && range='@{upstream}..HEAD'
bad=$(git log --no-merges --format='%h%x09%B%x01' "$range" | awk -v RS='\001' '
  {
    sub(/^\n/, "")
    tab = index($0, "\t"); hash = substr($0, 1, tab - 1); message = substr($0, tab + 1)
    if (hash == "") next
    count = split(message, line, "\n")
    if (length(line[1]) > 72) print hash ": the subject has " length(line[1]) " characters, at most 72: " line[1]
    if (count > 1 && line[2] != "") print hash ": no empty line after the subject"
  }')
[ -z "$bad" ] || { echo "$bad"; exit 1; }
