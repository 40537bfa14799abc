// Wall and processor time of a parallel stage and of its parts.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/log.h"
#include "comm/communicator.h"

namespace st {

/// One clock per rank, started when it is made. Processor time says what a part costs on a quiet machine, whatever else
/// runs meanwhile.
class PhaseTimes {
 public:
  PhaseTimes();
  /// The part that ends here, since the last one ended. The same parts in the same order on every rank, up to gather().
  void end(const std::string& part);
  /// Wall time since the beginning, seconds.
  double total() const { return total_.seconds(); }
  /// Collective: tells rank 0 the processor times of the parts so far.
  void gather(const Communicator& comm);
  /// Wall times by part, seconds.
  nlohmann::json wall() const;
  /// Processor times by part, seconds: one number per rank, rank 0's alone for parts that ended after gather().
  nlohmann::json processor() const;

 private:
  struct Part {
    std::string name;
    double wall = 0;
    std::vector<double> processor;  // by rank
  };
  Timer total_, since_last_;
  double processor_at_last_;
  std::vector<Part> parts_;
};

/// Processor seconds of this process so far, of these in loops over threads, and in the longest piece of each: what a
/// run with one thread tells of one with more. See LoopSeconds; for bench/replay.py.
nlohmann::json processor_json();

}  // namespace st
