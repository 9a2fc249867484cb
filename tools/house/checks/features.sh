#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Checks that every feature named by a test, and by the list of edition 2, is a row of the standard's tables in
# tests/conformance/features.tsv.
set -eu
cd "$(dirname "$0")/../../.."
unknown=$(grep -rnE '^(//|#|<!--) features:' tests/conformance tests/programs tests/golden |
  tr -d "\r" |
  awk 'NR == FNR { known[$1] = 1; next } { sub(/^[^:]*:[0-9]*:/, "&\t"); place = $0; sub(/\t.*/, "", place)
       sub(/.*features:/, ""); sub(/ *-->$/, ""); for (i = 1; i <= NF; ++i) if (!($i in known)) print place " there is no feature " $i }' \
    tests/conformance/features.tsv -)
[ -z "$unknown" ] || { echo "$unknown"; exit 1; }
# Edition 2 is proved by rows of edition 3.
unknown=$(awk -F'\t' 'NR == FNR { known[$1] = 1; next } FNR > 1 { n = split($2, rows, " ")
    for (i = 1; i <= n; ++i) if (!(rows[i] in known)) print FILENAME ":" FNR ": there is no feature " rows[i] }' \
  tests/conformance/features.tsv tests/conformance/edition2.tsv)
[ -z "$unknown" ] || { echo "$unknown"; exit 1; }
