// The lists of tables that an option file may hold beside the options themselves.
#pragma once

#include <map>
#include <string>

namespace st {

/// From the key of the tables to the option that takes a file of them: [[size]] is what --sizes reads.
inline const std::map<std::string, std::string>& option_file_lists() {
  static const std::map<std::string, std::string> lists = {
      {"group", "--groups"}, {"pair", "--pairs"}, {"size", "--sizes"}, {"source", "--sources"}};
  return lists;
}

}  // namespace st
