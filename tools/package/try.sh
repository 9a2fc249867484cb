#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the packages where nothing is: the Debian packages in a bare Debian 12, from which they are removed again without a
# trace, and the archive in a bare Debian 11, with its compiler. Called by `tools/long.sh packages`; needs root, debootstrap and
# lintian.
set -eu
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'echo "packages: line $LINENO failed"; cat "$work/log" 2>/dev/null' ERR
fail() { echo "packages: $*"; exit 1; }
mirror=${MIRROR:-$(sed -n 's/^URIs: //p' /etc/apt/sources.list.d/*.sources 2>/dev/null | head -1)}
tools/package/package.sh -o "$work/out" deb tar >/dev/null
errors=$(lintian "$work"/out/*.deb 2>/dev/null | grep '^E:' || true)
[ -z "$errors" ] || fail "lintian: $errors"
milliseconds() { echo $(($(date +%s%N) / 1000000)); }

debootstrap --variant=minbase bookworm "$work/bare" "$mirror" >/dev/null
(cd "$work/bare" && find . -xdev ! -path './var/*' ! -path './etc/ld.so.cache*' | sort) >"$work/before"
cp "$work"/out/rung_*.deb "$work/bare/tmp"
begin=$(milliseconds)
chroot "$work/bare" sh -c 'dpkg -i /tmp/rung_*.deb && cd /root && rung new plant && cd plant && rung run --cycles 3 --trace - --watch Main.level' >"$work/log" 2>&1
deb=$(($(milliseconds) - begin))
grep -q '^2,200,14.0$' "$work/log" || fail "no trace: $(cat "$work/log")"
chroot "$work/bare" sh -c 'cd /root/plant && rung test && rung fmt --check && rung graph -o pictures && rung emit -o code' >/dev/null
rm -r "$work"/bare/root/plant "$work"/bare/root/.cache "$work"/bare/tmp/rung_*.deb  # what the user made
chroot "$work/bare" dpkg -P rung >/dev/null
(cd "$work/bare" && find . -xdev ! -path './var/*' ! -path './etc/ld.so.cache*' | sort) >"$work/after"
cmp "$work/before" "$work/after" || fail "files remain after dpkg -P rung: $(diff "$work/before" "$work/after" | head)"

debootstrap --variant=minbase --include=g++ bullseye "$work/old" "$mirror" >/dev/null
cp "$work"/out/*.tar.gz "$work/old/root"
begin=$(milliseconds)
chroot "$work/old" sh -c 'cd /root && tar xf *.tar.gz && rm *.tar.gz && mv rung-* rung && rung/bin/rung new plant && cd plant && ../rung/bin/rung run --cycles 3 --trace - --watch Main.level' >"$work/log" 2>&1
tar=$(($(milliseconds) - begin))
grep -q '^2,200,14.0$' "$work/log" || fail "no trace: $(cat "$work/log")"
chroot "$work/old" sh -c 'cd /root/plant && PATH=/root/rung/bin:$PATH && rung test && rung graph -o pictures && rung build -o app && ./app --cycles 2' >"$work/log" 2>&1 || fail "$(cat "$work/log")"
[ "$deb" -le 5000 ] || fail "dpkg -i to the first trace took $deb ms"
[ "$tar" -le 1000 ] || fail "unpacking to the first trace took $tar ms"
echo "packages: no error of lintian; in a bare Debian 12 installed, first trace after $deb ms, removed; in a bare Debian 11 unpacked, first trace after $tar ms, a program built"
