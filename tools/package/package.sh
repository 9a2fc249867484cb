#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes what users install, in build/packages or the folder of -o: the Debian packages rung and rung-cam-fit, and the archive
# rung-VERSION-linux-x86_64.tar.gz, one folder that runs on any Linux.
#   tools/package/package.sh [--no-build] [-o DIR] [deb|tar ...]     (default: both)
# --no-build: of what build/ has.
# SOURCE_DATE_EPOCH is the time of all files in the archive (default: that of the last commit).
set -eu
cd "$(dirname "$0")/../.."
out=build/packages builds=yes
while :; do
  case ${1-} in
    -o) out=$2; shift 2 ;;
    --no-build) builds=no; shift ;;
    *) break ;;
  esac
done
[ $# -gt 0 ] || set -- deb tar
mkdir -p "$out"
out=$(cd "$out" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
log=$work/log
quietly() { "$@" >"$log" 2>&1 || { tail -40 "$log" >&2; exit 1; }; }

[ -e build/build.ninja ] || quietly cmake --preset release
build() { [ $builds = no ] || quietly cmake --build build "$@"; }
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || date +%s)}
version=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' build/CMakeCache.txt)

for kind; do
  case $kind in
    deb)
      build
      (cd build && quietly cpack -G DEB -B "$work/deb")
      mv "$work"/deb/*.deb "$out"
      ;;
    tar)
      build --target rung_static rung_runtime rung_host rung_descriptions
      name=rung-$version-linux-$(uname -m)
      for component in static_tool common; do
        quietly cmake --install build --strip --component $component --prefix "$work/$name"
      done
      cp LICENSE NOTICE "$work/$name"
      tar -C "$work" --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$SOURCE_DATE_EPOCH" -cf - "$name" |
        gzip -9n >"$work/$name.tar.gz"
      mv "$work/$name.tar.gz" "$out"
      ;;
    *) echo "unknown package $kind: deb or tar" >&2; exit 2 ;;
  esac
done
ls "$out"
