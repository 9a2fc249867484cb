#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What the evaluation of a cam costs: position, slope and curvature of a table of 1 000 segments, in CPU time, the best of
# many rounds. Prints ns for a master that moves on from cycle to cycle, and for one that jumps anywhere; ends with 1 when
# the first is above 20 ns. $CXX and $CXXFLAGS count; without them g++ -O2, as for products.
set -eu
cd "$(dirname "$0")/../.."
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
"${CXX:-g++}" -std=c++20 ${CXXFLAGS:--O2} -ffp-contract=off -I . tests/bench/cams.cpp cam/table/table.cpp -o "$folder/cams"
"$folder/cams"
