# For tests of the launcher: a script in the place of mpirun; sourced after campaigns.sh.

campaign tiny.yaml 1 '1e5 1/s'
ends='echo "@fracas end 6 1 0 enough"' # what rank 0 says of a run that failed

# fake NAME [WORD...] < SCRIPT: starts a run whose mpirun is the script, in which $start counts from 1. Words go before `fracas`.
fake()
{
    name=$1
    shift
    mkdir -p "$name/bin"
    { printf '%s\n' '#!/bin/sh' 'start=$(($(cat count 2> /dev/null || echo 0) + 1)); echo $start > count'; cat; } > "$name/bin/mpirun"
    chmod +x "$name/bin/mpirun"
    # shellcheck disable=SC2016
    (cd "$name" && FRACAS_MPIRUN=1 PATH="$PWD/bin:$PATH" exec sh -c 'echo $$ > pid; status=0; "$@" > said 2>&1 || status=$?; echo $status > status' sh \
        "$@" "$fracas" run --no-report ../tiny.yaml --study study --jobs 1) &
}

# ended NAME STATUS STARTS WORDS...: what the run of `fake` has come to.
ended()
{
    name=$1 wanted=$2 starts=$3
    shift 3
    await "end of $name" [ -s "$name/status" ]
    cp "$name/said" said
    [ "$(cat "$name/status")" -eq "$wanted" ] || { cat said >&2; fail "$name: status $(cat "$name/status") instead of $wanted"; }
    [ "$(cat "$name/count")" -eq "$starts" ] || { cat said >&2; fail "$name: mpirun was started $(cat "$name/count") times, not $starts"; }
    for words; do said "$words"; done
}
