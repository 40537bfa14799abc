// What mpirun says on stderr: its own banners apart from the words of the ranks.
#pragma once

#include <optional>
#include <string>

#include "base/error.h"

namespace st {

/// A rank that a signal ended.
struct LostRank {
  int rank = 0;      ///< -1: not said
  std::string host;  ///< empty: not said
  int signal = 0;
};

/// Reads the stderr of Open MPI's mpirun (4 and 5) line by line. Local, no MPI.
class MpirunReport {
 public:
  /// What of this line (with its end), and of lines before that were held back, is for the user: everything but
  /// mpirun's banners on how the job ended.
  std::string add(const std::string& line);
  /// What is still held back, at the end.
  std::string rest();
  /// The code that mpirun ended with. It may be all that tells of a rank that was killed as it began.
  void add_exit_code(int code);
  /// The first rank that a signal ended, if mpirun or its code told of one.
  const std::optional<LostRank>& lost_rank() const { return lost_; }

 private:
  void read_line(const std::string& line);

  std::string block_;  ///< a banner so far, from its first rule on
  bool is_in_block_ = false, is_own_block_ = false;
  int exited_rank_ = -1;
  std::optional<LostRank> lost_;
};

/// A rank was ended, or stood still. What it was at may be found in a journal.
class LostRankError : public Error {
 public:
  LostRankError(ExitCode code, int rank, const std::string& message) : Error(code, message), rank_(rank) {}
  int rank() const { return rank_; }

 private:
  int rank_;
};

/// "rank 1 on node17", this host.
std::string rank_on_this_host(int rank);

/// "rank 1 on node17 was ended by signal 9 (Killed); out of memory? ..."
std::string describe_lost_rank(const LostRank& lost);

/// A process of the job on this machine, rank or mpirun, that stood still for so long: "rank 1 on node17 (process 123)
/// stood still for 30 s, stopped by a signal; ...". Call it while the process is there.
LostRankError stopped_rank(int process, double seconds);

}  // namespace st
