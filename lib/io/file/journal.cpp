#include "io/file/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <limits>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/assert.h"
#include "base/hash.h"
#include "base/log.h"

namespace st {

/// What stands before the bytes of a record.
struct Journal::RecordHead {
  char magic[8] = {'S', 'T', '-', 'j', 'r', 'n', 'l', '2'};
  std::int32_t kind = 0, signal = 0;
  std::int64_t face = kNone;
  std::uint64_t n_bytes = 0;
  WorkKey key{};     // kStart: of the run
  WorkKey digest{};  // see digest_of()
  std::uint64_t check = 0;

  /// FNV-1a of all before it: a signal handler can make it.
  std::uint64_t sum() const {
    std::uint64_t sum = 0xcbf29ce484222325u;
    const auto* bytes = reinterpret_cast<const unsigned char*>(this);
    for (std::size_t i = 0; i < offsetof(RecordHead, check); ++i) sum = (sum ^ bytes[i]) * 0x100000001b3u;
    return sum;
  }
};

namespace {

using RecordHead = Journal::RecordHead;
namespace fs = std::filesystem;

enum RecordKind : std::int32_t { kStart = 1, kBegun, kDone, kFailed, kCrashed, kEnded };

static_assert(sizeof(RecordHead) == 104 && std::is_trivially_copyable_v<RecordHead>, "no gaps: they would be summed");

/// Of what was finished: a result that stands at other work, or of another run, does not fit.
WorkKey digest_of(const WorkKey& run, const WorkKey& key, std::int64_t face, const Bytes& bytes) {
  Hasher hasher;
  hasher.add(run.data(), run.size());
  hasher.add(key.data(), key.size());
  hasher.add(&face, sizeof face);
  hasher.add(bytes.data(), bytes.size());
  return work_key(hasher.hex());
}

RecordHead head_of(std::int32_t kind, const Work& work, const WorkKey& run = {}, const Bytes& bytes = {}) {
  RecordHead head;
  head.kind = kind;
  head.face = work.face;
  head.key = work.key;
  head.n_bytes = bytes.size();
  if (kind == kDone) head.digest = digest_of(run, work.key, work.face, bytes);
  head.check = head.sum();
  return head;
}

// What signal handlers need of the open journal. They may touch neither the heap nor a lock.
constexpr std::size_t kNameLength = 4096;
constexpr int kMostRuns = 999'999;  // of one journal, and ranks of a run: what has a higher number is not ours
std::atomic<bool> g_is_open = false;
std::atomic<int> g_file = -1;
char g_folder[kNameLength], g_name[kNameLength];
RecordHead g_start;

/// What cannot be written leaves nothing. Async-signal-safe.
void remove_file() noexcept {
  unlink(g_name);
  rmdir(g_folder);  // where no other process has a file
}

/// A new file with its first record, held as long as the process lives; -1 with errno. Async-signal-safe.
int make_file() noexcept {
  mkdir(g_folder, 0777);
  const int file = open(g_name, O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_NOFOLLOW | O_CLOEXEC, 0600);
  if (file < 0) {
    rmdir(g_folder);  // where it is empty
    return -1;
  }
  flock(file, LOCK_EX | LOCK_NB);
  if (write(file, &g_start, sizeof g_start) == static_cast<ssize_t>(sizeof g_start)) return file;
  close(file);
  remove_file();
  return -1;
}

bool note(RecordHead head) noexcept {
  if (!g_is_open) return false;
  if (g_file < 0) g_file = make_file();
  head.check = head.sum();
  return g_file >= 0 && write(g_file, &head, sizeof head) == static_cast<ssize_t>(sizeof head);
}

bool write_all(int file, iovec* part, int n) {
  while (n > 0) {
    const ssize_t written = writev(file, part, n);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    auto rest = static_cast<std::size_t>(written);
    for (; n > 0 && rest >= part->iov_len; ++part, --n) rest -= part->iov_len;
    if (n > 0) *part = {static_cast<char*>(part->iov_base) + rest, part->iov_len - rest};
  }
  return true;
}

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

WorkKey work_key(const std::string& digest) {
  WorkKey key;
  ST_ASSERT(digest.size() == key.size());
  std::copy(digest.begin(), digest.end(), key.begin());
  return key;
}

std::string journal_folder(const std::string& output) { return output + ".journal"; }

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

Journal::Journal(Place place) : place_(std::move(place)) {
  const std::string name = place_.folder + "/" + std::to_string(place_.run) + "-" + std::to_string(place_.rank);
  if (name.size() >= kNameLength) {
    is_ended_ = true;
    return;
  }
  std::strcpy(g_folder, place_.folder.c_str());
  std::strcpy(g_name, name.c_str());
  g_start = head_of(kStart, {place_.run_key, kNone});
  g_file = -1;
  g_is_open = true;
  if (place_.after <= 0) {
    start();
    return;
  }
  starter_ = std::thread([this] {
    std::unique_lock lock(mutex_);
    if (is_over_.wait_for(lock, std::chrono::duration<double>(place_.after), [this] { return is_ended_; })) return;
    start();
  });
}

Journal::~Journal() { end(); }

/// Under the lock, or before there are threads.
void Journal::start() {
  file_ = make_file();
  if (file_ >= 0) g_file = file_;
  for (const Work& work : std::vector(under_way_)) write(head_of(kBegun, work), {});
}

/// Under the lock.
void Journal::write(const RecordHead& head, const Bytes& bytes) {
  if (file_ < 0) return;
  iovec parts[] = {{const_cast<RecordHead*>(&head), sizeof head}, {const_cast<std::byte*>(bytes.data()), bytes.size()}};
  if (write_all(file_, parts, bytes.empty() ? 1 : 2)) return;
  log_warning(place_.folder + " cannot be written (" + std::strerror(errno) +
              "); an end of this run would lose what it has made");
  g_is_open = false;
  g_file = -1;
  remove_file();
  close(std::exchange(file_, -1));
}

void Journal::begin(const Work& work) {
  const std::lock_guard lock(mutex_);
  under_way_.push_back(work);
  write(head_of(kBegun, work), {});
}

void Journal::finish(const Work& work, const std::function<Bytes()>& result) {
  bool is_written = false;
  {
    const std::lock_guard lock(mutex_);
    is_written = file_ >= 0;
    if (!is_written) std::erase_if(under_way_, [&](const Work& other) { return other.key == work.key; });
  }
  if (!is_written) return;
  const Bytes bytes = result();
  const RecordHead head = head_of(kDone, work, place_.run_key, bytes);
  const std::lock_guard lock(mutex_);
  std::erase_if(under_way_, [&](const Work& other) { return other.key == work.key; });
  write(head, bytes);
}

void Journal::fail(const Work& work) {
  const std::lock_guard lock(mutex_);
  std::erase_if(under_way_, [&](const Work& other) { return other.key == work.key; });
  if (file_ < 0 && !is_ended_) start();
  write(head_of(kFailed, work), {});
}

void Journal::end() {
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(is_ended_, true)) return;
    g_is_open = false;
    write(head_of(kEnded, {}), {});
    const int noted = g_file.exchange(-1);  // file_, or what note_crash() has made
    if (noted >= 0) close(noted);
    file_ = -1;
  }
  is_over_.notify_all();
  if (starter_.joinable()) starter_.join();
}

bool note_crash(FaceId face, int signal) noexcept {
  RecordHead head;
  head.kind = kCrashed;
  head.face = face;
  head.signal = signal;
  return note(head);
}

void note_end() noexcept {
  RecordHead head;
  head.kind = kEnded;
  if (g_file >= 0) note(head);
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
