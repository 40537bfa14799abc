// What rank 0 decides, on every rank.
#pragma once

#include "base/executor.h"
#include "base/packer.h"

namespace st {

/// Collective. Rank 0's values on every rank. A decision that all ranks act on is made on rank 0 and shared: processors
/// of different makes round sines and powers differently, and two ranks that decide for themselves could disagree.
template <class... Values>
void share(const Executor& executor, Values&... values) {
  if (!executor.has_listeners()) return;
  Bytes bytes;
  if (executor.is_root()) bytes = packed(values...);
  executor.broadcast(bytes);
  if (!executor.is_root()) unpack(bytes, values...);
}

}  // namespace st
