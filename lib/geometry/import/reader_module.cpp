#include "geometry/import/reader_module.h"

#include <dlfcn.h>

#include <filesystem>

#include "base/error.h"

namespace st::occt {

CadFile read_by_module(const std::string& module, const std::string& path) {
  namespace fs = std::filesystem;
  const fs::path bin = fs::read_symlink("/proc/self/exe").parent_path();
  const std::string at = (bin.parent_path() / "lib" / "st" / (module + ".so")).string();
  void* loaded = dlopen(at.c_str(), RTLD_NOW | RTLD_LOCAL);  // never unloaded: OpenCASCADE keeps types of it
  void* function = loaded ? dlsym(loaded, kReadFunction) : nullptr;
  if (!function) {
    const char* why = dlerror();
    throw Error(ExitCode::kInternal, at + ": cannot be loaded (" + (why ? why : "?") + "); install ST again");
  }
  CadFile file;
  reinterpret_cast<ReadFunction>(function)(path, file);
  return file;
}

}  // namespace st::occt
