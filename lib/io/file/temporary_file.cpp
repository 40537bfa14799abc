#include "io/file/temporary_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "base/error.h"
#include "io/file/output_files.h"

namespace st {
namespace {

// Names of the files that a signal has to remove. A fixed table: a signal handler may touch neither the heap nor a
// lock.
constexpr int kSlots = 16;
constexpr std::size_t kNameLength = 4096;  // PATH_MAX
struct Slot {
  std::atomic<int> state{0};  // 0 free, 1 being filled, 2 in use
  char name[kNameLength];
};
std::array<Slot, kSlots> g_slots;

constexpr const char* kSuffixesOfCad[] = {".step", ".stp", ".iges", ".igs", ".brep"};

std::string directory_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

std::string base_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? path : path.substr(slash + 1);
}

[[noreturn]] void fail(const std::string& path, const std::string& what, const std::string& remedy) {
  throw Error(ExitCode::kOutput, path + ": " + what + "; " + remedy);
}

/// Eight digits that nobody can foresee.
std::string random_digits() {
  static thread_local std::random_device device;
  char text[9];
  std::snprintf(text, sizeof text, "%08x", static_cast<unsigned>(device()));
  return text;
}

/// Beside the file that it will replace.
std::string temporary_name(const std::string& path) {
  return directory_of(path) + "/." + base_of(path) + ".tmp." + std::to_string(getpid()) + "." + random_digits();
}

/// Makes an empty file that was not there before, and follows no link; its errno, or 0.
int make_new(const std::string& name) {
  const int fd = open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (fd < 0) return errno;
  close(fd);
  return 0;
}

/// Before the file is made. Throws Error(kOutput) for names that do not fit.
int reserve_slot(const std::string& name, const std::string& path) {
  if (name.size() >= kNameLength || base_of(path).size() > 220)
    fail(path, "the name is too long", "choose a shorter one");
  for (int i = 0; i < kSlots; ++i) {
    int free = 0;
    if (!g_slots[i].state.compare_exchange_strong(free, 1)) continue;
    std::memcpy(g_slots[i].name, name.c_str(), name.size() + 1);
    g_slots[i].state.store(2);
    return i;
  }
  throw Error(ExitCode::kInternal, name + ": more than 16 files are being written at once");
}

/// Syncs a file or directory by name; some file systems cannot sync directories, which is no reason to fail.
void sync(const std::string& name, const std::string& path) {
  const int fd = open(name.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) fail(path, std::string("cannot be synced (") + std::strerror(errno) + ")", "check the disk");
  const int status = fsync(fd);
  const int error = errno;
  close(fd);
  if (status != 0 && error != EINVAL && error != EROFS && error != ENOTSUP)
    fail(path, std::string("cannot be synced (") + std::strerror(error) + ")",
         "free some space or choose another directory");
}

void fail_unless_made(const std::string& path, int error) {
  if (error != 0)
    fail(path, std::string("cannot be written (") + std::strerror(error) + ")",
         "check permissions and space, or choose another directory");
}

/// Process that made a temporary file of `base`: the number in ".base.tmp.<pid>.<n>", 0 for any other name.
pid_t maker_of(const std::string& name, const std::string& base) {
  const std::string start = "." + base + ".tmp.";
  return name.rfind(start, 0) == 0 ? static_cast<pid_t>(std::atol(name.c_str() + start.size())) : 0;
}

/// Whether the process still runs. One that has ended but whose parent has not asked for its end counts as ended.
bool is_running(pid_t process) {
  if (kill(process, 0) != 0 && errno == ESRCH) return false;
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  std::getline(file, text);  // nothing, and no exception, where the process ends between opening and reading
  const std::size_t end_of_name = text.rfind(')');  // "17 (name) S ..."
  return end_of_name == std::string::npos || end_of_name + 2 >= text.size() || text[end_of_name + 2] != 'Z';
}

constexpr auto kGrace = std::chrono::minutes(1);  // it might be a process of another machine

/// Removes what processes that were killed while writing `path` have left, when it is as old as this.
void remove_stale(const std::string& path, std::chrono::seconds grace) {
  namespace fs = std::filesystem;
  std::error_code error;
  for (fs::directory_iterator it(directory_of(path), error), end; !error && it != end; it.increment(error)) {
    const pid_t maker = maker_of(it->path().filename().string(), base_of(path));
    if (maker <= 0 || is_running(maker)) continue;
    std::error_code gone;
    const auto written = fs::last_write_time(it->path(), gone);
    if (!gone && fs::file_time_type::clock::now() - written >= grace) fs::remove(it->path(), gone);
  }
}

}  // namespace

void remove_temporaries() noexcept {
  for (Slot& slot : g_slots)
    if (slot.state.load() == 2) unlink(slot.name);
}

void remove_left_temporaries(const std::string& path) { remove_stale(path, std::chrono::seconds(0)); }

namespace {

/// A model where an output is meant: arguments in the wrong order would cost the user his CAD file.
bool has_name_of_cad(const std::string& path) {
  std::string name = base_of(path);
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  return std::any_of(std::begin(kSuffixesOfCad), std::end(kSuffixesOfCad),
                     [&](const char* suffix) { return name.ends_with(suffix); });
}

/// See require_writable(), whatever is there.
void require_place(const std::string& path) {
  if (path.empty()) throw Error(ExitCode::kOutput, "empty output name; give a file name with -o");
  const std::string directory = directory_of(path);
  struct stat info {};
  if (stat(path.c_str(), &info) == 0 && S_ISDIR(info.st_mode)) fail(path, "is a directory", "give a file name");
  if (base_of(path).empty()) fail(path, "is a directory name", "give a file name");
  if (has_name_of_cad(path)) fail(path, "is the name of a CAD file, which would be replaced", "choose another output");
  if (stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode))
    fail(path, "is a device, a pipe or a socket and would be replaced", "give the name of a file");
  if (stat(directory.c_str(), &info) != 0)
    fail(path, "directory " + directory + ": " + std::strerror(errno), "create it first");
  if (!S_ISDIR(info.st_mode)) fail(path, directory + " is not a directory", "choose another directory");
  const std::string probe = temporary_name(path);
  const int slot = reserve_slot(probe, path);
  const int error = make_new(probe);
  if (error == 0) unlink(probe.c_str());
  g_slots[slot].state.store(0);
  fail_unless_made(path, error);
}

}  // namespace

void require_writable(const std::string& path) {
  require_place(path);
  require_replaceable(path);
}

TemporaryFile::TemporaryFile(const std::string& path) : path_(path) {
  require_place(path);
  remove_stale(path, kGrace);
  name_ = temporary_name(path);
  slot_ = reserve_slot(name_, path);
  if (const int error = make_new(name_)) {
    g_slots[slot_].state.store(0);
    fail_unless_made(path, error);
  }
}

TemporaryFile::~TemporaryFile() {
  if (slot_ < 0) return;
  unlink(name_.c_str());
  g_slots[slot_].state.store(0);
}

void TemporaryFile::commit(Content content) {
  require_replaceable(path_);
  sync(name_, path_);
  if (rename(name_.c_str(), path_.c_str()) != 0)
    fail(path_, std::string("cannot be renamed into place (") + std::strerror(errno) + ")",
         "choose another name or directory");
  g_slots[slot_].state.store(0);
  slot_ = -1;
  sync(directory_of(path_), path_);
  if (content == Content::kOther) note_written(path_);
}

}  // namespace st
