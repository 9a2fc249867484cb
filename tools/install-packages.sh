#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the Debian packages that building Rung needs, and those of the tests that compile for other processors;
# does nothing when all are there. Works as root or through sudo. Called by tools/quickstart.sh and tools/test.sh.
#   tools/install-packages.sh [--tests|--quick]
# --tests: what the tests need; --quick: without the compilers for other processors, nine tenths of it. Says before it begins
# how much it downloads.
set -eu
packages=(g++ cmake ninja-build libgtest-dev python3)
[ -z "${1-}" ] || packages+=(libceres-dev libeigen3-dev socat libmodbus-dev python3-pymodbus python3-serial-asyncio
    python3-markdown-it dpkg-dev file gdb help2man neovim emacs-nox elpa-eglot chromium)
[ "${1-}" != --tests ] || packages+=(gcc-arm-none-eabi libnewlib-arm-none-eabi g++-aarch64-linux-gnu qemu-user)

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f '${Status}' "$package" 2>/dev/null || true)
  [ "$status" = "install ok installed" ] || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

if ! command -v apt-get >/dev/null; then
  echo "this is not a Debian system: install by hand what provides ${missing[*]}" >&2
  exit 2
fi
as_root=()
if [ "$(id -u)" != 0 ]; then
  command -v sudo >/dev/null || { echo "run tools/install-packages.sh as root: it installs ${missing[*]}" >&2; exit 2; }
  as_root=(sudo)
fi
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -qq
bytes=$(apt-get install -y -qq --no-install-recommends --print-uris "${missing[@]}" | awk '{ bytes += $3 } END { print bytes + 0 }')
echo "installing ${missing[*]}: $(((bytes + 999999) / 1000000)) MB to download"
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
