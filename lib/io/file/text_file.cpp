#include "io/file/text_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include "base/error.h"
#include "base/mapped_file.h"
#include "io/file/temporary_file.h"

namespace st {
namespace {

constexpr char kUnreadable[] = ": cannot be read; check name and permissions";

}  // namespace

void refuse_pipe(const std::string& path) {
  std::error_code none;
  const auto status = std::filesystem::status(path, none);
  if (std::filesystem::is_other(status))
    throw Error(ExitCode::kInput, path + ": is a pipe or a device, which might never end; name a file");
}

std::ifstream open_to_read(const std::string& path) {
  std::error_code none;
  if (std::filesystem::is_directory(path, none)) throw Error(ExitCode::kInput, path + ": is a directory; name a file");
  refuse_pipe(path);
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(ExitCode::kInput, path + kUnreadable);
  return file;
}

std::string without_byte_order_mark(std::string text) {
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  return text;
}

std::string read_text_file(const std::string& path) {
  std::ifstream file = open_to_read(path);
  std::error_code none;
  const std::uintmax_t size = std::filesystem::file_size(path, none);
  std::string text(none ? 0 : size, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  text.append(std::istreambuf_iterator<char>(file), {});  // what the size does not count
  if (file.bad()) throw Error(ExitCode::kInput, path + kUnreadable);
  return without_byte_order_mark(std::move(text));
}

MappedBytes::MappedBytes(const std::string& path) {
  open_to_read(path);
  std::error_code none;
  const std::uintmax_t size = std::filesystem::file_size(path, none);
  if (const int file = none || size == 0 ? -1 : open(path.c_str(), O_RDONLY | O_CLOEXEC); file >= 0) {
    mapping_ = map_file(file, 0, size, path);
    close(file);
  }
  if (mapping_)
    bytes_ = {static_cast<const char*>(mapping_.get()), static_cast<std::size_t>(size)};
  else
    bytes_ = copy_ = read_text_file(path);
}

void write_text_file(const std::string& path, const std::string& text) {
  TemporaryFile temporary(path);
  std::ofstream file(temporary.name(), std::ios::binary);
  file << text;
  file.close();
  if (!file) throw Error(ExitCode::kOutput, path + ": cannot be written; free some space or choose another directory");
  temporary.commit();
}

}  // namespace st
