#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Checks that every relative link in a Markdown file points to an existing file, and that every back-quoted path of a
# project file in README, CONTRIBUTING and docs/ exists.
set -eu
cd "$(dirname "$0")/../../.."
dead=$({
  tools/house/tracked .md | xargs -d '\n' -r grep -HnoE '\]\([^) ]+\)' | while IFS=: read -r file line link; do
    target=${link#](}
    target=${target%)}
    target=${target%%#*}
    case $target in '' | http | https | mailto | http://* | https://* | mailto:*) continue ;; esac
    [ -e "$(dirname "$file")/$target" ] || echo "$file:$line: dead link to $target"
  done
  tools/house/tracked .md | grep -E '^(docs/|README|CONTRIBUTING)' |
    xargs -d '\n' -r grep -HnoE '`(frontend|sema|ir|codegen|stdlib|cam|tools|tests|samples|cmake)/[A-Za-z0-9_./-]+\.[a-z]+`' |
    while IFS=: read -r file line path; do
      [ -e "${path//\`/}" ] || echo "$file:$line: there is no $path"
    done
} || true)
[ -z "$dead" ] || { echo "$dead"; exit 1; }
