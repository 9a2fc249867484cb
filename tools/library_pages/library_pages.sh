#!/usr/bin/env bash
# Writes docs/library/NAME.md for each library in stdlib/: every function, block and type with its doc comment and its
# pins, from stdlib/NAME/*.st or, by family, stdlib/FAMILY/NAME/*.st. Declarations of one file with equal comments
# share an entry.
#   tools/library_pages/library_pages.sh [--check]    --check: writes nothing, fails when a page is stale
# Called with --check by tools/house/checks/library_pages.sh.
set -eu
cd "$(dirname "$0")/../.."
made=$(mktemp)
trap 'rm -f "$made"' EXIT

# One library's files. A declaration is complete at its END_…; those of members (method, action, property) are not pins.
entries() {
  LC_ALL=C awk '
    function trimmed(text) { gsub(/^[ \t]+|[ \t]+$/, "", text); return text }
    # `  {alias R} {lazy} RESET : BOOL := TRUE;  /// wins`
    function pin(line, comment,  notes, word) {
      notes = ""
      while (match(line, /\{[^}]*\}/)) {
        word = substr(line, RSTART + 1, RLENGTH - 2)
        line = substr(line, 1, RSTART - 1) substr(line, RSTART + RLENGTH)
        if (word ~ /^alias/) { gsub(/alias |\047/, "", word); notes = notes ", also `" word "`" }
        else if (word == "extensible") notes = notes ", may be repeated"
        else if (word == "lazy") notes = notes ", evaluated only when chosen"
        else if (word == "required") notes = notes ", must be connected"
      }
      return "`" trimmed(line) "`" notes (comment != "" ? " (" comment ")" : "")
    }
    # The declarations of one line of a section, which may begin and end in it.
    function declarations(line,  comment, parts, count, i, kind) {
      comment = ""
      if (match(line, /\/\/\/.*/)) { comment = trimmed(substr(line, RSTART + 3)); line = substr(line, 1, RSTART - 1) }
      sub(/\/\/.*/, "", line)
      if (match(line, /^VAR[A-Z_]*/)) { section = substr(line, 1, RLENGTH); line = substr(line, RLENGTH + 1) }
      count = split(line, parts, ";")
      for (i = 1; i <= count; ++i) {
        line = trimmed(parts[i])
        if (line == "END_VAR") section = ""
        if (line == "" || member || section !~ /^VAR_(INPUT|OUTPUT|IN_OUT)$/) continue
        kind = section == "VAR_INPUT" ? "in" : section == "VAR_OUTPUT" ? "out" : "in-out"
        list = list "- " kind " " pin(line, comment) "\n"
      }
    }
    function flush(  i) {
      for (i = 1; i <= count; ++i) {
        if (i == 1) print "\n## " toupper(substr(file, 1, 1)) substr(file, 2)
        print "\n### " first[order[i]]
        if (order[i] != "") print "\n" substr(order[i], 1, length(order[i]) - 1)
        if (pins[order[i]] != "") print "\n" pins[order[i]]
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
      doc = ""; std = ""; section = ""
    }
    section == "" && /^\/\/\// { doc = doc trimmed(substr($0, 4)) "\n"; next }
    section == "" && /^\{/ { if (match($0, /std \047[^\047]*/)) std = substr($0, RSTART + 5, RLENGTH - 5); next }
    !inside && /^FUNCTION/ {
      inside = 1; member = 0; list = ""; about = doc; doc = ""
      result = ""
      if ($1 == "FUNCTION" && /:/) { result = $0; sub(/^[^:]*: */, "", result); sub(/ *\/\/.*/, "", result) }
      for (i = 2; $i ~ /^(FINAL|ABSTRACT|PUBLIC|INTERNAL)$/; ++i) continue
      name = $i
      next
    }
    inside && /^(METHOD|ACTION|PROPERTY)/ {
      member = 1
      if ($0 !~ /^[A-Z]+ (PRIVATE|PROTECTED|INTERNAL)/) {
        line = $0; kind = tolower($1)
        sub(/^[A-Z]+ (PUBLIC )?/, "", line)
        comment = doc; sub(/\n$/, "", comment); gsub(/\n/, " ", comment)
        if (match(line, /\/\/\/.*/)) { comment = trimmed(substr(line, RSTART + 3)); line = substr(line, 1, RSTART - 1) }
        sub(/\/\/.*/, "", line)
        list = list "- " kind " `" trimmed(line) "`" (comment != "" ? " (" comment ")" : "") "\n"
      }
      doc = ""
      next
    }
    /^END_(METHOD|ACTION|PROPERTY)/ { member = 0; next }
    inside && (section != "" || /^VAR/) { declarations($0); next }
    inside && /^END_FUNCTION/ {
      inside = 0
      if (result != "") list = list "- result `" result "`\n"
      if (std != "") name = name " (" std ")"
      sub(/ iec3\)/, ", iec3)", name)
      if (std == "" && about in first) {
        others[about] = others[about] ", " name
      } else {
        first[about] = name
        pins[about] = substr(list, 1, length(list) - 1)
        order[++count] = about
      }
      doc = ""; std = ""
      next
    }
    !inside && /^TYPE [A-Za-z_]/ && doc != "" {
      name = $2; sub(/:.*/, "", name)
      if (std != "") name = name " (" std ")"
      first[doc] = name; pins[doc] = "- type"; order[++count] = doc
    }
    !inside { doc = ""; std = "" }
    END { flush() }' "$1"/*.st
}

stale=0
for folder in stdlib/*/ stdlib/*/*/; do
  name=$(basename "$folder")
  compgen -G "$folder*.st" >/dev/null || continue
  page=docs/library/$name.md
  { printf '# Library `%s`\n\n' "$name"
    echo "Generated from the doc comments in \`${folder%/}\` by \`tools/library_pages/library_pages.sh\`; do not edit. \`rung list --signature NAME\` shows"
    echo "the declaration. Functions and blocks that do the same for several types share an entry, which lists the pins of the first."
    if grep -q "{std '" "$folder"*.st; then
      echo 'Dialects in parentheses are the only ones that have an entry; with `else qualified`, the others reach it as `Library.NAME`.'
    fi
    entries "$folder"; } >"$made"
  if [ "${1:-}" != --check ]; then
    cmp -s "$made" "$page" || cp "$made" "$page"
  elif ! cmp -s "$made" "$page"; then
    echo "$page is stale; tools/library_pages/library_pages.sh updates it"
    stale=1
  fi
done
for page in docs/library/*.md; do
  name=$(basename "$page" .md)
  { compgen -G "stdlib/$name/" || compgen -G "stdlib/*/$name/"; } >/dev/null && continue
  [ "${1:-}" = --check ] || { rm "$page"; continue; }
  echo "$page: there is no library stdlib/$name"
  stale=1
done
exit $stale
