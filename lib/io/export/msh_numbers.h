// Numbers of a .msh file.
#pragma once

#include <cstdint>
#include <string>

#include "io/export/export_formats.h"

namespace st {

/// Numbers as text or as bytes.
class Numbers {
 public:
  Numbers(Output& out, bool is_binary) : out_(out), text_(out), is_binary_(is_binary) {}
  Numbers& integer(std::int64_t v) { return is_binary_ ? raw(static_cast<std::int32_t>(v)) : word(v); }
  Numbers& size(std::int64_t v) { return is_binary_ ? raw(static_cast<std::uint64_t>(v)) : word(v); }
  Numbers& real(double v) { return is_binary_ ? raw(v) : word(v); }
  Numbers& point(const Vec3& p) { return real(p.x).real(p.y).real(p.z); }
  /// The end of a line, in text only.
  Numbers& end() {
    if (!is_binary_) text_ << "\n";
    has_word_ = false;
    return *this;
  }
  /// A line that is text in either.
  void line(const std::string& text) {
    if (is_binary_)
      out_.text(text + "\n");
    else
      text_ << text << "\n";
  }
  /// "$EndNodes", on a line of its own.
  void end_section(const std::string& name) { line((is_binary_ ? "\n$End" : "$End") + name); }
  void flush() { text_.flush(); }
  bool is_binary() const { return is_binary_; }

 private:
  template <class T>
  Numbers& raw(T v) {
    out_.value(v);
    return *this;
  }
  template <class T>
  Numbers& word(T v) {
    if (has_word_) text_ << " ";
    text_ << v;
    has_word_ = true;
    return *this;
  }
  Output& out_;
  TextBuffer text_;
  bool is_binary_, has_word_ = false;
};

inline std::int64_t n_of(const auto& items) { return static_cast<std::int64_t>(items.size()); }

}  // namespace st
