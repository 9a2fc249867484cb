#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The message of a commit: a subject of at most 72 characters, then nothing or an empty line. tools/house/checks/subjects.sh
# looks at the same in commits that exist.
#   ln -s ../../tools/commit_msg.sh .git/hooks/commit-msg
set -eu
subject=$(sed -n 1p "$1")
case $subject in 'Merge '*) exit 0 ;; esac
[ "${#subject}" -le 72 ] || { echo "the subject has ${#subject} characters, at most 72"; exit 1; }
[ -z "$(sed -n '2{/^#/!p;}' "$1")" ] || { echo "leave the line after the subject empty"; exit 1; }
