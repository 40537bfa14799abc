// fuzz_readers --reader=NAME [libFuzzer's options] [CORPUS_DIR]: what own code reads, in one process, led by coverage.
//
// Text readers (stl obj ply msh vtu vtkhdf fro bac toml groups sizes flite) get the bytes as a file. Readers of
// artifacts (geometry raster sizing patches mesh) get a good artifact, ST_FUZZ_SEEDS/NAME.hdf, with edits that the
// bytes tell: 12 bytes each, see Edit. Checksums fit then, so that readers have to check what they use themselves.
#include <unistd.h>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/error.h"
#include "geometry/flite/flite_file.h"
#include "io/foreign/node_array.h"
#include "io/foreign/triangulation_reader.h"
#include "io/hdf5/artifact.h"
#include "io/hdf5/hdf5_file.h"
#include "io/hdf5/sizing_artifact.h"
#include "io/toml/groups_file.h"
#include "io/toml/size_rule_file.h"
#include "io/toml/source_file.h"

namespace {

namespace fs = std::filesystem;
using Read = std::function<void(const std::string& path)>;

struct Reader {
  std::string suffix;
  Read read;
  bool is_artifact = false;
};

/// A size at some places, as the mesher asks.
void ask_sizes(const std::string& path) {
  const auto field = st::open_sizing(path, nullptr);
  int hint = 0;
  for (int i = -2; i < 8; ++i) field->local({0.3 * i, 0.2 * i, 0.1 * i}, hint);
}

const std::map<std::string, Reader> kReaders{
    {"stl", {".stl", [](const std::string& p) { st::read_triangulation(p); }}},
    {"obj", {".obj", [](const std::string& p) { st::read_triangulation(p); }}},
    {"ply", {".ply", [](const std::string& p) { st::read_triangulation(p); }}},
    {"msh", {".msh", [](const std::string& p) { st::read_triangulation(p); }}},
    {"vtu",
     {".vtu",
      [](const std::string& p) {
        const st::SurfaceMesh mesh = st::read_triangulation(p);
        st::read_node_lengths(p, "size", mesh.node_xyz.size());
      }}},
    {"vtkhdf", {".hdf", [](const std::string& p) { st::read_triangulation(p); }}},
    {"fro", {".fro", [](const std::string& p) { st::read_triangulation(p); }}},
    {"bac", {".bac", [](const std::string& p) { st::read_background_file(p); }}},
    {"toml",
     {".toml",
      [](const std::string& p) {
        st::read_source_file(p, {10, 0.001});
      }}},
    {"groups", {".toml", [](const std::string& p) { st::read_groups(p); }}},
    {"sizes", {".toml", [](const std::string& p) { st::read_size_rules(p); }}},
    {"flite", {".dat", [](const std::string& p) { st::read_flite(p); }}},
    {"geometry", {".hdf", [](const std::string& p) { st::read_geometry(p); }, true}},
    {"raster", {".hdf", [](const std::string& p) { st::read_raster(p); }, true}},
    {"sizing", {".hdf", ask_sizes, true}},
    {"patches", {".hdf", [](const std::string& p) { st::read_patches(p); }, true}},
    {"mesh", {".hdf", [](const std::string& p) { st::read_mesh(p); }, true}},
};

/// What one edit does.
struct Edit {
  std::uint8_t what;   ///< of datasets, then attributes, modulo their number
  std::uint8_t how;    ///< see spoil()
  std::uint16_t at;    ///< which value, modulo their number
  std::int64_t value;  ///< its bytes, or those of a floating-point number
};

std::vector<Edit> edits_of(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kBytes = 12;
  std::vector<Edit> edits;
  for (std::size_t i = 0; i + kBytes <= size && edits.size() < 4; i += kBytes) {
    Edit e{data[i], data[i + 1], 0, 0};
    std::memcpy(&e.at, data + i + 2, sizeof e.at);
    std::memcpy(&e.value, data + i + 4, sizeof e.value);
    edits.push_back(e);
  }
  return edits;
}

template <class T>
T value_of(const Edit& e) {
  if constexpr (std::is_floating_point_v<T>) {
    double x;
    std::memcpy(&x, &e.value, sizeof x);
    return static_cast<T>(x);
  } else {
    return static_cast<T>(e.value);
  }
}

template <class T>
void spoil(const Edit& e, std::size_t columns, std::vector<T>& values) {
  if (values.empty()) return values.assign(columns, value_of<T>(e));
  const std::size_t at = e.at % values.size(), row = at / columns;
  switch (e.how % 6) {
    case 0:
      return std::fill(values.begin(), values.end(), value_of<T>(e));
    case 1:
      return values.resize(row * columns);
    case 2:
      return values.insert(values.end(), columns, value_of<T>(e)), void();
    case 3:
      return std::swap(values[at], values[static_cast<std::uint64_t>(e.value) % values.size()]);
    default:
      values[at] = value_of<T>(e);
  }
}

/// A good artifact, read once.
class Seed {
 public:
  explicit Seed(const std::string& path) : in_(path), attributes_(in_.content_attributes()) {}

