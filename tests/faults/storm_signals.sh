# 400 signals of 13 kinds to processes of runs, chosen at random, over campaigns of bars and, at the same time, of shells:
# tests/support/storm_signals.py.
# ctest-labels: storm
# ctest-mpirun
# ctest-timeout: 14400
. tests/support/campaigns.sh

signals=${FRACAS_STORM_SIGNALS:-400}
storm()
{
    /usr/bin/python3 "$source/tests/support/storm_signals.py" "$fracas" "$work" "$1" "$2" > "$2" 2>&1
}

storm $((signals / 3)) shells & # its realizations are fewer
shells=$!
status=0
storm $((signals - signals / 3)) bars || status=$?
wait $shells || status=$?
cat bars shells
exit $status
