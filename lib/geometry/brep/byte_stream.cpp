#include "geometry/brep/byte_stream.h"

#include <BinTools.hxx>
#include <GeomTools.hxx>
#include <Standard_CString.hxx>
#include <Storage_StreamTypeMismatchError.hxx>
#include <bit>
#include <charconv>
#include <cstring>
#include <istream>
#include <system_error>

namespace st::occt {
namespace {

constexpr int kLongestWord = 255;  // characters that OpenCASCADE takes of a number

bool is_blank(int c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// The characters that a stream has at hand.
struct AtHand : std::streambuf {
  static char* begin(const std::streambuf& s) { return (s.*&AtHand::gptr)(); }
  static char* end(const std::streambuf& s) { return (s.*&AtHand::egptr)(); }
  static void take(std::streambuf& s, std::ptrdiff_t n) { (s.*&AtHand::gbump)(static_cast<int>(n)); }
};

/// Reads the next word where all of it and a blank behind it are at hand, and it is a number; else leaves all as it is.
bool read_at_hand(std::istream& in, double& number) {
  if (!in.good() || !(in.flags() & std::ios_base::skipws)) return false;
  std::streambuf& from = *in.rdbuf();
  char* const first = AtHand::begin(from);
  char *begin = first, *const last = AtHand::end(from);
  while (begin != last && is_blank(*begin)) ++begin;
  const auto [end, error] = std::from_chars(begin, last, number);
  if (error != std::errc() || end == last || !is_blank(*end) || end - begin > kLongestWord) return false;
  AtHand::take(from, end - first);
  return true;
}

/// Takes the bytes of a number where all of them are at hand.
bool take_at_hand(std::streambuf& from, double& number) {
  const char* const begin = AtHand::begin(from);
  if (AtHand::end(from) - begin < static_cast<std::ptrdiff_t>(sizeof number)) return false;
  std::memcpy(&number, begin, sizeof number);
  AtHand::take(from, sizeof number);
  return true;
}

/// The next word, which ends at a blank; its length. States of the stream as after `in >> word`.
int next_word(std::istream& in, char* word) {
  const std::istream::sentry is_readable(in);  // leaves out blanks
  if (!is_readable) return 0;
  std::streambuf& from = *in.rdbuf();
  int n = 0, c = from.sgetc();
  for (; n < kLongestWord && c != std::char_traits<char>::eof() && !is_blank(c); c = from.snextc())
    word[n++] = static_cast<char>(c);
  auto state = std::ios_base::goodbit;
  if (c == std::char_traits<char>::eof()) state |= std::ios_base::eofbit;
  if (n == 0) state |= std::ios_base::failbit;
  if (state != std::ios_base::goodbit) in.setstate(state);
  return n;
}

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

/// Both round to the nearest double, so that only the way there differs. Words that are more than a number, or beyond
/// the range of doubles, are left to OpenCASCADE.
void GeomTools::GetReal(Standard_IStream& in, Standard_Real& value) {
  if (st::occt::read_at_hand(in, value)) return;
  value = 0;
  if (in.eof()) return;
  char word[st::occt::kLongestWord + 1];
  const int n = st::occt::next_word(in, word);
  word[n] = '\0';
  double number = 0;
  const auto [end, error] = std::from_chars(word, word + n, number);
  value = error == std::errc() && end == word + n ? number : Strtod(word, nullptr);
}

Standard_IStream& BinTools::GetReal(Standard_IStream& in, Standard_Real& value) {
  static_assert(std::endian::native == std::endian::little);  // as the files are
  constexpr std::streamsize kBytes = sizeof value;
  if (in.good() && st::occt::take_at_hand(*in.rdbuf(), value)) return in;
  if (!in.good() || in.rdbuf()->sgetn(reinterpret_cast<char*>(&value), kBytes) != kBytes) {
    in.setstate(std::ios_base::eofbit | std::ios_base::failbit);
    throw Storage_StreamTypeMismatchError();
  }
  return in;
}
