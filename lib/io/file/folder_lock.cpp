#include "io/file/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

#include "base/error.h"

namespace st {

FolderLock::FolderLock(const std::string& folder) : file_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (file_ < 0 || flock(file_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  close(file_);
  throw Error(ExitCode::kOutput,
              folder + ": another run is working in this folder; wait for its end, or choose another folder");
}

FolderLock::~FolderLock() {
  if (file_ >= 0) close(file_);
}

}  // namespace st
