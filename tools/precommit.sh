#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The checks before a commit, in under ten seconds and without a build: format, include layers, namespaces, sizes,
# repeated lists of kinds, codes against pages and tests, features and their evidence, library pages, links, subjects of
# commits. Each check is a script that prints what is wrong.
#   tools/precommit.sh              ln -s ../../tools/precommit.sh .git/hooks/pre-commit
set -u
cd "$(dirname "$(readlink -f "$0")")/.." || exit 2
failed=0
for check in tools/house/checks/*.sh; do
  "$check" || { echo "$check: failed"; failed=1; }
done
exit $failed
