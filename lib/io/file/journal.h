// What a run has finished so far, kept in a folder beside its output: a run that was ended goes on with it.
#pragma once

#include <array>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/ids.h"
#include "base/packer.h"

namespace st {

/// What names the work of a record: a digest, 32 hexadecimal digits.
using WorkKey = std::array<char, 32>;

/// "DIGEST..." as a key. Precondition: 32 characters.
WorkKey work_key(const std::string& digest);

/// What can be done by itself.
struct Work {
  WorkKey key{};
  FaceId face = kNone;  ///< that it is for
};

/// The folder of the journal of this output.
std::string journal_folder(const std::string& output);

/// The files of a journal, one per process of each run, as they were left.
class JournalReader {
 public:
  static constexpr int kMostDeaths = 2;  ///< of processes, at the same work: it is not to be tried again

  /// Reads those files that belong to `run_key`; a torn end is passed over. Nothing is found where the folder does not
  /// exist. Files that are no plain ones, or not of this user, are passed over. Where another process still writes one
  /// of them nothing is, either, and is_in_use() says so. Local.
  JournalReader(const std::string& folder, const WorkKey& run_key);
  ~JournalReader();
  JournalReader(const JournalReader&) = delete;
  JournalReader& operator=(const JournalReader&) = delete;

  bool is_in_use() const { return is_in_use_; }
  bool is_empty() const { return place_.empty() && deaths_.empty() && crashes_.empty(); }
  /// Higher than that of every run before, those that do not belong included; from 1. 0: there is no higher one.
  int next_run() const { return next_run_; }
  std::size_t n_done() const { return place_.size(); }
  /// What it was finished with; nothing where it is not done, or where the bytes are not those that were written.
  std::optional<Bytes> result(const WorkKey& key) const;
  /// Work that is not done and was under way when its process was ended, or ran out of memory: how often.
  const std::map<WorkKey, int>& deaths() const { return deaths_; }
  /// Faces that are not to be tried again, with the signal: those at which a process crashed, and those that were under
  /// way at too many deaths (signal 9).
  const std::map<FaceId, int>& crashes() const { return crashes_; }

 private:
  struct Place {
    int file;
    std::int64_t face;
    std::uint64_t begin, size;
    WorkKey digest;  // of all that
  };
  void read(const std::string& path, const WorkKey& run_key);
  /// Whether it has finished work: then `file` has to stay open.
  bool read_records(int file, const WorkKey& run_key);

  const WorkKey run_key_;
  std::vector<int> files_;  // descriptors of those with finished work
  std::map<WorkKey, Place> place_;
  std::map<WorkKey, int> deaths_;
  std::map<WorkKey, FaceId> face_of_;  // of deaths_
  std::map<FaceId, int> crashes_;
  int next_run_ = 1;
  bool is_in_use_ = false;
};

/// The file of this process in a journal. Made when the run has lasted for some time, so that short runs have none.
/// Nothing is synced to the disk: it has to outlive the process, not the machine. A file that cannot be written is
/// given up with one warning. All functions may be called by several threads. At most one object at a time in a
/// process.
class Journal {
 public:
  struct RecordHead;
  struct Place {
    std::string folder;
    WorkKey run_key;  ///< inputs, options and version
    int run = 1, rank = 0;
    double after = 0;  ///< seconds until it is made
  };
  explicit Journal(Place place);
  /// As end().
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  void begin(const Work& work);
  /// `result` is asked for only where it is written.
  void finish(const Work& work, const std::function<Bytes()>& result);
  /// It ran out of memory: counts as the end of a process.
  void fail(const Work& work);
  /// Nothing more is written; what is under way is not to blame.
  void end();

 private:
  void start();
  void write(const RecordHead& head, const Bytes& bytes);

  Place place_;
  std::mutex mutex_;
  std::condition_variable is_over_;
  std::vector<Work> under_way_;
  int file_ = -1;
  bool is_ended_ = false;
  std::thread starter_;  // last: it uses the members above
};

/// For a signal handler: the process is about to end by this signal at this face (0-based). Makes the file if there is
/// none yet. False where no Journal is open or the file cannot be written. Async-signal-safe.
bool note_crash(FaceId face, int signal) noexcept;
/// The process was asked to end: what is under way is not to blame.
void note_end() noexcept;

/// Processes that crashed, or were ended without having a say, by the journal of this output. Local.
std::size_t count_deaths(const std::string& output);

/// Faces (0-based, ascending) that were under way in the latest process of this rank, by the journal of this output.
/// The process may still live. Local.
std::vector<FaceId> faces_under_way(const std::string& output, int rank);

/// Removes the journal of this output, if there is one; what others have put there stays. Local.
void remove_journal(const std::string& output);

}  // namespace st
