#!/usr/bin/env zsh
# SPDX-License-Identifier: MIT
# Completes command lines in an interactive zsh. Usage: complete.zsh FOLDER, which has _lsc.
emulate -L zsh
zmodload zsh/zpty
folder=${1:A}
scratch=$(mktemp -d)
trap 'rm -rf $scratch' EXIT
touch $scratch/tree.lsys $scratch/notes.txt

# completed LINE: prints what a TAB makes of the line.
completed() {
    local text
    zpty z "cd $scratch; TERM=dumb PS1='> ' ZDOTDIR=$scratch zsh -f -i"
    zpty -w z "unsetopt zle_bracketed_paste prompt_cr prompt_sp; fpath=($folder \$fpath); autoload -Uz compinit"
    zpty -w z "compinit -u -D; print -r -- rea''dy"
    zpty -r z text '*ready*'
    zpty -w -n z "$1"$'\t'
    # The line is printed again when it is accepted: as a comment.
    zpty -w -n z $'\C-a: \C-e'
    zpty -w z "; print -r -- do''ne"
    zpty -r z text '*done*'
    zpty -d z
    print -r -- "$text"
}

failures=0
expect() { # LINE TEXT
    if [[ $(completed "$1") != *"$2"* ]]; then
        print -u2 -r -- "$1 is not completed to $2: $(completed "$1")"
        ((failures++))
    fi
}
expect 'lsc expo' 'lsc export'
expect 'lsc dump --stage=sk' '--stage=skeleton'
expect 'lsc dump --stage sk' '--stage skeleton'
expect 'lsc export --preset unr' '--preset unreal'
expect 'lsc explain condition-g' 'explain condition-gap'
expect 'lsc check tr' 'lsc check tree.lsys'
expect 'lsc help fo' 'lsc help forest'
exit $((failures > 0))
