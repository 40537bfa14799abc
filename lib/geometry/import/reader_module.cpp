#include "geometry/import/reader_module.h"

#include "geometry/brep/loaded_module.h"

namespace st::occt {

CadFile read_by_module(const std::string& module, const std::string& path) {
  CadFile file;
  reinterpret_cast<ReadFunction>(function_of_module(module, kReadFunction))(path, file);
  return file;
}

}  // namespace st::occt
