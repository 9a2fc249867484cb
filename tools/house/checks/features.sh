#!/usr/bin/env bash
# Checks that every feature named by a test is a row of the standard's tables in tests/conformance/features.tsv.
set -eu
cd "$(dirname "$0")/../../.."
unknown=$(grep -rnE '^(//|#|<!--) features:' tests/conformance tests/programs tests/golden |
  tr -d "\r" |
  awk 'NR == FNR { known[$1] = 1; next } { sub(/^[^:]*:[0-9]*:/, "&\t"); place = $0; sub(/\t.*/, "", place)
       sub(/.*features:/, ""); sub(/ *-->$/, ""); for (i = 1; i <= NF; ++i) if (!($i in known)) print place " there is no feature " $i }' \
    tests/conformance/features.tsv -)
[ -z "$unknown" ] || { echo "$unknown"; exit 1; }
