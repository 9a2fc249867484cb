#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes what users install, in build/packages or the folder of -o: the Debian packages rung and rung-cam-fit, the archive
# rung-VERSION-linux-x86_64.tar.gz, one folder that runs on any Linux, both with the documentation as HTML, and the conformance suite for other compilers,
# rung-conformance-VERSION.tar.gz.
#   tools/package/package.sh [--no-build] [-o DIR] [deb|tar|conformance ...]     (default: all)
# --no-build: of what build/ has.
# SOURCE_DATE_EPOCH is the time of all files in the archives (default: that of the last commit).
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
[ $# -gt 0 ] || set -- deb tar conformance
mkdir -p "$out"
out=$(cd "$out" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
log=$work/log
quietly() { "$@" >"$log" 2>&1 || { tail -40 "$log" >&2; exit 1; }; }

[ -e build/build.ninja ] || quietly cmake --preset release
build() { [ $builds = no ] || quietly cmake --build build "$@"; }
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || date +%s)}
export RUNG_SITE=$work/site
for kind; do
  [ "$kind" = conformance ] || [ -e "$RUNG_SITE" ] || quietly tools/site/site.sh -o "$RUNG_SITE"
done
version=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' build/CMakeCache.txt)
archive() {  # the folder $work/$1
  tar -C "$work" --sort=name --owner=0 --group=0 --numeric-owner --mode=go=u,go-w --mtime="@$SOURCE_DATE_EPOCH" -cf - "$1" |
    gzip -9n >"$work/$1.tar.gz"
  mv "$work/$1.tar.gz" "$out"
}

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
      archive "$name"
      ;;
    conformance)
      build --target rung_conformance
      name=rung-conformance-$version
      quietly build/bin/rung_conformance export "$work/$name"
      archive "$name"
      ;;
    *) echo "unknown package $kind: deb, tar or conformance" >&2; exit 2 ;;
  esac
done
ls "$out"
