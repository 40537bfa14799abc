#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <limits>
#include <set>
#include <string_view>
#include <system_error>

#include "base/log.h"
#include "io/file/journal_record.h"

namespace st {
namespace {

using RecordHead = Journal::RecordHead;
namespace fs = std::filesystem;

constexpr int kMostRuns = 999'999;  // of one journal, and ranks of a run: what has a higher number is not ours

bool read_all(int file, void* to, std::size_t n, std::uint64_t at) {
  for (std::size_t done = 0; done < n;) {
    const ssize_t got = pread(file, static_cast<char*>(to) + done, n - done, static_cast<off_t>(at + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    done += static_cast<std::size_t>(got);
  }
  return true;
}

std::optional<RecordHead> read_head(int file, std::uint64_t at) {
  RecordHead head;
  const RecordHead wanted;
  if (!read_all(file, &head, sizeof head, at) || std::memcmp(head.magic, wanted.magic, sizeof head.magic) != 0 ||
      head.check != head.sum())
    return std::nullopt;
  return head;
}

/// Calls visit(head, place of its bytes) for every whole record.
template <class Visit>
void for_each_record(int file, const Visit& visit) {
  struct stat info {};
  if (fstat(file, &info) != 0) return;
  const auto size = static_cast<std::uint64_t>(info.st_size);
  for (std::uint64_t at = 0; at + sizeof(RecordHead) <= size;) {
    const auto head = read_head(file, at);
    at += sizeof(RecordHead);
    if (!head || head->n_bytes > size - at) return;
    visit(*head, at);
    at += head->n_bytes;
  }
}

/// The number in all of `text`; -1 for any other text. At most kMostRuns.
int number_in(std::string_view text) {
  int number = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() && number <= kMostRuns ? number : -1;
}

/// RUN-RANK; 0 for any other name.
int run_of(const std::string& name) {
  const std::size_t dash = name.find('-');
  if (dash == std::string::npos || number_in(std::string_view(name).substr(dash + 1)) < 0) return 0;
  return std::max(0, number_in(std::string_view(name).substr(0, dash)));
}

/// A file of ours for reading, -1 for anything else: a pipe would never end, and nobody else may say what this run has
/// done.
int open_to_read(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  struct stat info {};
  if (file < 0 || (fstat(file, &info) == 0 && S_ISREG(info.st_mode) && info.st_uid == geteuid())) return file;
  close(file);
  errno = 0;
  return -1;
}

/// Begins as a file of a journal does, as far as it goes.
bool is_of_journal(const std::string& path) {
  const int file = open_to_read(path);
  if (file < 0) return false;
  RecordHead head;
  const RecordHead wanted;
  const ssize_t n = pread(file, &head, sizeof head.magic, 0);
  close(file);
  return n >= 0 && std::memcmp(head.magic, wanted.magic, static_cast<std::size_t>(n)) == 0;
}

std::vector<std::string> files_of(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (run_of(it->path().filename().string()) > 0) names.push_back(it->path().filename().string());
  std::sort(names.begin(), names.end(),
            [](const auto& a, const auto& b) { return std::pair(run_of(a), a) < std::pair(run_of(b), b); });
  return names;
}

}  // namespace

JournalReader::JournalReader(const std::string& folder, const WorkKey& run_key) : run_key_(run_key) {
  for (const std::string& name : files_of(folder)) {
    next_run_ = std::max(next_run_, run_of(name) + 1);
    read(folder + "/" + name, run_key);
  }
  if (next_run_ > kMostRuns) next_run_ = 0;
  for (const auto& [key, n] : deaths_)  // also where it was finished since: by being left out
    if (n >= kMostDeaths && face_of_[key] != kNone) crashes_.try_emplace(face_of_[key], SIGKILL);
  for (auto it = deaths_.begin(); it != deaths_.end();) it = place_.contains(it->first) ? deaths_.erase(it) : ++it;
}

JournalReader::~JournalReader() {
  for (const int file : files_) close(file);
}

void JournalReader::read(const std::string& path, const WorkKey& run_key) {
  const int file = open_to_read(path);
  if (file < 0) {
    if (errno == EMFILE || errno == ENFILE)
      log_warning(path + " cannot be read (" + std::strerror(errno) + "); what it has kept is made again");
    return;
  }
  if (read_records(file, run_key))
    files_.push_back(file);
  else
    close(file);  // many ranks leave many files
}

bool JournalReader::read_records(int file, const WorkKey& run_key) {
  if (flock(file, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    is_in_use_ = true;
    return false;
  }
  const auto start = read_head(file, 0);
  if (!start || start->kind != kStart || start->key != run_key) return false;
  bool has_done = false;
  std::map<WorkKey, FaceId> begun;
  bool is_explained = false;
  for_each_record(file, [&](const RecordHead& head, std::uint64_t at) {
    if (head.face < kNone || head.face > std::numeric_limits<FaceId>::max()) return;
    const auto face = static_cast<FaceId>(head.face);
    if (head.kind == kBegun) begun[head.key] = face;
    if (head.kind == kDone) place_[head.key] = {file, head.face, at, head.n_bytes, head.digest}, has_done = true;
    if (head.kind == kDone || head.kind == kFailed) begun.erase(head.key);
    if (head.kind == kFailed) ++deaths_[head.key], face_of_[head.key] = face;
    if (head.kind == kCrashed) crashes_[face] = head.signal;
    if (head.kind == kCrashed || head.kind == kEnded) is_explained = true;
  });
  if (!is_explained)
    for (const auto& [key, face] : begun) ++deaths_[key], face_of_[key] = face;
  return has_done;
}

std::optional<Bytes> JournalReader::result(const WorkKey& key) const {
  const auto it = place_.find(key);
  if (it == place_.end()) return std::nullopt;
  Bytes bytes(it->second.size);
  if (!read_all(it->second.file, bytes.data(), bytes.size(), it->second.begin) ||
      digest_of(run_key_, key, it->second.face, bytes) != it->second.digest)
    return std::nullopt;
  return bytes;
}

std::size_t count_deaths(const std::string& output) {
  std::size_t n = 0;
  const std::string folder = journal_folder(output);
  for (const std::string& name : files_of(folder)) {
    const int file = open_to_read(folder + "/" + name);
    if (file < 0) continue;
    bool is_dead = true;
    for_each_record(file, [&](const RecordHead& head, std::uint64_t) { is_dead &= head.kind != kEnded; });
    n += is_dead;
    close(file);
  }
  return n;
}

std::vector<FaceId> faces_under_way(const std::string& output, int rank) {
  const std::string folder = journal_folder(output);
  const std::string end = fmt::format("-{}", rank);
  int file = -1;
  for (const std::string& name : files_of(folder)) {  // by run
    if (!name.ends_with(end)) continue;
    if (file >= 0) close(file);
    file = open_to_read(folder + "/" + name);
  }
  std::map<WorkKey, FaceId> begun;
  for_each_record(file, [&](const RecordHead& head, std::uint64_t) {
    if (head.kind == kBegun && head.face != kNone) begun[head.key] = static_cast<FaceId>(head.face);
    if (head.kind == kDone || head.kind == kFailed) begun.erase(head.key);
  });
  if (file >= 0) close(file);
  std::set<FaceId> faces;
  for (const auto& [key, face] : begun) faces.insert(face);
  return {faces.begin(), faces.end()};
}

void remove_journal(const std::string& output) {
  const std::string folder = journal_folder(output);
  for (const std::string& name : files_of(folder))
    if (is_of_journal(folder + "/" + name)) unlink((folder + "/" + name).c_str());
  rmdir(folder.c_str());
}

}  // namespace st
