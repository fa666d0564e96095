#!/usr/bin/env fish
# SPDX-License-Identifier: MIT
# Completes command lines in fish. Usage: complete.fish FOLDER, which has lsc.fish.
source $argv[1]/lsc.fish
set -g scratch (mktemp -d)
cd $scratch
touch tree.lsys plant.lsb notes.txt
mkdir sub
set -g failures 0

# expect LINE COMPLETION...: what follows the line, without descriptions.
function expect
    set -l got (complete -C $argv[1] | string replace -r '\t.*' '' | sort)
    set -l wanted (printf '%s\n' $argv[2..] | sort)
    if test "$got" != "$wanted"
        echo "$argv[1]: $got" >&2
        set failures (math $failures + 1)
    end
end
expect 'lsc expo' export
expect 'lsc dump --stage sk' skeleton
expect 'lsc dump --stage=sk' --stage=skeleton
expect 'lsc export --preset un' unity unreal
expect 'lsc explain condition-g' condition-gap
expect 'lsc check ' tree.lsys sub/
expect 'lsc dump ' tree.lsys plant.lsb sub/
expect 'lsc help fo' forest
expect 'lsc check --base ' sub/
cd /
rm -r $scratch
test $failures = 0
