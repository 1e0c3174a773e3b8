#!/bin/sh
# Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
# SPDX-License-Identifier: Apache-2.0
#
# Times all rows of the benches, or those that are named, and ends with one table. --write puts the rows timed into
# tests/bench/reference.txt. Called by ./dev bench, from the top folder, after the programs are built. Under ten
# minutes on two cores.
set -eu
programs=${MOR_BENCH_PROGRAMS:-build/release/bench}
reference=tests/bench/reference.txt
write=""
[ "${1:-}" != --write ] || { write=--write; shift; }
table=$(mktemp)
trap 'rm -f "$table"' EXIT
trap 'exit 130' INT TERM

known=""
for program in "$programs"/bench_*; do
    [ -x "$program" ] || { echo "bench: there is no program in $programs; run ./dev build first" >&2; exit 1; }
    known="$known $("$program" --names | tr '\n' ' ')"
done
# shellcheck disable=SC2086  # names are words of their own
for name in "$@"; do
    case " $known " in
        *" $name "*) ;;
        *) printf 'bench: there is no row "%s". Rows are:\n' "$name" >&2; printf '  %s\n' $known >&2; exit 2 ;;
    esac
done

bad=""
printf '==> This machine\n'
"${program:?}" --machine
for program in "$programs"/bench_*; do
    code=0
    "$program" $write --table "$table" "$@" || code=$?
    [ "$code" = 0 ] || bad="$bad ${program##*/} (code $code)"
done
printf '==> Speeds on all cores; the reference is what %s holds of this kind of machine\n' "$reference"
printf '%-18s %10s %15s %17s %12s %8s %8s\n' row particles 'M part.-steps/s' 'of the reference' 'bytes/part.' kappa \
    'I_CE %'
cat "$table"
[ -z "$bad" ] || { echo "bench: not completed:$bad" >&2; exit 1; }
