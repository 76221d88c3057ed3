# Every write, fsync, rename, open, close, ... of files of the study by rank 0, by what it forks and by the parent, each failing, running
# out of space, killing, or killing in the middle of what is written; every call of SQLite and of HDF5 failing. Checked each time:
# tests/support/failing_calls.py.
# ctest-labels: storm
# ctest-timeout: 7200
. tests/support/campaigns.sh
. "$source/tests/support/failing.sh"

failing disk:0.0:EIO disk:0.2:EIO disk:parent:EIO disk:0.0:kill disk:0.2:kill disk:parent:kill disk:0.0:torn disk:0.2:torn \
    disk:0.0:ENOSPC disk:0.2:ENOSPC disk:parent:ENOSPC sqlite:0.0:EIO sqlite:0.0:late sqlite:parent:EIO hdf5:0.2:EIO hdf5:0.0:EIO
