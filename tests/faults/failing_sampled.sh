# 200 sampled calls of malloc and its like, fork, pipe2, socketpair and MPI that fail, in each kind of process, and 100 that read files of
# the study. FRACAS_STORM_SEED chooses others.
# ctest-labels: storm
# ctest-timeout: 3600
. tests/support/campaigns.sh
. "$source/tests/support/failing.sh"

failing memory:0.0:ENOMEM:40 memory:0.2:ENOMEM:40 memory:0.3:ENOMEM:10 memory:parent:ENOMEM:20 memory:1.0:ENOMEM:10 memory:1.2:ENOMEM:10 \
    process:0.0:EAGAIN process:0.1:EAGAIN process:0.2:EAGAIN:10 mpi:0.0:EIO:30 mpi:1.0:EIO:30 read:0.0:EIO:60 read:0.2:EIO:10 read:parent:EIO:30
