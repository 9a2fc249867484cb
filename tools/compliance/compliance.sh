#!/usr/bin/env bash
# Writes docs/compliance.md: every feature of the standard's tables (tests/conformance/features.tsv), with the tests
# that prove it; then the names of the manuals' catalogues. A feature is supported when every test that names it
# passed, and not supported when no test names it.
#   tools/compliance/compliance.sh [--check] [build/test-results.tsv]    --check: writes nothing, fails when it is stale
# Takes the results of a full run of the test runner, which calls this with --check at its end.
set -eu
cd "$(dirname "$0")/../.."
check=
[ "${1:-}" != --check ] || { check=1; shift; }
results=${1:-build/test-results.tsv}
page=docs/compliance.md
[ -r "$results" ] || { echo "$results not found; a full run of build/bin/rung_test_runner writes it" >&2; exit 2; }

made=$(mktemp)
trap 'rm -f "$made"' EXIT
# In: the results, then the features. A test file counts once, however many tests and ways to run it has.
LC_ALL=C awk -F'\t' '
  function escaped(text) { gsub(/[*|<>]/, "\\\\&", text); return text }
  function link(file,  name) {
    name = file
    sub(/^tests\/(conformance\/)?/, "", name)
    sub(/\/test\.txt$|\.[a-z]+$/, "", name)
    return "[" name "](../" file ")"
  }
  function statusOf(key) { return tests[key] == "" ? "not supported" : key in broken ? "fails" : "supported" }
  function note(keys, file, passed,  words, count, i) {
    count = split(keys, words, " ")
    for (i = 1; i <= count; ++i) {
      if (!passed) broken[words[i]] = 1
      if (!((words[i], file) in named)) tests[words[i]] = tests[words[i]] (tests[words[i]] == "" ? "" : ", ") link(file)
      named[words[i], file] = 1
    }
  }
  FNR == 1 { ++source; next }
  source == 1 {
    note($4, $1, $3 == "passed")
    note($5, $1, $3 == "passed")
    count = split($5, words, " ")
    for (i = 1; i <= count; ++i) if (!(words[i] in covered)) { covered[words[i]] = 1; names[++covers] = words[i] }
    next
  }
  $2 == "" {
    head = $1 ~ /^[0-9]/ ? "Table " $1 ": " $3 : $3
    body = body "\n## " escaped(head) "\n\n| feature | what it is | status | tests |\n|---|---|---|---|\n"
    order[++tables] = $1
    title[$1] = head
    next
  }
  {
    table = $1
    sub(/\/.*/, "", table)
    number = substr($1, length(table) + 2)
    only = $2 == "3" ? " (edition 3 only)" : $2 == "4" ? " (edition 4)" : ""
    body = body "| " number " | " escaped($3) only " | " statusOf($1) " | " tests[$1] " |\n"
    ++rows[table]
    ++all
    if (statusOf($1) == "supported") { ++proved[table]; ++all_proved }
  }
  END {
    print "# Compliance with IEC 61131-3"
    print ""
    print "Made from a run of all tests by `tools/compliance/compliance.sh`; do not edit. Each row is a feature of the tables of edition 3"
    print "(numbers of edition 3, names in our words; tables 23 to 25 are numbered as they run); features of edition 4 follow. A feature is"
    print "supported when tests prove it and all of them passed, at every level of optimization. Without such a test it counts as not"
    print "supported."
    print ""
    printf "%d of %d features are supported.\n", all_proved, all
    print ""
    print "Motion control: the blocks of CNC that the manuals name in error texts only (SMC_NCDecoder, SMC_Interpolator, SMC_Interpolator2Dir,"
    print "SMC_GCodeViewer, SMC_ReadNCFile, SMC_ReadNCQueue, SMC_AxisDiagnosticLog, SMC_WriteDriveParamsToFile, SMC_ResetAxisGroup) and their types,"
    print "but the queue that SMC_CheckVelocities takes, are not built, not even empty: no manual describes them, and a path needs the language of a"
    print "CNC, which is another product."
    print ""
    print "| table | supported | features |"
    print "|---|---|---|"
    for (i = 1; i <= tables; ++i) printf "| %s | %d | %d |\n", escaped(title[order[i]]), proved[order[i]], rows[order[i]]
    printf "%s", body
    print "\n## Names of the manuals\n"
    print "What the programs of the manuals use, with the test that shows it; catalogue and name as in the `covers:` line of the test.\n"
    print "| name | status | tests |"
    print "|---|---|---|"
    for (i = 2; i <= covers; ++i) {  # insertion sort: the list is short and mawk has no sort
      word = names[i]
      for (k = i - 1; k >= 1 && names[k] > word; --k) names[k + 1] = names[k]
      names[k + 1] = word
    }
    for (i = 1; i <= covers; ++i) printf "| %s | %s | %s |\n", escaped(names[i]), statusOf(names[i]), tests[names[i]]
  }' "$results" tests/conformance/features.tsv >"$made"

if [ -z "$check" ]; then
  cmp -s "$made" "$page" || cp "$made" "$page"
elif ! cmp -s "$made" "$page"; then
  echo "$page does not match the last run; tools/compliance/compliance.sh updates it:"
  diff "$page" "$made" | head -20
  exit 1
fi
