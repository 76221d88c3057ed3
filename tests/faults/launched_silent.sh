# The launcher's patience, with a script in the place of mpirun: 60 s of silence at the start, 10 s after the end.
# ctest-labels: storm
. tests/support/campaigns.sh
. "$source/tests/support/launched.sh"

fake silent <<END2
sleep 62
$ends
END2
fake lasting <<END2
$ends
exec sleep 1000
END2
fake holding <<'END2'
sleep 1000 &
exit 1
END2
fake leaving <<END2
sleep 1000 > /dev/null 2>&1 &
$ends
END2
ended lasting 6 1 '^fracas: enough'
ended leaving 6 1 '^fracas: enough'
ended silent 6 1 'the ranks have not started for a minute; check the limits' '^fracas: enough'
ended holding 6 3 'mpirun ended with status 1 before the run was over; the ranks were started 3 times'
