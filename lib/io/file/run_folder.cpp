#include "io/file/run_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/error.h"
#include "io/file/journal.h"

namespace st {
namespace {

namespace fs = std::filesystem;

constexpr char kStart[] = ".st-run.";

constexpr int kTaken = -1, kNoLocks = -2;  // no descriptors

/// A folder of this user's own, open and locked; kTaken where somebody holds it, or it is none; kNoLocks where folders
/// cannot be locked.
int lock_folder(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  struct stat info {};
  if (file < 0) return errno == ENOENT || errno == ENOTDIR || errno == ELOOP ? kTaken : kNoLocks;
  if (fstat(file, &info) == 0 && info.st_uid == geteuid()) {
    if (flock(file, LOCK_EX | LOCK_NB) == 0) return file;
    if (errno != EWOULDBLOCK) return close(file), kNoLocks;
  }
  close(file);
  return kTaken;
}

void remove_folder(const std::string& path) {
  std::error_code none;
  for (int tries = 0; fs::exists(path, none) && tries < 3; ++tries) fs::remove_all(path, none);
}

/// What runs that were killed have left.
void remove_left(const std::string& parent) {
  std::error_code error;
  for (fs::directory_iterator it(parent, error), end; !error && it != end; it.increment(error)) {
    const std::string path = it->path().string();
    if (!it->path().filename().string().starts_with(kStart)) continue;
    const int lock = lock_folder(path);
    if (lock < 0) continue;
    remove_folder(path);
    close(lock);
  }
}

/// Makes a new folder; "" where that cannot be. Where nothing can be locked nothing counts as left, either.
std::string make_folder(const std::string& parent, int& lock) {
  std::string path;
  for (int tries = 0; tries < 10; ++tries) {
    path = parent + "/" + kStart + "XXXXXX";
    if (!mkdtemp(path.data())) return "";
    lock = lock_folder(path);
    if (lock == kNoLocks) break;
    if (lock >= 0 && access(path.c_str(), F_OK) == 0) break;  // else another run took it for a left one
    if (lock >= 0) close(lock);
  }
  return path;
}

std::uint64_t bytes_in(const std::string& folder) {
  std::uint64_t bytes = 0;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    std::error_code gone;
    const std::uintmax_t size = fs::file_size(it->path(), gone);
    if (!gone) bytes += size;
  }
  return bytes;
}

std::uint64_t free_bytes(const std::string& folder) {
  std::error_code error;
  const fs::space_info space = fs::space(folder, error);
  return error ? 0 : space.available;
}

}  // namespace

RunFolder::RunFolder(const std::string& disk, const std::string& memory) {
  int lock = -1;
  remove_left(disk);
  if (free_bytes(memory) >= 2 * kMostInMemory) {
    remove_left(memory);
    in_memory_ = make_folder(memory, lock);
    if (!in_memory_.empty() && lock >= 0) locks_.push_back(lock);
    lock = -1;
  }
  on_disk_ = make_folder(disk, lock);
  if (on_disk_.empty())
    throw Error(ExitCode::kOutput, disk + ": no folder can be made there (" + std::strerror(errno) +
                                       "); check permissions and space, or choose another directory");
  if (lock >= 0) locks_.push_back(lock);
}

RunFolder::~RunFolder() {
  for (const std::string& folder : folders()) remove_folder(folder);
  for (const int lock : locks_) close(lock);
}

std::vector<std::string> RunFolder::folders() const {
  std::vector<std::string> all{on_disk_};
  if (!in_memory_.empty()) all.push_back(in_memory_);
  return all;
}

std::string RunFolder::place(const std::string& name, std::uint64_t expected_bytes) {
  const bool fits = !in_memory_.empty() && bytes_in(in_memory_) + expected_bytes <= kMostInMemory &&
                    free_bytes(in_memory_) >= expected_bytes;
  return (fits ? in_memory_ : on_disk_) + "/" + name;
}

std::string RunFolder::find(const std::string& name) const {
  for (const std::string& folder : folders())
    if (const std::string path = folder + "/" + name; fs::exists(path) || fs::exists(journal_folder(path))) return path;
  return "";
}

}  // namespace st
