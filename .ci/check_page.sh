#!/usr/bin/env bash
# The page for browsers, built and tried in a headless Chromium: .ci/check_page.sh [SCREENSHOTS]
#
# Installs what it needs where that is missing: Debian's chromium and Node.js, and a driver from npm in a
# folder of its own. The numbers are held against the command's, built for release.
set -euo pipefail
cd "$(dirname "$0")/.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
screenshots=${1:-target/page/screenshots}

# A warning here is of the library without files, which no other build compiles.
CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS="-D warnings" crates/fem-page/build.sh
size=$(stat -c %s target/page/index.html)
if ((size > 3000000)); then
  echo "target/page/index.html has $size bytes; allowed are 3,000,000" >&2
  exit 1
fi
[ -x "${CARGO_TARGET_DIR:-target}/release/fem-run" ] || cargo build --release --locked --quiet

if [[ ! -x ${CHROMIUM:-/usr/bin/chromium} ]]; then
  apt-get update -qq
  apt-get install -y -qq --no-install-recommends chromium >/dev/null
fi
if ! command -v npm >/dev/null; then
  apt-get update -qq
  apt-get install -y -qq --no-install-recommends nodejs npm >/dev/null
fi
cp .ci/page/* "$scratch"
(cd "$scratch" && npm install --silent --no-audit --no-fund)
node "$scratch/check.mjs" target/page/index.html "${CARGO_TARGET_DIR:-target}/release/fem-run" \
  cases "$screenshots"
