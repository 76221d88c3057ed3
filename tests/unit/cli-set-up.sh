#!/bin/sh
# tools/fracas on systems that this one is not: packages missing, root or sudo or neither, no apt-get, no network, a
# build that fails. The system is a folder of stand-ins that note how they were called.
set -eu

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
bin=$folder/bin tree=$folder/tree
log=$folder/log
export log tree
unset DEBIAN_FRONTEND

stand_in() {
    cat >"$bin/$1"
    chmod +x "$bin/$1"
}

# A system with every package but libyaml-dev and sqlite3, the caller being root.
fresh() {
    rm -rf "$bin" "$tree"
    mkdir -p "$bin" "$tree/tools"
    : >"$log"
    cp tools/fracas tools/packages-debian.txt "$tree/tools"
    for tool in sh awk cat chmod cp date dirname env find flock grep mkdir mktemp readlink rm sed seq touch tr xargs; do
        ln -s "$(command -v "$tool")" "$bin/$tool"
    done
    awk '{ sub(/#.*/, "") } NF && $1 != "libyaml-dev" && $1 != "sqlite3" { print $1 }' tools/packages-debian.txt >"$tree/installed"
    stand_in dpkg-query <<'SCRIPT'
#!/bin/sh
sed 's/^/installed /' "$tree/installed"
echo 'config-files libyaml-dev'
echo 'installed yaml'
exit 1
SCRIPT
    stand_in apt-get <<'SCRIPT'
#!/bin/sh
echo "apt-get $DEBIAN_FRONTEND $*" >>"$log"
for word; do case $word in -*|[!a-z]*) ;; *) echo "$word" >>"$tree/installed" ;; esac; done
SCRIPT
    stand_in cmake <<'SCRIPT'
#!/bin/sh
echo "cmake $*" >>"$log"
[ "$PWD" = "$tree" ] || exit 1
if [ "$1" = --preset ]; then mkdir -p "build/$2"; touch "build/$2/build.ninja"; exit; fi
printf '#!/bin/sh\necho "$PWD: fracas $*"\nexit 3\n' >"build/$3/fracas"
chmod +x "build/$3/fracas"
SCRIPT
    stand_in ninja <<'SCRIPT'
#!/bin/sh
[ "$*" = '-t commands all' ] || exit 1
echo "compiled -DTWO -MD -MT o -MF d -o x/product.o -c $tree/base/product.c"
echo "compiled -DONE -MD -MT o -MF d -o x/test_one.o -c $tree/tests/unit/test_one.c"
SCRIPT
    stand_in compiled <<'SCRIPT'
#!/bin/sh
echo "compiled $*" >>"$log"
[ -z "${refused-}" ]
SCRIPT
    stand_in ctest <<'SCRIPT'
#!/bin/sh
echo "ctest $*" | sed 's/ --timeout [0-9]*00 / /' >>"$log" # five minutes times the patience
echo "summary of $2"
SCRIPT
    printf '#!/bin/sh\necho 0\n' | stand_in id
    printf '#!/bin/sh\necho 2\n' | stand_in nproc
}

# ends STATUS ARGUMENTS...: tools/fracas ARGUMENTS, called in another folder, ends with STATUS.
ends() {
    expected=$1
    shift
    got=0
    (cd "$folder" && PATH=$bin tree/tools/fracas "$@") >"$folder/out" 2>"$folder/err" </dev/null || got=$?
    [ "$got" = "$expected" ] || { echo "tools/fracas $*: status $got, not $expected"; cat "$folder/out" "$folder/err"; exit 1; }
}

# The file $1 contains (lacks) the text $2.
has() { grep -qF -- "$2" "$folder/$1" || { echo "no '$2' in $1:"; cat "$folder/$1"; exit 1; }; }
lacks() { ! grep -qF -- "$2" "$folder/$1" || { echo "'$2' in $1:"; cat "$folder/$1"; exit 1; }; }

# Root: what is missing is installed, then configured, built and called with the caller's folder and status.
fresh
ends 3 run 'a file.yaml' --jobs 2
has log 'apt-get noninteractive -q -o DPkg::Lock::Timeout=300 update'
has log 'install -y --no-install-recommends libyaml-dev'
lacks log sqlite3
has out "$folder: fracas run a file.yaml --jobs 2"
has err 'installing packages: libyaml-dev'
[ "$(tail -n 2 "$log" | tr '\n' ';')" = 'cmake --preset release;cmake --build --preset release --target fracas;' ]

# Again: nothing is said or done but asking the builder.
: >"$log"
ends 3 status study
[ ! -s "$folder/err" ] || { echo "a second call is not silent:"; cat "$folder/err"; exit 1; }
[ "$(cat "$log")" = 'cmake --build --preset release --target fracas' ]

# The tests: their packages as well, one build, the suite.
: >"$log"
ends 0 test
has log 'install -y --no-install-recommends sqlite3'
[ "$(tail -n 3 "$log" | tr '\n' ';')" = "cmake --preset werror;cmake --build --preset werror;ctest --preset werror -j 2 -LE ci|storm;" ]
[ "$(cat "$folder/out")" = 'summary of werror' ]
ends 2 test --al
has err "unknown option '--al'"

