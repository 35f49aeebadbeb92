#!/usr/bin/env bash
# All checks and tests. Needs cargo, and node with npm for the Khronos validator.
set -euo pipefail
cd "$(dirname "$0")/.."

if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  if command -v apt-get >/dev/null && [ "$(id -u)" = 0 ]; then
    apt-get update -qq && apt-get install -y -qq nodejs npm >/dev/null
  else
    echo "node and npm are needed for the Khronos glTF validator: install Debian's packages nodejs and npm" >&2
    exit 1
  fi
fi

step() { printf '\n== %s\n' "$*"; "$@"; }

step cargo fmt --all --check
step npm ci --no-audit --no-fund --silent --prefix tests/tools
step cargo clippy --workspace --all-targets --locked -- -D warnings
RUSTDOCFLAGS="-D warnings" step cargo doc --workspace --no-deps --document-private-items --locked --quiet
step cargo test --workspace --locked
