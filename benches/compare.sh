#!/usr/bin/env bash
# The tables of docs/performance.md again: `benches/compare.sh [ROUNDS]`. Markdown on stdout.
set -euo pipefail
cd "$(dirname "$0")/.."
export ROUNDS=${1:-15}

processor=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1)
cores=$(nproc)
memory=$(awk '/^MemTotal/ { printf "%.0f GiB", $2 / 1048576 }' /proc/meminfo)
printf '%s, %s cores, %s; %s; load %s.\n\n' "${processor:-unknown processor}" "$cores" "$memory" \
  "$(rustc --version)" "$(cut -d' ' -f1 /proc/loadavg)"

printf '## Reading\n\n'
cargo bench --locked --quiet --bench peers