  void write(const std::string& path, const std::vector<Edit>& edits) const {
    st::Hdf5Writer out(path, in_.header());
    const std::size_t n = in_.datasets().size(), n_all = n + attributes_.size();
    for (std::size_t i = 0; i < n_all; ++i) {
      std::vector<Edit> own;
      for (const Edit& e : edits)
        if (e.what % n_all == i) own.push_back(e);
      i < n ? copy(in_.datasets()[i], own, out) : copy(attributes_[i - n], own, out);
    }
    out.commit();
  }

 private:
  void copy(const st::DatasetInfo& d, const std::vector<Edit>& edits, st::Hdf5Writer& out) const {
    if (d.is_foreign) return out.write_vtk_strings(d.name, std::vector<std::string>(d.shape[0], "name"));
    st::with_element(d.type, [&](const auto& element) {
      using T = std::decay_t<decltype(element)>;
      if constexpr (std::is_same_v<T, std::string>) {
        std::vector<std::string> values = in_.read_strings(d.name);
        for (const Edit& e : edits) {
          if (values.empty()) values.emplace_back();
          values[e.at % values.size()].assign(reinterpret_cast<const char*>(&e.value), 1 + e.how % sizeof e.value);
          if (e.how > 200) values.pop_back();
        }
        out.write_strings(d.name, values);
      } else {
        const std::size_t columns = d.shape.size() > 1 ? d.shape[1] : 1;
        std::vector<T> values = in_.read<T>(d.name, columns);
        for (const Edit& e : edits) spoil(e, columns, values);
        out.write<T>(d.name, values, columns);
      }
    });
  }

  static void copy(const st::AttributeSummary& a, const std::vector<Edit>& edits, st::Hdf5Writer& out) {
    const std::size_t at = a.name.find('@');
    const std::string group = a.name.substr(0, at), name = a.name.substr(at + 1);
    if (name == "schema" || name == "schema_version" || name.rfind("unit", 0) == 0) return;  // of the header
    const Edit* edit = edits.empty() ? nullptr : &edits.back();
    if (const auto* text = std::get_if<std::string>(&a.value))
      out.set_attribute(group, name, edit ? std::string(reinterpret_cast<const char*>(&edit->value), 4) : *text);
    if (const auto* number = std::get_if<double>(&a.value))
      out.set_attribute(group, name, edit ? value_of<double>(*edit) : *number);
    if (const auto* integer = std::get_if<std::int64_t>(&a.value))
      out.set_attribute(group, name, edit ? edit->value : *integer);
  }

  st::Hdf5Reader in_;
  std::vector<st::AttributeSummary> attributes_;
};

const Reader* g_reader = nullptr;
const Seed* g_seed = nullptr;
std::string g_path;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  std::string name;
  for (int i = 1; i < *argc; ++i)
    if (std::strncmp((*argv)[i], "--reader=", 9) == 0) name = (*argv)[i] + 9;
  const auto it = kReaders.find(name);
  if (it == kReaders.end()) {
    std::fprintf(stderr, "fuzz_readers: --reader=NAME of:");
    for (const auto& [known, reader] : kReaders) std::fprintf(stderr, " %s", known.c_str());
    std::fprintf(stderr, "\n");
    std::exit(2);
  }
  g_reader = &it->second;
  const char* seeds = std::getenv("ST_FUZZ_SEEDS");
  if (g_reader->is_artifact) g_seed = new Seed(std::string(seeds ? seeds : ".") + "/" + name + ".hdf");
  const fs::path folder = fs::exists("/dev/shm") ? "/dev/shm" : fs::temp_directory_path();
  g_path = folder / ("st_fuzz_" + std::to_string(getpid()) + g_reader->suffix);
  std::atexit([] { std::remove(g_path.c_str()); });
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    if (g_seed)
      g_seed->write(g_path, edits_of(data, size));
    else
      std::ofstream(g_path, std::ios::binary)
          .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    g_reader->read(g_path);
  } catch (const st::Error&) {
  }
  return 0;
}
