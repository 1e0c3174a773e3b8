#!/bin/sh
# Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
# SPDX-License-Identifier: Apache-2.0
#
# Runs the validations of tests/validations.txt, or those whose name holds one of the words given, and tells which met
# their references. Called by ./dev validate, from the top folder, after the program is built. Takes hours, most of
# them for the craters at 2 mm.
set -eu
program=build/release/moraine
[ -x "$program" ] || { echo "validate: there is no $program; run ./dev build first" >&2; exit 1; }
results="runs/validate-$(date +%Y%m%d-%H%M%S)"
mkdir -p "$results"

is_wanted() { # is_wanted NAME WORD...: whether NAME holds one of the words, or no word is given
    wanted=$1
    shift
    [ $# -gt 0 ] || return 0
    for word in "$@"; do
        case $wanted in *"$word"*) return 0 ;; esac
    done
    return 1
}

bad=0
total=0
while read -r name case_file settings; do
    case $name in '' | '#'*) continue ;; esac
    is_wanted "$name" "$@" || continue
    printf '\n==> %s\n' "$name"
    code=0
    # shellcheck disable=SC2086  # settings are words of their own
    "$program" run "$case_file" -o "$results/$name" $settings </dev/null || code=$?
    case $code in
        0) outcome="met its references" ;;
        3) outcome="missed a reference" ;;
        *) outcome="failed with code $code" ;;
    esac
    [ "$code" = 0 ] || bad=$((bad + 1))
    total=$((total + 1))
    printf '%-24s %s\n' "$name" "$outcome" >>"$results/outcome.txt"
done <tests/validations.txt

[ "$total" -gt 0 ] || { echo "validate: no validation is named like that; see tests/validations.txt" >&2; exit 2; }
printf '\n==> Outcome (results are in %s)\n' "$results"
cat "$results/outcome.txt"
[ "$bad" = 0 ] || { printf 'validate: %d of %d are not as they should be\n' "$bad" "$total" >&2; exit 1; }
