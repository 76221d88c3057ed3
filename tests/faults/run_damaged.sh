# ctest-sanitize
# A flipped byte in a segment, in study.h5 or in the index of a study that is done, or not: verify names it, and the next run
# gives what an undisturbed one gives, or says that the index must be made anew. Never a wrong number in study.h5.
. tests/support/campaigns.sh

# flip FILE PLACE: another byte, so many of 1000 parts into the file
flip()
{
    python3 -c 'import sys
with open(sys.argv[1], "r+b") as f:
    at = f.seek(0, 2) * int(sys.argv[2]) // 1000
    f.seek(at)
    byte = f.read(1)[0]
    f.seek(at)
    f.write(bytes([byte ^ 0x20]))' "$1" "$2"
}

campaign small.yaml 8 '3e4 1/s, 1e5 1/s'
expect 0 "$fracas" run --no-report small.yaml --study one --jobs 2
cp -r one done
expect 0 "$fracas" verify done
for place in 3 200 500 900; do
    segment=$(ls done/segments/*.h5 | head -n 1)
    flip "$segment" $place
    expect 5 "$fracas" verify done
    said "$segment: damaged"
    said 'run again'
    expect 0 "$fracas" run --no-report small.yaml --study done --jobs 2
    said "$segment: damaged"
    said 'realizations are planned again'
    [ -e "${segment%.h5}.damaged" ] || fail "$segment was not set aside"
    same one done
    expect 0 "$fracas" verify --full done
    said 'note: .*damaged: set aside'
    flip done/study.h5 $place
    expect 5 "$fracas" verify done
    said 'study.h5: damaged'
    expect 0 "$fracas" run --no-report small.yaml --study done
    same one done
done
expect 0 "$fracas" run --no-report small.yaml --study done
said 'nothing to compute'

# Before the end: two replicas more, and a segment of the first is damaged.
campaign longer.yaml 10 '3e4 1/s, 1e5 1/s'
flip "$(ls done/segments/*.h5 | tail -n 1)" 400
expect 0 "$fracas" run --no-report longer.yaml --study done --jobs 2
expect 0 "$fracas" run --no-report longer.yaml --study fresh --jobs 2
same fresh done

# A number of the index that SQLite cannot check is not believed when study.h5 is made.
cp -r one wrong
rm wrong/study.h5
sqlite3 wrong/index.sqlite 'UPDATE realization SET fragments = fragments + 1 WHERE point = 1 AND replica = 3'
expect 5 "$fracas" run small.yaml --study wrong
said 'replica 3 of point .* its row differs from its record .*fracas reindex'
[ ! -e wrong/study.h5 ] || fail "there is a study.h5 of a damaged index"
sqlite3 wrong/index.sqlite 'UPDATE realization SET fragments = fragments - 1, segment = NULL WHERE point = 1 AND replica = 3'
expect 5 "$fracas" verify wrong
said 'done without a segment'
printf 'no database at all' | dd of=wrong/index.sqlite conv=notrunc status=none
expect 5 "$fracas" run small.yaml --study wrong
said 'index.sqlite.*fracas reindex'
