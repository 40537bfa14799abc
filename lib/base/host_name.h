// The machine's name.
#pragma once

#include <unistd.h>

#include <string>

namespace st {

inline std::string host_name() {
  char name[256] = "";
  gethostname(name, sizeof name - 1);
  return name;
}

}  // namespace st
