#include "comm/mpirun_needs.h"

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

#include "base/error.h"

namespace st {
namespace {

// Measured with Open MPI 4.1.4: 2 ranks start with a limit of 40, 4 with 48, 8 with 64. Below, mpirun waits for ever.
constexpr rlim_t kOwnFiles = 32, kFilesPerRank = 4;
constexpr rlim_t kWantedFiles = 4096;  // where the hard limit allows it
/// btl_vader_segment_size of Open MPI 4, and as much again for what else is there.
constexpr double kMessageBytesPerRank = 2 * 4.2e6;
constexpr const char* kVariable = "OMPI_MCA_btl_vader_backing_directory";

std::string temporary_folder() {
  const char* folder = std::getenv("TMPDIR");
  return folder && *folder ? folder : "/tmp";
}

void require_folder() {
  const std::string folder = temporary_folder();
  struct stat info {};
  const int status = stat(folder.c_str(), &info);
  const char* cause = status != 0                                ? std::strerror(errno)
                      : !S_ISDIR(info.st_mode)                   ? "no folder"
                      : access(folder.c_str(), W_OK | X_OK) != 0 ? std::strerror(errno)
                                                                 : nullptr;
  if (cause)
    throw Error(ExitCode::kOutput, folder + ": mpirun cannot keep its files there (" + cause +
                                       "); set TMPDIR to a folder that you may write to, or leave --np out");
}

void require_files(int n_ranks) {
  const rlim_t needed = kOwnFiles + kFilesPerRank * static_cast<rlim_t>(n_ranks);
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  const rlimit raised{std::max(limit.rlim_cur, std::min(limit.rlim_max, std::max(kWantedFiles, needed))),
                      limit.rlim_max};
  if (setrlimit(RLIMIT_NOFILE, &raised) == 0) limit = raised;
  if (limit.rlim_cur < needed)
    throw Error(ExitCode::kUsage, "--np: mpirun needs " + std::to_string(needed) + " open files for " +
                                      std::to_string(n_ranks) + " ranks, and the limit is " +
                                      std::to_string(limit.rlim_cur) + "; raise it (ulimit -n), or leave --np out");
}

}  // namespace

void require_needs_of_mpirun(int n_ranks) {
  require_folder();
  require_files(n_ranks);
}

void choose_folder_of_messages(int n_ranks) {
  struct statvfs shared {};
  if (statvfs("/dev/shm", &shared) == 0 &&
      static_cast<double>(shared.f_bavail) * static_cast<double>(shared.f_frsize) >= kMessageBytesPerRank * n_ranks)
    return;
  setenv(kVariable, temporary_folder().c_str(), 0);
}

}  // namespace st
