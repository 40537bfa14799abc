#include "stages/same_inputs.h"

#include <fmt/format.h>

#include <cstddef>

#include "base/error.h"
#include "base/host_name.h"
#include "base/packer.h"

namespace st {
void require_same_inputs(const Executor& executor, const std::vector<OpenedFile>& files) {
  if (executor.size() == 1) return;
  Packer own;
  own.add(host_name());
  for (const OpenedFile& file : files) own.add(file.content_hash);
  const std::vector<Bytes> all = executor.gather(own.take());
  for (std::size_t rank = 1; rank < all.size(); ++rank) {
    Unpacker other(all[rank]);
    std::string host, hash;
    other.get(host);
    for (const OpenedFile& file : files) {
      other.get(hash);
      if (hash != file.content_hash)
        throw Error(ExitCode::kMismatch,
                    fmt::format("{}: rank {} on {} has read other contents ({}) than rank 0 on {} ({}); give all "
                                "machines the same file, best on a file system that they share",
                                file.path, rank, host, hash, host_name(), file.content_hash));
    }
  }
}

}  // namespace st
