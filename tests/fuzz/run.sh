#!/usr/bin/env bash
# Fuzzes each target for so many seconds (60 unless given), or one: run.sh [SECONDS] [TARGET].
# Needs a nightly toolchain and cargo-fuzz (cargo install cargo-fuzz). What was interesting is kept
# in target/fuzz-corpus; a fault belongs, made small by `cargo fuzz tmin`, into regressions/ under
# the name TARGET-WHAT, where the ordinary tests run it.
set -euo pipefail
cd "$(dirname "$0")/../.."
# Link-time optimisation drops what the coverage counters refer to.
export CARGO_PROFILE_RELEASE_LTO=off CARGO_PROFILE_RELEASE_CODEGEN_UNITS=16
seconds="${1:-60}"
targets="${2:-ascii binary vrml97 zip resolve convert round_trip}"
mapfile -t seeds < <(find samples/data -mindepth 1 -maxdepth 1 -type d)
for target in $targets; do
  mkdir -p "target/fuzz-corpus/$target"
  cargo +nightly fuzz run --fuzz-dir tests/fuzz "$target" "target/fuzz-corpus/$target" "${seeds[@]}" tests/fuzz/regressions -- \
    -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -max_len=65536 -print_final_stats=1
done
