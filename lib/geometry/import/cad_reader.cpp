#include "geometry/import/cad_reader.h"

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BinTools.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "geometry/flite/flite_file.h"
#include "geometry/flite/flite_reader.h"
#include "geometry/import/file_numbers.h"
#include "geometry/import/reader_module.h"

namespace st::occt {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& why) {
  throw Error(ExitCode::kInput, path + ": " + why);
}

constexpr const char* kNoModel =
    "not a STEP, IGES, BREP, STL, OBJ or PLY file; export the model as STEP, or its facets as STL";

/// "a PNG image, " for files that are often taken for another; empty for anything else.
std::string what_else(const std::string& head) {
  static const std::pair<const char*, const char*> kKinds[] = {{"\x89PNG", "a PNG image"},
                                                               {"\xff\xd8\xff", "a JPEG image"},
                                                               {"PK\x03\x04", "a zip archive"},
                                                               {"\x1f\x8b", "a gzip archive"},
                                                               {"%PDF", "a PDF document"},
                                                               {"<!DOCTYPE", "a web page"},
                                                               {"<html", "a web page"},
                                                               {"<?xml", "an XML file"},
                                                               {"solid", "an STL mesh"},
                                                               {"OFF\n", "an OFF mesh"},
                                                               {"OFF\r", "an OFF mesh"},
                                                               {"\xff\xfe", "a text in UTF-16"},
                                                               {"\xfe\xff", "a text in UTF-16"},
                                                               {"\x7f"
                                                                "ELF",
                                                                "a program"}};
  for (const auto& [start, kind] : kKinds)
    if (head.compare(0, std::strlen(start), start) == 0) return std::string(kind) + ", ";
  return {};
}

/// The last bytes of the file, blanks at its end left out.
std::string tail_of(const std::string& path, std::streamoff n) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = in.tellg();
  in.seekg(std::max<std::streamoff>(0, size - n));
  std::string text(static_cast<std::size_t>(std::min(size, n)), '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  const std::size_t end = text.find_last_not_of(std::string(" \t\r\n\0\x1a", 6));
  return end == std::string::npos ? std::string() : text.substr(0, end + 1);
}

/// OpenCASCADE takes what it finds of a file that is cut off: the end must be there.
void require_end(const std::string& path, const std::string& format) {
  const std::string tail = tail_of(path, 4096);
  bool is_whole = true;
  if (format == "STEP") is_whole = tail.find("END-ISO-10303-21") != std::string::npos;
  if (format == "IGES") {
    const std::size_t line = tail.find_last_of("\r\n"), start = line == std::string::npos ? 0 : line + 1;
    is_whole = tail.size() > start + 72 && tail[start + 72] == 'T';
    if (line == std::string::npos)
      is_whole = tail.size() >= 8 && tail[tail.size() - 8] == 'T';  // records without line ends
  }
  if (!is_whole) fail(path, "the " + format + " file is cut off: its last section is missing; export the model again");
}

/// A damaged file is for the reader that its suffix names to complain about, if it is text at all.
bool has_flite_suffix(const std::string& path, const std::string& head) {
  const std::string suffix = std::filesystem::path(path).extension();
  return suffix == ".fli" && head.find('\0') == std::string::npos;
}

bool is_iges(const std::string& head) {
  const std::size_t line_end = head.find_first_of("\r\n");
  if (line_end != std::string::npos && line_end >= 73 && (head[72] == 'S' || head[72] == 'F' || head[72] == 'C'))
    return true;
  return head.size() >= 80 && head[72] == 'S' && std::strchr(" 0123456789", head[79]);
}

std::string format_of(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code code;
  if (!fs::exists(path, code)) fail(path, "no such file; check the path");
  if (fs::is_directory(path, code)) fail(path, "is a directory; give a file: STEP, IGES, BREP, STL, OBJ or PLY");
  std::ifstream in(path, std::ios::binary);
  if (!in) fail(path, "cannot be opened; check its permissions");
  std::string head(4096, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  if (head.empty()) fail(path, "empty file; export the model again");
  if (const std::string kind = what_else(head); !kind.empty() && kind != "an STL mesh, ") fail(path, kind + kNoModel);
  if (head.find("ISO-10303-21") != std::string::npos) return "STEP";
  if (head.find("DBRep_DrawableShape") != std::string::npos || head.find("CASCADE Topology V") != std::string::npos)
    return "BREP";
  if (head.compare(0, 8, "\x89HDF\r\n\x1a\n") == 0)
    fail(path, "is an HDF5 artifact; give a CAD file: STEP, IGES, BREP, STL, OBJ or PLY");
  if (is_iges(head)) return "IGES";
  if (is_iges(head.substr(std::min(head.size(), head.find_first_not_of("\xef\xbb\xbf\r\n")))))
    fail(path, "an IGES file with a byte order mark or an empty line before its first one; remove it");
  if (is_flite(head) || has_flite_suffix(path, head)) return "FLITE";
  fail(path, what_else(head) + kNoModel);
}

CadFile read_step(const std::string& path) {
  CadFile plain = read_by_module("plain_step", path);
  return plain.format.empty() ? read_by_module("step_document", path) : plain;
}

CadFile read_brep(const std::string& path) {
  CadFile file;
  file.format = "BREP";
  CadPart part;
  std::ifstream in(path, std::ios::binary);
  std::string head(64, '\0');
  in.read(head.data(), 64);
  in.clear();
  in.seekg(0);
  in.exceptions(std::ios::failbit | std::ios::badbit);  // OpenCASCADE looks for its keywords for ever where the file is
                                                        // cut off
  const bool is_binary =
      head.find("Open CASCADE Topology V") != std::string::npos && head.find("DBRep") == std::string::npos;
  try {
    if (is_binary) {
      BinTools::Read(part.shape, in);
    } else {
      BRep_Builder builder;
      BRepTools::Read(part.shape, in, builder);
    }
  } catch (const std::ios_base::failure&) {
    fail(path, "the BREP file is cut off or damaged; export the model again");
  }
  if (part.shape.IsNull()) fail(path, "the BREP file cannot be parsed; export the model again");
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(part.shape, TopAbs_FACE, faces);
  for (int i = 1; i <= faces.Extent(); ++i) part.faces.push_back({faces(i), {}, {}, -1});
  file.parts.push_back(std::move(part));
  return file;
}

}  // namespace

CadFile read_cad(const std::string& path) {
  const std::string format = format_of(path);
  require_end(path, format);
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_PrinterOStream));
  try {
    if (format == "FLITE") return read_flite_shape(path);
    require_sound_numbers(path, format);
    return format == "STEP"   ? read_step(path)
           : format == "IGES" ? read_by_module("iges_document", path)
                              : read_brep(path);
  } catch (const Standard_Failure& e) {
    const char* text = e.GetMessageString();
    fail(path, "reading the " + format + " file failed (" + (text && *text ? text : e.DynamicType()->Name()) +
                   "); export the model again");
  }
}

}  // namespace st::occt
