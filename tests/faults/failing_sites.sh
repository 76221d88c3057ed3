# Each place in the program that allocates, calls MPI or SQLite, starts a process, waits, or asks the system for something fails the first
# time that it is passed, in each kind of process, one after the other. A call that a signal interrupts, or that transfers half, ends
# nothing: status 0, and the same bytes.
# ctest-labels: storm
# ctest-timeout: 7200
. tests/support/campaigns.sh
. "$source/tests/support/failing.sh"

failing memory:starter:ENOMEM:sites process:starter:EAGAIN:sites wait:starter:EINTR:sites memory:local.0.0:ENOMEM:sites memory:local.1.0:ENOMEM:sites \
    process:local.0.0:EAGAIN:sites wait:local.0.0:EINTR:sites wait:local.0.0:short:sites wait:local.1.0:EINTR:sites wait:local.1.0:short:sites \
    system:local.0.0:EIO:sites system:local.1.0:EIO:sites memory:launcher:ENOMEM:sites memory:parent:ENOMEM:sites memory:0.0:ENOMEM:sites memory:0.2:ENOMEM:sites memory:0.3:ENOMEM:sites \
    memory:1.0:ENOMEM:sites memory:1.2:ENOMEM:sites mpi:0.0:EIO:sites mpi:1.0:EIO:sites sqlite:0.0:EIO:sites disk:0.0:ENOSPC:sites \
    process:launcher:EAGAIN:sites process:0.0:EAGAIN:sites process:0.1:EAGAIN:sites process:0.2:EAGAIN:sites \
    wait:launcher:EINTR:sites wait:0.0:EINTR:sites wait:0.1:EINTR:sites wait:0.2:EINTR:sites wait:0.3:EINTR:sites wait:1.0:EINTR:sites \
    wait:launcher:short:sites wait:0.0:short:sites wait:0.1:short:sites wait:0.2:short:sites wait:0.3:short:sites \
    system:launcher:EIO:sites system:parent:EIO:sites system:0.0:EIO:sites system:0.1:EIO:sites system:0.2:EIO:sites
