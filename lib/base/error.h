// The one error type for what a user can cause or fix, and the exit codes it maps to.
#pragma once

#include <stdexcept>
#include <string>

namespace st {

/// Exit codes of every tool (docs/exit_codes.md).
enum class ExitCode : int {
  kOk = 0,
  kUsage = 2,       ///< bad option or argument
  kInput = 3,       ///< input unreadable or invalid
  kGeometry = 4,    ///< geometry unusable
  kIncomplete = 5,  ///< faces not meshed, or a check failed
  kOutput = 6,      ///< output cannot be written
  kMismatch = 7,    ///< inputs do not belong together
  kMemory = 8,      ///< there is not enough memory
  kInternal = 70    ///< a defect of ours
};

/// Thrown for anything a user can cause or fix. The message says where, what and what to do, on one line:
/// "wing.step: empty file; export the model again".
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// Instead of a std::bad_alloc. `where`: "rank 1: face 12: ", or nothing.
inline Error out_of_memory(const std::string& where) {
  return {ExitCode::kMemory,
          where + "out of memory; use larger lengths, fewer ranks or threads, or a machine with more memory"};
}

}  // namespace st
