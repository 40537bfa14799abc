#include "io/file/journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <utility>

#include "base/assert.h"
#include "base/log.h"
#include "io/file/journal_record.h"

namespace st {
namespace {

using RecordHead = Journal::RecordHead;

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

}  // namespace

WorkKey work_key(const std::string& digest) {
  WorkKey key;
  ST_ASSERT(digest.size() == key.size());
  std::copy(digest.begin(), digest.end(), key.begin());
  return key;
}

std::string journal_folder(const std::string& output) { return output + ".journal"; }

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

}  // namespace st
