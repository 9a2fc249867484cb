#!/usr/bin/env bash
# Every relative link in a Markdown file points to a file that is there, and every back-quoted path of a file of the
# project in docs/ exists.
set -eu
cd "$(dirname "$0")/../.."
bad=0
while IFS=: read -r file line link; do
  target=${link#](}
  target=${target%)}
  target=${target%%#*}
  case $target in '' | http://* | https://* | mailto:*) continue ;; esac
  [ -e "$(dirname "$file")/$target" ] || { echo "$file:$line: dead link to $target"; bad=1; }
done < <(tools/house/tracked .md | xargs -d '\n' -r grep -HnoE '\]\([^) ]+\)' || true)
while IFS=: read -r file line path; do
  path=${path//\`/}
  [ -e "$path" ] || { echo "$file:$line: there is no $path"; bad=1; }
done < <(tools/house/tracked .md | grep -E '^(docs/|README|CONTRIBUTING)' |
  xargs -d '\n' -r grep -HnoE '`(frontend|sema|ir|codegen|stdlib|cam|tools|tests|samples|cmake)/[A-Za-z0-9_./-]+\.[a-z]+`' || true)
exit $bad
