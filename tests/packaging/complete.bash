#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Completes command lines with the scripts for bash, as bash calls them. Usage: complete.bash FOLDER, which has bash/lsc
# and, if lsview is built, ../lsview/bash/lsview.
set -euo pipefail
folder=$1
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT
mkdir "$scratch/sub"
touch "$scratch"/{tree.lsys,old.l++,plant.lsb,scene.toml,notes.txt}
source "$folder/bash/lsc"
[[ ! -f $folder/../lsview/bash/lsview ]] || source "$folder/../lsview/bash/lsview"
cd "$scratch"

failures=0
# expect WORD... -- COMPLETION...: checks that bash offers exactly these completions of the last word.
expect() {
    local -a words=() wanted=()
    local seen=0 word
    for word in "$@"; do
        if [[ $word == -- && $seen == 0 ]]; then seen=1; continue; fi
        if ((seen)); then wanted+=("$word"); else words+=("$word"); fi
    done
    COMP_WORDS=("${words[@]}") COMP_CWORD=$((${#words[@]} - 1)) COMPREPLY=()
    "_${words[0]}" || true # no completion is status 1
    local got
    got=$(printf '%s\n' "${COMPREPLY[@]}" | sort | tr '\n' ' ')
    if [[ $got != "$(printf '%s\n' "${wanted[@]}" | sort | tr '\n' ' ')" ]]; then
        echo "${words[*]}: $got" >&2
        failures=$((failures + 1))
    fi
}
expect lsc e -- export explain
expect lsc --vers -- --version
expect lsc dump --st -- --stage --stdin-name --steps --stream
expect lsc dump --stage s -- skeleton
expect lsc dump --stage = s -- skeleton
expect lsc dump --stage = -- tokens ast program instanced bytecode word skeleton mesh heroes cache environment
expect lsc export tree.lsys --preset un -- unity unreal
expect lsc export --format us -- usda usdz
expect lsc check --dialect l -- l3d lparser lplus lpy lsys
expect lsc explain condition-g -- condition-gap
expect lsc check --deny condition-g -- condition-gap
expect lsc help fo -- forest
expect lsc check '' -- tree.lsys old.l++ sub
expect lsc dump '' -- tree.lsys old.l++ plant.lsb sub
expect lsc forest '' -- tree.lsys old.l++ scene.toml sub
expect lsc check --fix = '' -- certain offered
expect lsc check --fix t -- tree.lsys
expect lsc check --base '' -- sub
expect lsc dump -n '' --
if declare -F _lsview >/dev/null; then
    expect lsview '' -- tree.lsys old.l++ plant.lsb scene.toml sub
    expect lsview --style w -- wireframe
    expect lsview --turn -- --turntable
fi
[[ $failures == 0 ]]
