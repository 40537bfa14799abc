#include "base/own_program.h"

#include <sys/auxv.h>

#include <filesystem>
#include <system_error>

namespace st {

namespace fs = std::filesystem;

std::string own_program() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) return program;
  const auto* started = reinterpret_cast<const char*>(getauxval(AT_EXECFN));
  return started ? fs::canonical(started, error).string() : "";
}

}  // namespace st
