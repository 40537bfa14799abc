// The records that the files of a journal are made of. Internal to journal.cpp and journal_reader.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "base/hash.h"
#include "io/file/journal.h"

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

enum RecordKind : std::int32_t { kStart = 1, kBegun, kDone, kFailed, kCrashed, kEnded };

static_assert(sizeof(Journal::RecordHead) == 104 && std::is_trivially_copyable_v<Journal::RecordHead>,
              "no gaps: they would be summed");

/// Of what was finished: a result that stands at other work, or of another run, does not fit.
inline WorkKey digest_of(const WorkKey& run, const WorkKey& key, std::int64_t face, const Bytes& bytes) {
  Hasher hasher;
  hasher.add(run.data(), run.size());
  hasher.add(key.data(), key.size());
  hasher.add(&face, sizeof face);
  hasher.add(bytes.data(), bytes.size());
  return work_key(hasher.hex());
}

}  // namespace st
