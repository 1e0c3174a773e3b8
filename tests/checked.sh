#!/bin/sh
# Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
# SPDX-License-Identifier: Apache-2.0
#
# checked.sh MORAINE CHECKED: a few dozen steps of five cases in the checked program, which stops at the first stage or
# material that does not keep to what it declares. The state at the end is that of moraine, bit for bit.
set -eu
[ $# = 2 ] || { echo "usage: checked.sh MORAINE CHECKED, the two programs" >&2; exit 2; }
release=$1
checked=$2
results=$(mktemp -d)
trap 'rm -rf "$results"' EXIT

state_of() { # state_of PROGRAM ARGUMENT...: runs a case and prints the hash of its state
    program=$1
    shift
    "$program" run "$@" -o "$results/run" --set output.pictures=false >"$results/log" 2>&1 || {
        code=$?
        # 3: what the case expects comes later than its end here
        [ "$code" = 3 ] || { cat "$results/log" >&2; return 1; }
    }
    python3 -c 'import json, sys; print(json.load(open(sys.argv[1]))["state_hash"])' "$results/run/summary.json"
    rm -rf "$results/run"
}

compare() { # compare NAME ARGUMENT...
    name=$1
    shift
    expected=$(state_of "$release" "$@")
    found=$(state_of "$checked" "$@") || { echo "checked.sh: $name stops when checked, see above" >&2; exit 1; }
    [ "$found" = "$expected" ] || {
        echo "checked.sh: $name ends with state $found; allowed is $expected, that of $release" >&2
        exit 1
    }
    echo "$name: passes, state $found"
}

compare "soil in plane strain" cases/column-2d/case.cfg --set 'spacing=8 mm' --set 'end=0.02 s'
compare "several soils" cases/layered-slope/case.cfg --set 'spacing=0.3 m' --set 'end=0.1 s'
compare "options for soil at rest" cases/layered-slope/case.cfg --set 'spacing=0.3 m' --set 'end=0.1 s' \
    --set numerics.scheme=moraine
compare "periodic domain" cases/infinite-slope/case-slides-periodic.cfg --set numerics.gravity_ramp=0 --set 'end=0.01 s'
compare "soil, walls and elastic bodies" cases/srm-slope/case.cfg --set 'end=2 ms'
compare "soil, walls and rigid rocks" cases/blocks/case.cfg --set 'end=1 ms'
