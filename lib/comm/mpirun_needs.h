// What Open MPI needs of this machine, looked at before ranks are started: what is missing makes it fail or wait for
// ever.
#pragma once

namespace st {

/// Before mpirun: it needs a folder for its files (TMPDIR, or /tmp) and some open files for each rank, whose limit is
/// raised where it may be. Throws Error(kOutput) for the folder, Error(kUsage) for the limit. Local.
void require_needs_of_mpirun(int n_ranks);

/// Before MPI begins in a rank: what ranks of a machine exchange goes to TMPDIR or /tmp where /dev/shm has no room for
/// it, unless OMPI_MCA_btl_vader_backing_directory says something else. Local.
void choose_folder_of_messages(int n_ranks);

}  // namespace st
