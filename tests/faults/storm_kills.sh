# 200 processes of a run killed, chosen at random, over one campaign of 2000 realizations, which is resumed each time: tests/support/storm_kills.py.
# ctest-labels: storm
# ctest-mpirun
# ctest-timeout: 5400
. tests/support/campaigns.sh

/usr/bin/python3 "$source/tests/support/storm_kills.py" "$faulty" "$work"
