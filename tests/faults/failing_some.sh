# A few calls that fail or kill, one or two of each kind; failing_all.sh has all of them, failing_sampled.sh what only samples can have.
. tests/support/campaigns.sh
. "$source/tests/support/failing.sh"

failing disk:0.0:EIO:12 disk:0.2:kill:8 disk:0.2:ENOSPC:4 sqlite:0.0:EIO:6 hdf5:0.2:EIO:6 memory:0.2:ENOMEM:4
