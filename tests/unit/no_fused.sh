#!/bin/sh
# No fused multiply-add anywhere in what computes: with one, a realization's bits would depend on the instruction set. That
# contraction is off does not keep every compiler from it. A build under sanitizers is compiled otherwise.
set -eu

command -v objdump >/dev/null || { echo "skipped: there is no objdump"; exit 0; }
for library in base engine sampler; do
    objdump -d --no-show-raw-insn "$1/libfracas_$library.a" >"$1/disassembled"
    grep -q 'vmulpd' "$1/disassembled" || [ $library != engine ] || { echo "no vector instruction was found: is this the engine?"; exit 1; }
    if grep -E 'vf(n?m)(add|sub)' "$1/disassembled"; then
        echo "libfracas_$library.a has fused operations"
        exit 1
    fi
done
# Each kernel's units were looked at, with the registers that they are for.
for kernel in bar ring membrane shell blocks; do
    for registers in avx2_4:ymm avx512_8:zmm; do
        unit=${kernel}_kernel_${registers%:*}
        object=$(find "$1/CMakeFiles/$unit.dir" -name '*.o')
        [ -n "$object" ] || { echo "there is no object of $unit"; exit 1; }
        objdump -d --no-show-raw-insn "$object" | grep -q "vmulpd.*${registers#*:}" || { echo "$unit has no vector instruction"; exit 1; }
    done
done
rm "$1/disassembled"
