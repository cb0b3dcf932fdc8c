#!/usr/bin/env bash
# Checks the tools for a target and installs what is missing: tools.sh dev|page|test
# Cargo's tools go to .tools, npm's to node_modules; rustup's target and Debian's browsers are shared. What was compiled once
# is kept in the user's cache for the next checkout.
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/versions.env
export PATH="$PWD/.tools/bin:$PWD/node_modules/.bin:$PATH"

say() { printf '== %s\n' "$*"; }
die() { printf 'error: %s\n' "$*" >&2; exit 1; }
have() { command -v "$1" >/dev/null 2>&1; }

KEPT="${XDG_CACHE_HOME:-$HOME/.cache}/harvester-lab"

# cargo_tool COMMAND VERSION ARGUMENT...
# The tools run for seconds: compiling them quickly matters more than how fast they are.
cargo_tool() {
  local command="$1" version="$2"
  shift 2
  mkdir -p .tools/bin
  cp "$KEPT/$command-$version" ".tools/bin/$command" 2>/dev/null && [[ "$($command --version 2>/dev/null)" == *" $version" ]] && return
  say "compiling $command $version into .tools (a few minutes, once)"
  CARGO_PROFILE_RELEASE_OPT_LEVEL=1 CARGO_PROFILE_RELEASE_LTO=off CARGO_PROFILE_RELEASE_CODEGEN_UNITS=16 \
    cargo install --root .tools --target-dir target/tools --no-default-features --force --version "$version" "$@"
  mkdir -p "$KEPT" && cp ".tools/bin/$command" "$KEPT/$command-$version"
}

rust() {
  have cargo || die "Rust is missing: install it from https://rustup.rs and run this again"
  local library
  library="$(rustc --print sysroot)/lib/rustlib"
  [ -d "$library/wasm32-unknown-unknown" ] && return
  have rustup || die "this Rust is not managed by rustup and lacks the target wasm32-unknown-unknown: install \
that target with the manager it came from (Debian: libstd-rust-dev-wasm32), or install Rust from https://rustup.rs"
  say "adding Rust's target wasm32-unknown-unknown (seconds to a minute)"
  rustup target add wasm32-unknown-unknown
}

trunk_() {
  [ "$(trunk --version 2>/dev/null)" = "trunk $TRUNK_VERSION" ] && return
  cargo_tool trunk "$TRUNK_VERSION" --locked trunk
}

bindgen() {
  local version
  version="$(awk '/^name = "wasm-bindgen"$/ { getline; gsub(/"/, ""); print $3 }' Cargo.lock)"
  [ -n "$version" ] || die "Cargo.lock names no wasm-bindgen"
  [ "$(wasm-bindgen --version 2>/dev/null)" = "wasm-bindgen $version" ] && return
  # Not --locked: the lock file it was published with names a crate version that is gone.
  cargo_tool wasm-bindgen "$version" wasm-bindgen-cli
}

wasm_opt() {
  local wanted
  wanted="$(sed -n 's/.*"binaryen": "\([0-9]*\).*/\1/p' package.json)"
  # Debian's much older one exits with success and leaves a module that browsers refuse.
  [[ "$(wasm-opt --version 2>/dev/null)" == *"version $wanted"* ]] && return
  have npm || die "wasm-opt $wanted is missing, and npm to fetch it: install node with npm, \
or put binaryen $wanted on the PATH (https://github.com/WebAssembly/binaryen/releases)"
  say "fetching binaryen $wanted into node_modules (a minute, once)"
  npm ci --no-audit --no-fund --loglevel=error
}

# axe-core, which the browser tests put into the page.
axe() {
  local wanted
  wanted="$(sed -n 's/.*"axe-core": "\([0-9.]*\)".*/\1/p' package.json)"
  grep -qs "\"version\": \"$wanted\"" node_modules/axe-core/package.json && return
  have npm || die "the browser tests need axe-core $wanted, and npm to fetch it: install node with npm"
  say "fetching axe-core $wanted into node_modules (a minute, once)"
  npm ci --no-audit --no-fund --loglevel=error
}

# Debian's packages, for the browser tests: debian ADVICE PACKAGE...
debian() {
  local advice="$1"
  shift
  have apt-get || die "$advice"
  local root=()
  [ "$(id -u)" = 0 ] || root=(sudo -n)
  say "installing Debian's $* (a minute or two)"
  "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -qq </dev/null || die "$advice"
  "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends "$@" \
    </dev/null >/dev/null || die "$advice"
}

chromium_() {
  have "${CHROMEDRIVER:-chromedriver}" && { have "${CHROMIUM:-chromium}" || have chromium-browser || have google-chrome; } && return
  debian "the browser tests need Chromium and chromedriver: apt-get install chromium chromium-driver, \
or set CHROMIUM and CHROMEDRIVER to where they are" chromium chromium-driver
}

# Xvfb is the screen that Firefox needs for WebGL, Mesa draws.
firefox_() {
  { have "${FIREFOX:-firefox-esr}" || have firefox; } && have "${XVFB:-Xvfb}" && return
  debian "the browser tests need Firefox and Xvfb: apt-get install firefox-esr xvfb libgl1-mesa-dri libegl1, \
or set FIREFOX and XVFB to where they are" firefox-esr xvfb libgl1-mesa-dri libegl1
}

rust
case "${1:-page}" in
  dev) trunk_; bindgen ;;
  page) trunk_; bindgen; wasm_opt ;;
  test) trunk_; bindgen; wasm_opt; axe; chromium_; firefox_ ;;
  browser) axe; chromium_; firefox_ ;;
  *) die "tools.sh dev|page|test|browser" ;;
esac
