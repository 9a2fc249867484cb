#!/usr/bin/env bash
# Writes docs/library/NAME.md for each library in stdlib/: every function and block with its pins and its doc comment, as
# declared in stdlib/NAME/*.st. Declarations of one file whose comments are equal share an entry.
#   tools/library_pages/library_pages.sh [--check]    --check: writes nothing, fails when a page is stale
# Called with --check by tools/house/library_pages.sh.
set -eu
cd "$(dirname "$0")/../.."
made=$(mktemp)
trap 'rm -f "$made"' EXIT

# One library's files; a declaration is complete at its END_….
entries() {
  LC_ALL=C awk '
    function trimmed(text) { gsub(/^[ \t]+|[ \t]+$/, "", text); return text }
    # `  {alias R} {lazy} RESET : BOOL := TRUE;  /// wins`
    function pin(line,  notes, word, comment) {
      notes = ""
      if (match(line, /\/\/\/.*/)) { comment = trimmed(substr(line, RSTART + 3)); line = substr(line, 1, RSTART - 1) }
      while (match(line, /\{[^}]*\}/)) {
        word = substr(line, RSTART + 1, RLENGTH - 2)
        line = substr(line, 1, RSTART - 1) substr(line, RSTART + RLENGTH)
        if (word ~ /^alias/) { gsub(/alias |\047/, "", word); notes = notes ", also `" word "`" }
        else if (word == "extensible") notes = notes ", may be repeated"
        else if (word == "lazy") notes = notes ", evaluated only when chosen"
        else if (word == "required") notes = notes ", must be connected"
      }
      sub(/;.*/, "", line)
      return "`" trimmed(line) "`" notes (comment != "" ? " (" comment ")" : "")
    }
    function flush(  i) {
      for (i = 1; i <= count; ++i) {
        print "\n### " first[order[i]] "\n\n" substr(order[i], 1, length(order[i]) - 1) "\n\n" pins[order[i]]
        if (others[order[i]] != "") print "\nAlso " substr(others[order[i]], 3) "."
      }
      count = 0
    }
    FNR == 1 {
      flush()
      delete first
      delete others
      file = FILENAME
      sub(/.*\//, "", file)
      sub(/\.st$/, "", file)
      print "\n## " toupper(substr(file, 1, 1)) substr(file, 2)
      doc = ""
    }
    !inside && /^\/\/\// { doc = doc trimmed(substr($0, 4)) "\n"; next }
    !inside && /^\{/ { if (match($0, /std \047[^\047]*/)) std = substr($0, RSTART + 5, RLENGTH - 5); next }
    !inside && /^FUNCTION/ {
      inside = 1; section = ""; list = ""
      name = $2
      result = $1 == "FUNCTION" && $3 == ":" ? $4 : ""
      next
    }
    inside && /^VAR/ { section = $1; next }
    inside && /^END_VAR/ { section = ""; next }
    inside && section ~ /^VAR_(INPUT|OUTPUT|IN_OUT)$/ && trimmed($0) != "" {
      kind = section == "VAR_INPUT" ? "in" : section == "VAR_OUTPUT" ? "out" : "in-out"
      list = list "- " kind " " pin($0) "\n"
      next
    }
    inside && /^END_FUNCTION/ {
      inside = 0
      if (result != "") list = list "- result `" result "`\n"
      if (std != "") name = name " (" std ")"
      sub(/ iec3\)/, ", iec3)", name)
      if (std == "" && doc in first) {
        others[doc] = others[doc] ", " name
      } else {
        first[doc] = name
        pins[doc] = substr(list, 1, length(list) - 1)
        order[++count] = doc
      }
      doc = ""; std = ""
    }
    END { flush() }' "$1"/*.st
}

stale=0
for folder in stdlib/*/; do
  name=$(basename "$folder")
  compgen -G "$folder*.st" >/dev/null || continue
  page=docs/library/$name.md
  { printf '# Library `%s`\n\n' "$name"
    echo "Made from the doc comments in \`stdlib/$name\` by \`tools/library_pages/library_pages.sh\`; do not edit. \`rung list --signature NAME\` shows"
    echo "the declaration. Functions and blocks that do the same for several types share an entry, which lists the pins of the first."
    entries "$folder"; } >"$made"
  if [ "${1:-}" != --check ]; then
    cmp -s "$made" "$page" || cp "$made" "$page"
  elif ! cmp -s "$made" "$page"; then
    echo "$page is stale; tools/library_pages/library_pages.sh updates it"
    stale=1
  fi
done
exit $stale
