#!/usr/bin/env bash
# All checks and tests. Needs cargo, a C++ compiler, node with npm for the Khronos validator and
# glTF-Transform, Chromium for the page of --html, and Mesa's Vulkan drivers, whose software adapter
# (lavapipe) draws the pictures.
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

if ! command -v chromium >/dev/null && ! command -v chromium-browser >/dev/null &&
  ! command -v google-chrome >/dev/null; then
  if command -v apt-get >/dev/null && [ "$(id -u)" = 0 ]; then
    apt-get update -qq && apt-get install -y -qq chromium >/dev/null
  else
    echo "Chromium is needed to show pages: install Debian's package chromium" >&2
    exit 1
  fi
fi

if ! command -v c++ >/dev/null && ! command -v g++ >/dev/null && ! command -v clang++ >/dev/null; then
  if command -v apt-get >/dev/null && [ "$(id -u)" = 0 ]; then
    apt-get update -qq && apt-get install -y -qq g++ >/dev/null
  else
    echo "a C++ compiler is needed for meshoptimizer: install Debian's package g++" >&2
    exit 1
  fi
fi

# Other drivers do not help: the tests draw on lavapipe alone. Who names drivers in these variables
# knows where one is.
if [ -z "${VK_DRIVER_FILES:-}${VK_ICD_FILENAMES:-}" ] &&
  ! compgen -G '/usr/share/vulkan/icd.d/lvp_icd*.json' >/dev/null &&
  ! compgen -G '/etc/vulkan/icd.d/lvp_icd*.json' >/dev/null; then
  if command -v apt-get >/dev/null && [ "$(id -u)" = 0 ]; then
    apt-get update -qq && apt-get install -y -qq mesa-vulkan-drivers >/dev/null
  else
    echo "a Vulkan software adapter (lavapipe) is needed to draw pictures: install Debian's package mesa-vulkan-drivers" >&2
    exit 1
  fi
fi
# Mesa's layer that sorts devices complains where there is no XDG_RUNTIME_DIR.
export NODEVICE_SELECT=1

step() { printf '\n== %s\n' "$*"; "$@"; }

step cargo fmt --all --check
step npm ci --no-audit --no-fund --silent --prefix tests/tools
step cargo clippy --workspace --all-targets --locked -- -D warnings
RUSTDOCFLAGS="-D warnings" step cargo doc --workspace --no-deps --document-private-items --locked --quiet
step cargo test --workspace --locked
