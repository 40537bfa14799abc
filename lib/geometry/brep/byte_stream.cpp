#include "geometry/brep/byte_stream.h"

namespace st::occt {
namespace {

class ByteStream : public std::streambuf {
 public:
  explicit ByteStream(std::span<const std::byte> bytes) {
    char* begin = const_cast<char*>(reinterpret_cast<const char*>(bytes.data()));
    setg(begin, begin, begin + bytes.size());
  }

 protected:
  pos_type seekoff(off_type offset, std::ios_base::seekdir way, std::ios_base::openmode) override {
    char* target = way == std::ios_base::beg   ? eback() + offset
                   : way == std::ios_base::cur ? gptr() + offset
                                               : egptr() + offset;
    if (target < eback() || target > egptr()) return pos_type(off_type(-1));
    setg(eback(), target, egptr());
    return target - eback();
  }
  pos_type seekpos(pos_type position, std::ios_base::openmode mode) override {
    return seekoff(position, std::ios_base::beg, mode);
  }
};

}  // namespace

std::unique_ptr<std::streambuf> byte_stream(std::span<const std::byte> bytes) {
  return std::make_unique<ByteStream>(bytes);
}

}  // namespace st::occt
