#include "geometry/brep/loaded_module.h"

#include <dlfcn.h>

#include <filesystem>
#include <system_error>

#include "base/error.h"
#include "base/own_program.h"

namespace st::occt {
namespace {

namespace fs = std::filesystem;

/// Beside the folder of the program, or beside the folder that this one is in: tests have folders of their own.
fs::path place_of(const std::string& module) {
  const fs::path file = fs::path("lib") / "st" / (module + ".so"), bin = fs::path(own_program()).parent_path();
  const fs::path usual = bin.parent_path() / file, further = bin.parent_path().parent_path() / file;
  std::error_code error;
  return !fs::exists(usual, error) && fs::exists(further, error) ? further : usual;
}

}  // namespace

void* function_of_module(const std::string& module, const char* name) {
  const std::string at = place_of(module).string();
  void* loaded = dlopen(at.c_str(), RTLD_NOW | RTLD_LOCAL);  // never unloaded: OpenCASCADE keeps types of it
  void* function = loaded ? dlsym(loaded, name) : nullptr;
  if (!function) {
    const char* why = dlerror();
    throw Error(ExitCode::kInternal, at + ": cannot be loaded (" + (why ? why : "?") + "); install ST again");
  }
  return function;
}

}  // namespace st::occt
