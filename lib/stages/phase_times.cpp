#include "stages/phase_times.h"

#include "base/packer.h"
#include "base/processor_time.h"
#include "base/threads.h"

namespace st {
PhaseTimes::PhaseTimes() : processor_at_last_(process_seconds()) {}

void PhaseTimes::end(const std::string& part) {
  const double now = process_seconds();
  parts_.push_back({part, since_last_.seconds(), {now - processor_at_last_}});
  since_last_ = Timer();
  processor_at_last_ = now;
}

void PhaseTimes::gather(const Communicator& comm) {
  Packer packer;
  for (const Part& part : parts_) packer.add(part.processor.front());
  const std::vector<Bytes> all = comm.gather(packer.take());
  for (std::size_t rank = 1; rank < all.size(); ++rank) {
    Unpacker unpacker(all[rank]);
    for (Part& part : parts_) unpacker.get(part.processor.emplace_back());
  }
}

nlohmann::json PhaseTimes::wall() const {
  nlohmann::json result = nlohmann::json::object();
  for (const Part& part : parts_) result[part.name] = part.wall;
  return result;
}

nlohmann::json PhaseTimes::processor() const {
  nlohmann::json result = nlohmann::json::object();
  for (const Part& part : parts_) result[part.name] = part.processor;
  return result;
}

nlohmann::json processor_json() {
  const LoopSeconds loops = seconds_in_loops();
  return {{"all", process_seconds()}, {"in_loops", loops.all}, {"longest_pieces", loops.longest}};
}

}  // namespace st
