#!/bin/sh
# Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
# SPDX-License-Identifier: Apache-2.0
#
# Runs cases to their end, all shipped ones when none is named, and tells which of them met their references.
# Called by ./dev validate, from the top folder, after the program is built.
set -eu
program=build/release/moraine
[ -x "$program" ] || { echo "validate: there is no $program; run ./dev build first" >&2; exit 1; }
[ $# -gt 0 ] || set -- cases/*/case.cfg
results="runs/validate-$(date +%Y%m%d-%H%M%S)"
mkdir -p runs
mkdir "$results"

bad=0
for case_file in "$@"; do
    name=$(basename "$(dirname "$case_file")")
    printf '\n==> %s\n' "$case_file"
    code=0
    "$program" run "$case_file" -o "$results/$name" || code=$?
    case $code in
        0) outcome="met its references" ;;
        3) outcome="missed a reference" ;;
        *) outcome="failed with code $code" ;;
    esac
    [ "$code" = 0 ] || bad=$((bad + 1))
    printf '%-30s %s\n' "$name" "$outcome" >>"$results/outcome.txt"
done

printf '\n==> Outcome (results are in %s)\n' "$results"
cat "$results/outcome.txt"
[ "$bad" = 0 ] || { printf 'validate: %d of %d cases are not as they should be\n' "$bad" "$#" >&2; exit 1; }
