#!/usr/bin/env bash
# The tables of docs/lab/performance.md again: `benches/compare.sh [ROUNDS]`. Markdown on stdout.
set -euo pipefail
cd "$(dirname "$0")/.."
export ROUNDS=${1:-15}

processor=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1)
cores=$(nproc)
memory=$(awk '/^MemTotal/ { printf "%.0f GiB", $2 / 1048576 }' /proc/meminfo)
printf '%s, %s cores, %s; %s; load %s.\n\n' "${processor:-unknown processor}" "$cores" "$memory" \
  "$(rustc --version)" "$(cut -d' ' -f1 /proc/loadavg)"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
tests/needs time

# A long take: the rows of a clip again and again, about 100 MB.
clip=$(tests/clips cmu-01_06-playground-long)
clip=${clip:-data/kick.bvh}
long=$work/long.bvh
sed '1,/^Frame Time/d' "$clip" >"$work/rows"
times=$((100000000 / $(wc -c <"$work/rows")))
frames=$(($(grep -c . "$work/rows") * times))
sed -n '1,/^Frame Time/p' "$clip" | sed -E "s/^Frames:.*/Frames: $frames/" >"$long"
for _ in $(seq "$times"); do cat "$work/rows"; done >>"$long"

printf '## Reading\n\n'
cargo bench --locked --quiet --package genga-benches --bench peers

printf '\n## Several cores\n\n'
cargo bench --locked --quiet --package genga-benches --bench cores -- "$long"

printf '\n## The chain\n\n'
cargo bench --locked --quiet --package genga-benches --bench chain

printf '\n## A study\n\n```text\n'
cargo bench --locked --quiet --package genga-benches --bench study
printf '```\n'

printf '\n## Optimal keys\n\n```text\n'
cargo bench --locked --quiet --package genga-benches --bench optimal
printf '```\n'

printf '\n## A long take\n\n'
cargo build --locked --quiet --release
/usr/bin/time -v "${CARGO_TARGET_DIR:-target}/release/genga" --quiet run "$long" --out "$work/out" 2>"$work/time"
awk -v bytes="$(wc -c <"$long")" -v frames="$frames" '
  /Elapsed/ { seconds = $NF } /Maximum resident/ { peak = 1024 * $NF }
  END {
    print "| take | file | wall (m:s) | peak memory | of the file |\n| --- | --- | --- | --- | --- |"
    printf "| %d frames | %.0f MB | %s | %.0f MB | %.2f times |\n", frames, bytes / 1e6, seconds, peak / 1e6, peak / bytes
  }' "$work/time"
