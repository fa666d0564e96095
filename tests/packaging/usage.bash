# SPDX-License-Identifier: MIT
# Checks that every script of scripts/ answers --help with its usage and exit status 0, those of bash also behind other
# arguments.
# Usage: bash usage.bash     in the root of the sources
failed=0
for script in scripts/*; do
    [[ -f $script && -x $script ]] || continue
    arguments=(--help)
    [[ $(head -1 "$script") != *bash ]] || arguments=(plant.lsys --help)
    said=$(timeout 20 "$script" "${arguments[@]}" 2>&1 </dev/null)
    status=$?
    if [[ $status != 0 || $said != *[Uu]sage:*"${script##*/}"* ]]; then
        echo "$script ${arguments[*]} ends with status $status and says:"
        echo "$said"
        failed=1
    fi
done
exit $failed
