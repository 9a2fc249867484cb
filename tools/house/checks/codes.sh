#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Every code of the diagnostics.def files and of sema/checks/rules.def is unique and in the registry, has a page in
# docs/errors and a test program that provokes it, and every page has a code.
set -eu
cd "$(dirname "$0")/../../.."
bad=0
lists=$(tools/house/tracked diagnostics.def rules.def)
codes=$(sed -nE 's/^RUNG_(ERROR|WARNING|INFO)\(([EWI][0-9]{4}),.*/\2/p' $lists)
for list in $lists; do
  grep -q "\"$list\"" frontend/source/registry.cpp || { echo "frontend/source/registry.cpp: does not include $list"; bad=1; }
done
for code in $(echo "$codes" | sort | uniq -d); do echo "$code is used twice in the diagnostics.def files"; bad=1; done
# An error and a warning share a number only where they are the same rule, as two dialects have it.
same=" 0116 0133 0222 0503 0526 0538 0618 0703 0704 "
for number in $(echo "$codes" | cut -c2- | sort | uniq -d); do
  [[ $same == *" $number "* ]] || { echo "$number is the number of two messages; give one of them another"; bad=1; }
done
provoked=$(grep -rhoE '(error|warning|info)\[[EWI][0-9]{4}\]' tests/golden tests/conformance tests/programs 2>/dev/null |
  grep -oE '[EWI][0-9]{4}' | sort -u || true)
for code in $codes; do
  page=docs/errors/$code.md
  if [ ! -f "$page" ]; then
    echo "$code: there is no page $page"
    bad=1
  elif ! head -1 "$page" | grep -q "^# $code: "; then
    echo "$page:1: the title is not \`# $code: ...\`"
    bad=1
  fi
  # The tests run the broken program of the page, too; a page without one gives the reason.
  if ! grep -qx "$code" <<<"$provoked" && ! grep -qsE '^(```[a-z]+ broken|<!-- no program: )' "$page"; then
    echo "$code: no test provokes it"
    bad=1
  fi
done
for page in docs/errors/[EWI][0-9][0-9][0-9][0-9].md; do
  [ -e "$page" ] || continue
  code=$(basename "$page" .md)
  grep -qx "$code" <<<"$codes" || { echo "$page: there is no code $code"; bad=1; }
done
exit $bad
