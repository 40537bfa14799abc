// Which files a run may write: none that it reads, none twice, and of those that are there only what the user named or
// ST wrote. Every TemporaryFile asks here before it appears; stages ask before they begin.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace st {

/// The files that a command line names.
struct OutputRules {
  std::vector<std::string> inputs;
  std::vector<std::string> named;     ///< outputs that the user named: what is there may be replaced
  std::vector<std::string> defaults;  ///< outputs under a name of ours
  /// Whether an HDF5 file says that ST wrote it. No rules hold without this.
  std::function<bool(const std::string& path)> is_artifact;
};

/// From now on these rules hold in this process; without any, all may be written. Throws Error(kUsage) when an output
/// is an input, also by a link, or another output. Before there are threads.
void set_output_rules(OutputRules rules);

/// Names that a stage makes of those of its command line: throws Error(kUsage) when one is an input or an output of the
/// command line, and as require_replaceable(). Local.
void require_derived_outputs(const std::vector<std::string>& paths);

/// Throws Error(kUsage) for an input. Throws Error(kOutput) for a file that is there, is not empty, has no name that
/// the user gave, and that ST did not write, or that was changed since: only artifacts and files of the record of their
/// folder (note_written()) are replaced. Linear in the size of such a file. Local.
void require_replaceable(const std::string& path);

/// The file at `path` is complete. One whose name the user did not give, and that is no artifact, is noted with its
/// checksum in the record of its folder. A record that cannot be written is left alone. Local.
void note_written(const std::string& path);

/// Name of the record of a folder: lines as cksum (POSIX) prints them, of checksum, size and name.
inline constexpr const char* kRecordName = ".st-written";

}  // namespace st
