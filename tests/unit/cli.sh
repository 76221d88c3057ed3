#!/bin/sh
# ctest-sanitize
# The command line: what is wrong with it is said in one message, with status 2, and what is asked for is printed.
set -eu

fracas=$1/fracas
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# says STATUS STREAM TEXT ARGUMENTS...: `fracas ARGUMENTS` ends with STATUS, with TEXT in out or err; a failure is one
# message on stderr and nothing on stdout.
says() {
    status=$1 stream=$2 text=$3
    shift 3
    got=0
    "$fracas" "$@" >"$folder/out" 2>"$folder/err" </dev/null || got=$?
    if [ "$got" != "$status" ] || ! grep -qF -- "$text" "$folder/$stream"; then
        echo "fracas $*: status $got, expected $status and '$text' in std$stream; it said:"
        cat "$folder/out" "$folder/err"
        exit 1
    fi
    if [ "$status" != 0 ] && { [ -s "$folder/out" ] || [ "$(grep -c '^fracas: ' "$folder/err")" != 1 ]; }; then
        echo "fracas $*: one message on stderr and no output was expected; it said:"
        cat "$folder/out" "$folder/err"
        exit 1
    fi
}

says 0 out 'fracas 0.' --version
says 0 out 'kernels for ' --version
says 0 out 'fracas run FILE' --help
says 0 out 'fracas verify STUDY' help
says 0 out 'fracas verify STUDY' help help
says 0 out '--segment-age S' help run
says 0 out '--segment-age S' run --help
says 0 out '--segment-age S' run a.yaml b.yaml -h
says 0 out 'material' reference

says 2 err 'fracas run FILE'
says 2 err 'unknown command `rum`; did you mean `run`?' rum
says 2 err 'unknown command `verfiy`; did you mean `verify`?' help verfiy
says 2 err 'there are: run, plan, status' complexity
says 2 err 'run: FILE is missing' run
says 2 err 'one argument too many: `b.yaml`' run a.yaml b.yaml
says 2 err 'one argument too many: `x`' reference x
says 2 err '`kernel` is nothing to measure; there is: kernels' bench kernel
says 2 err 'no case has `avx1024` in its name; one is ring/2500/' bench kernels --only avx1024
says 2 err 'unknown option `--jbos`; did you mean `--jobs`?' run a.yaml --jbos 2
says 2 err 'unknown option `--studdy=x`; did you mean `--study`?' run a.yaml --studdy=x
says 2 err 'unknown option `--forc`; did you mean `--force`?' run a.yaml --forc # no abbreviations: they may be another program's
says 2 err 'unknown option `--memory`' run a.yaml --memory 3
says 2 err '--walltime is `90`; it must be a time above 0 with its unit' run a.yaml --walltime 90
says 2 err 'unknown option `-j`' run a.yaml -j 2
says 2 err 'unknown option `-j`' run a.yaml -j2
says 2 err '--jobs needs a value' run a.yaml --jobs
says 2 err '--shuffle takes no value' run a.yaml --shuffle=yes
says 2 err '--json takes no value' status x --json=1
says 0 out '--times LIST' help picture
says 0 out '--resamples B' help fit
# Every mistake of a campaign file is told, each on a line.
printf 'name: a\nseed: x\nmodel: bar\nmateril: {young: 1 GPa}\nreplicas: 0\n' >"$folder/wrong.yaml"
got=0
"$fracas" plan "$folder/wrong.yaml" >"$folder/out" 2>"$folder/err" || got=$?
[ "$got" = 2 ] && [ ! -s "$folder/out" ]
[ "$(sed "s|fracas: $folder/wrong.yaml:||; s| .*||" "$folder/err" | tr '\n' ' ')" = '1:1: 1:1: 1:1: 1:1: 1:1: 1:1: 2:7: 4:1: 5:11: ' ]
# What a command refuses, with a reason, its help does not list.
says 2 err 'when all of them are complete: leave it out' converge a.yaml --part 1/2
says 2 err 'submit: --walltime follows from --time: leave it out' submit a.yaml --walltime 1h
says 2 err 'unknown option `--parts`; it knows' converge a.yaml --parts 1/2
listed=0
for command in $("$fracas" help | sed -n 's/^  fracas \([a-z][a-z-]*\) .*/\1/p' | grep -vx help); do
    "$fracas" help "$command" >"$folder/help"
    for option in $(sed -n 's/^  --\([a-z-]*\) .*/\1/p' "$folder/help"); do
        argument=$(sed -n "s/^  --$option \([^ ]\).*/\1/p" "$folder/help")
        status=0
        "$fracas" "$command" none none "--$option${argument:+=1}" >"$folder/out" 2>"$folder/err" </dev/null || status=$?
        ! grep -q 'leave it out' "$folder/err" || { echo "fracas help $command lists --$option: $(cat "$folder/err")"; exit 1; }
        [ $status -ne 0 ] || { echo "fracas $command none none --$option=1 ends with 0"; exit 1; }
        listed=$((listed + 1))
    done
done
[ $listed -gt 100 ] || { echo "only $listed options"; exit 1; }
says 2 err '--output needs a value' picture x -o
says 2 err 'unknown option `-t`' picture x -t
says 2 err '--point is `-1`; it must be a whole number from 0' picture . --point -1
for bad in 0 -1 2x 1e3 '' 99999999999999999999; do
    says 2 err "--jobs is \`$bad\`; it must be a whole number from 1" run a.yaml "--jobs=$bad"
    says 2 err "--jobs is \`$bad\`; it must be a whole number from 1" plan a.yaml "--jobs=$bad"
done
cat >"$folder/small.yaml" <<'END'
name: small
seed: 7
model: bar
geometry: {ends: periodic, length: 1 mm, area: 1 mm2}
mesh: {elements: 50}
material: {young: 275 GPa, density: 2750 kg/m3}
cohesive: {law: nitsche, fracture_energy: 100 J/m2}
strength: {distribution: uniform, minimum: 299 MPa, maximum: 301 MPa}
loading: {type: imposed-rate, rate: 1e5 1/s}
time: {stop: time, end: 300 ns}
replicas: 1
END
says 2 err '--jobs 1000000: this machine gives the run' run "$folder/small.yaml" --jobs 1000000 --study "$folder/none"
says 0 out 'for 1000000 processes' plan "$folder/small.yaml" --jobs 1000000 # of another machine
for bad in -1 5s nan inf '' 1e999; do
    says 2 err "--segment-age is \`$bad\`; it must be a number" run a.yaml "--segment-age=$bad"
    says 2 err "--segment-size is \`$bad\`; it must be a number" run a.yaml "--segment-size=$bad"
done
says 2 err '--lanes is `2`; it can be: 1, 4, 8' run a.yaml --lanes 2
says 2 err '--isa is `avx521`; did you mean `avx512`?' run a.yaml --isa avx521

# An output that cannot be written is no success.
if "$fracas" reference >/dev/full 2>"$folder/err"; then
    echo "a full disk went unnoticed"
    exit 1
fi
grep -q 'output could not be written' "$folder/err"

# What is no study is said so, and stays as it is.
mkdir "$folder/empty"
for study in "$folder/none" "$folder/empty"; do
    for command in status report picture verify; do says 5 err "$study is no study" "$command" "$study"; done
done
rmdir "$folder/empty"
[ ! -e "$folder/none" ]
