#include "io/text_file.h"

#include <fstream>

#include "base/error.h"
#include "io/temporary_file.h"

namespace st {

void write_text_file(const std::string& path, const std::string& text) {
  TemporaryFile temporary(path);
  std::ofstream file(temporary.name(), std::ios::binary);
  file << text;
  file.close();
  if (!file) throw Error(ExitCode::kOutput, path + ": cannot be written; free some space or choose another directory");
  temporary.commit();
}

}  // namespace st
