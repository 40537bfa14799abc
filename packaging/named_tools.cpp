// The tools without ranks in one program, as a wheel has them: it does what the name says under which it is started. What
// they share is there once.
#include <cstdio>
#include <filesystem>
#include <string>

// The main of each tool, by the list that CMake writes.
#define ST_TOOL(name, function) int function(int argc, char** argv);
#include "named_tools.inc"
#undef ST_TOOL

int main(int argc, char** argv) {
  const std::string started_as = argc > 0 ? std::filesystem::path(argv[0]).filename().string() : "";
#define ST_TOOL(name, function) \
  if (started_as == name) return function(argc, argv);
#include "named_tools.inc"
#undef ST_TOOL
  std::fprintf(stderr, "st: error: there is no tool '%s'\n", started_as.c_str());
  return 2;
}
