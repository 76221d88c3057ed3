# cmake --install, the folder moved: its program runs a campaign, and the C example, built by pkg-config from that folder alone,
# prints the numbers of the study.
. tests/support/campaigns.sh

expect 0 cmake --install "$(dirname "$fracas")" --prefix "$work/first"
mv first moved
export PATH="$work/moved/bin:$PATH"
export PKG_CONFIG_PATH="$work/moved/lib/pkgconfig"
grep -rlaF "$work" moved/bin moved/lib moved/include && fail "an installed file has the path of the prefix"
readelf -d moved/bin/fracas | grep -q 'R.*PATH.*\[\$ORIGIN/\.\./lib\]' || fail "the program looks for libraries elsewhere"
[ "$(command -v fracas)" = "$work/moved/bin/fracas" ] || fail "the program is not installed"

campaign small.yaml 3 1e5
expect 0 env -C / fracas run "$work/small.yaml" --study "$work/study" --jobs 2
cp moved/share/doc/fracas/examples/realize.c .
# shellcheck disable=SC2046 # words
expect 0 cc -Wall -Wextra -Werror -std=c11 -o realize realize.c $(pkg-config --cflags --libs fracas) -Wl,-rpath,"$work/moved/lib"
ldd realize | grep -q "libfracas.so.0 => $work/moved/lib/libfracas.so.0" || fail "the example does not use the installed library"
expect 0 ./realize small.yaml 0 3
cp said printed
! command -v c++ || expect 0 c++ -fsyntax-only -x c++ -Wall -Werror moved/include/fracas.h
/usr/bin/python3 - <<'PYTHON' || fail "the example's numbers are not those of the study"
import h5py
study, lines = h5py.File("study/study.h5"), open("printed").read().splitlines()
assert len(lines) == 4 and lines[3].startswith("weaker")
for i, line in enumerate(lines[:3]):
    replica, fragments, end, size = line.split("\t")
    offset = study["fragment/offset"]
    sizes = study["fragment/size"][offset[i]:offset[i + 1]]
    total = 0.0
    for one in sizes:
        total += one
    assert int(replica) == i == study["realization/replica"][i]
    assert int(fragments.split()[0]) == study["realization/fragments"][i] == len(sizes)
    assert float(end.split()[1]) == study["realization/end_time"][i], (end, study["realization/end_time"][i])
    assert float(size.split()[2]) == total/len(sizes), size
PYTHON
expect 1 ./realize no-such.yaml
said 'realize: there is no campaign file no-such.yaml'

# What the program itself writes.
for command in run plan man; do
    [ -s moved/share/man/man1/fracas-$command.1 ] || fail "no manual page of $command"
done
[ "$(find moved/share/man/man1 -name 'fracas*.1' | wc -l)" -eq "$(($("$fracas" help | grep -c '^  fracas [a-z]')))" ] || fail "not every command has a page"
"$fracas" completion bash | cmp - moved/share/bash-completion/completions/fracas
"$fracas" reference --schema | cmp - moved/share/fracas/campaign.schema.json

# The package of Python finds the program and the library of its own prefix.
if /usr/bin/python3 -c 'import h5py' 2>/dev/null; then
    PATH=/usr/bin:/bin PYTHONPATH="$work/moved/lib/python3/dist-packages" expect 0 /usr/bin/python3 -c 'if 1:
        import fracas
        print(fracas.program(), fracas.kernel.library()._name, fracas.__version__, fracas.realize("small.yaml", 0, 2)["fragments"])'
    said "^$work/moved/bin/fracas $work/moved/lib/libfracas.so.0 $("$fracas" --version | sed -n '1s/^fracas \([0-9.]*\).*/\1/p') [1-9]"
fi
