// Files that appear under their name only when they are complete.
#pragma once

#include <string>

namespace st {

/// What a file holds: an artifact tells by itself that ST wrote it, of other files note_written() keeps a record.
enum class Content { kArtifact, kOther };

/// An empty file `.name.tmp.<pid>.<random>` beside `path`, new and no link, for whoever opens it for writing. commit()
/// gives it its name; without commit() the destructor removes it, and so does remove_temporaries() in a signal handler.
/// What a killed process (SIGKILL) left is removed by the next that writes `path`.
class TemporaryFile {
 public:
  /// Reserves a name. Throws Error(kOutput) when `path` is no place for a file (see require_writable).
  explicit TemporaryFile(const std::string& path);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  /// Where to write.
  const std::string& name() const { return name_; }
  /// Where it will appear.
  const std::string& path() const { return path_; }
  /// The file is closed and complete: syncs it, renames it to path(), syncs the directory. Throws Error(kOutput), and
  /// as require_replaceable().
  void commit(Content content = Content::kOther);

 private:
  std::string path_, name_;
  int slot_ = -1;
};

/// Throws Error(kOutput) now, before hours of work, when `path` cannot be written (directory missing, no permission, is
/// a directory, a device, a pipe, has the name of a CAD file), and as require_replaceable() (output_files.h).
void require_writable(const std::string& path);

/// Removes the temporary files of this process; called by the signal handlers of the tools (async-signal-safe).
void remove_temporaries() noexcept;

/// Removes what processes of this machine that have ended left while writing `path`.
void remove_left_temporaries(const std::string& path);

}  // namespace st