# The checks of CI: all packages, the program of clang and the warnings of clang for the tests, sanitizers, the long tests last.
: >"$log"
sed -i /clang/d "$tree/installed"
ends 0 test --ci
has log 'install -y --no-install-recommends clang libclang-rt-dev clang-format'
has log 'cmake --build --preset clang --target fracas'
has log "compiled -DONE -fsyntax-only -c $tree/tests/unit/test_one.c"
lacks log 'product.c'
grep -qx 'cmake --build --preset sanitize' "$log" || { cat "$log"; exit 1; }
has log 'ctest --preset sanitize -j 2 -LE storm|slow-sanitize'
[ "$(tail -n 1 "$log")" = 'ctest --preset werror -j 2 -L ci -LE storm' ]
[ "$(tail -n 1 "$folder/out")" = 'summary of werror' ]
: >"$log"
ends 0 test --all
has log 'ctest --preset werror -j 2 -LE ci|storm'
has log 'ctest --preset sanitize -j 2 -LE storm|slow-sanitize'
[ "$(tail -n 1 "$log")" = 'ctest --preset werror -j 2 -L ci|storm' ]

# A failure before the last tests is not forgotten; they still run.
cp "$bin/ctest" "$folder/ctest"
for failing in sanitize werror; do
    sed "s/^echo.*/&; [ \"\$2\" != $failing ]/" "$folder/ctest" >"$bin/ctest"
    ends 1 test --ci
    has out 'summary of werror'
    has err "failed: $failing"
done
ends 1 test

# What fails is run once more, alone; what passes then is unstable, and more than three of these are too many.
stand_in ctest <<'SCRIPT'
#!/bin/sh
echo "ctest $*" | sed 's/ --timeout [0-9]*00 / /' >>"$log"
results=build/$2/Testing/Temporary
mkdir -p "$results"
case $* in
*'-R ^(a/one|a/two)$' | *'-R ^(a/one|a/two|a/three|a/four)$') failing=$failing_again ;;
*) failing=$failing_first ;;
esac
rm -f "$results/LastTestsFailed.log" "$results/LastTest.log"
n=0
for name in $failing; do
    n=$((n + 1))
    echo "$n:$name" >>"$results/LastTestsFailed.log"
    printf '%s\n' "$n/9 Testing: $name" "$n/9 Test: $name" Output: ---------- >>"$results/LastTest.log"
    seq -f "$name says %g" 40 >>"$results/LastTest.log"
    printf '%s\n' '<end of output>' 'Test time = 1.00 sec' >>"$results/LastTest.log"
done
[ -z "$failing" ]
SCRIPT
export failing_first='a/one a/two' failing_again=''
: >"$log"
ends 0 test
has log 'ctest --preset werror -j 1 -R ^(a/one|a/two)$'
has out 'unstable: werror:a/one'
has out 'a/one says 40'
has out 'a/two says 11'
lacks out 'a/two says 10'
failing_again=a/two
ends 1 test
has out 'unstable: werror:a/one'
lacks out 'unstable: werror:a/two'
has err 'failed: werror:a/two'
failing_first='a/one a/two a/three a/four' failing_again=''
ends 1 test
has err 'failed: unstable-tests'
unset failing_first failing_again
cp "$folder/ctest" "$bin/ctest"
export refused=compiled
ends 1 test --ci
has out 'summary of werror'
has err 'failed: clang'
unset refused
sed -i 's/^printf.*/[ "$3" != clang ] || exit 1/' "$bin/cmake"
ends 1 test --ci
has out 'summary of werror'
has err 'failed: clang'

# Two calls at once: one builds, the other waits.
fresh
sed -i 's/^printf/mkdir building || exit 1; sleep 0.2; rmdir building; &/' "$bin/cmake"
for tool in rmdir sleep; do ln -s "$(command -v $tool)" "$bin/$tool"; done
(cd "$folder" && PATH=$bin tree/tools/fracas run a.yaml) >/dev/null 2>"$folder/other" </dev/null &
ends 3 run b.yaml
got=0
wait $! || got=$?
[ "$got" = 3 ] || { echo "the other call: status $got"; cat "$folder/other"; exit 1; }

# Not root: through sudo; without sudo, what to do is said.
fresh
printf '#!/bin/sh\necho 1000\n' | stand_in id
ends 6 run a.yaml
has err 'As root: apt-get install libyaml-dev'
printf '#!/bin/sh\necho sudo >>"$log"\nexec "$@"\n' | stand_in sudo
ends 3 run a.yaml
has log sudo

# Packages that cannot be had.
fresh
printf '#!/bin/sh\nexit 100\n' | stand_in apt-get
ends 6 run a.yaml
has err 'By hand, as root: apt-get install libyaml-dev'

# No apt-get: the packages and the commands to do it by hand.
fresh
rm "$bin/apt-get"
ends 6 run a.yaml
has err 'libyaml-dev'
has err 'cmake --preset release && cmake --build --preset release && build/release/fracas'

# A configuration or a build that fails.
fresh
sed -i 's/^\[ "$PWD".*/exit 1/' "$bin/cmake"
ends 6 run a.yaml
has err 'cmake --preset release failed'
fresh
sed -i 's/^printf.*/echo broken; exit 1/' "$bin/cmake"
ends 6 run a.yaml
has err 'cmake --build --preset release failed'
ends 6 run a.yaml
