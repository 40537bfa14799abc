// Meshes for other programs: which suffix is which format, and what it has room for.
#include "io/export/export.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <set>

#include "base/hash.h"
#include "base/nearest_name.h"
#include "io/export/export_formats.h"
#include "io/hdf5/face_numbers.h"

namespace st {
namespace {

/// What a format has room for, as bits.
enum Room : unsigned {
  kNumbers = 1,         ///< a number of each triangle's group
  kNames = 2,           ///< names of groups
  kDivisions = 4,       ///< parts and further tables
  kEntityGroups = 8,    ///< groups of edges and vertices
  kQuads = 16,          ///< quadrilaterals
  kMidNodes = 32,       ///< elements of second order
  kParameters = 64,     ///< t on edges, (u,v) on faces
  kMapbc = 128,         ///< a list of boundaries is written next to the mesh: NAME.mapbc for NAME.ugrid
  kMsh = 512,           ///< the mesh itself is written next to it: NAME.msh for NAME.geo
  kFeaturesOnly = 256,  ///< no mesh at all: its feature lines
  kNodeValues = 1024,   ///< values that st-remesh carried
  kNodesOnly = 2048,    ///< no mesh at all: its nodes
  kNamed = kNumbers | kNames,
};

/// How a format is written.
struct Format {
  const char* suffix;
  void (*write)(Output&, const ExportTask&);
  unsigned room;
  Encoding encoding;
  const char* other = nullptr;  ///< suffix of the same format in the other encoding
};

constexpr Encoding kText = Encoding::kText, kBinary = Encoding::kBinary;

/// A suffix with two dots stands before the one that it ends with.
constexpr Format kFormats[] = {
    {".ascii.stl", export_ascii_stl, kNamed, kText, ".stl"},
    {".stl", export_stl, 0, kBinary, ".ascii.stl"},
    {".vtu", export_vtu, kNamed | kDivisions | kEntityGroups | kQuads | kMidNodes | kNodeValues, kBinary},
    {".obj", export_obj, kNamed | kEntityGroups, kText},
    {".binary.ply", export_binary_ply, kNamed | kDivisions | kEntityGroups, kBinary, ".ply"},
    {".ply", export_ply, kNamed | kDivisions | kEntityGroups, kText, ".binary.ply"},
    {".binary.msh", export_binary_msh,
     kNamed | kDivisions | kEntityGroups | kQuads | kMidNodes | kParameters | kNodeValues, kBinary, ".msh"},
    {".msh", export_msh, kNamed | kDivisions | kEntityGroups | kQuads | kMidNodes | kParameters | kNodeValues, kText,
     ".binary.msh"},
    {".binary.msh2", export_binary_msh2, kNamed | kEntityGroups | kQuads | kMidNodes | kNodeValues, kBinary, ".msh2"},
    {".msh2", export_msh2, kNamed | kEntityGroups | kQuads | kMidNodes | kNodeValues, kText, ".binary.msh2"},
    {".geo", export_geo, kNamed | kDivisions | kEntityGroups | kMsh | kNodeValues, kText},
    {".cgns", export_cgns, kNamed | kQuads | kMidNodes | kNodeValues, kBinary},
    {".fro", export_fro, 0, kText},
    {".lb8.ugrid", export_lb8_ugrid, kNamed | kQuads | kMapbc, kBinary, ".ugrid"},
    {".b8.ugrid", export_b8_ugrid, kNamed | kQuads | kMapbc, kBinary, ".ugrid"},
    {".ugrid", export_ugrid, kNamed | kQuads | kMapbc, kText, ".lb8.ugrid"},
    {".su2", export_su2, kNamed | kQuads, kText},
    {".bdf", export_nastran, kNamed | kQuads | kMidNodes, kText},
    {".nas", export_nastran, kNamed | kQuads | kMidNodes, kText},
    {".mesh", export_medit, kNamed | kQuads | kParameters, kText, ".meshb"},
    {".meshb", export_binary_medit, kNumbers | kQuads | kParameters, kBinary, ".mesh"},
    {".off", export_off, 0, kText},
    {".smesh", export_smesh, kNamed, kText},
    {".poly", export_poly, kNamed, kText},
    {".csv", export_csv, kNodesOnly | kNodeValues, kText},
    {".eMesh", export_emesh, kFeaturesOnly, kText},
};

std::string suffixes_with(unsigned room) {
  std::string list;
  for (const Format& f : kFormats)
    if ((f.room & room) == room) list.append(list.empty() ? "" : ", ").append(f.suffix);
  return list;
}

/// Ends with the suffix, whatever its case.
bool has_suffix(const std::string& path, const std::string& suffix) {
  return path.size() > suffix.size() && std::equal(suffix.rbegin(), suffix.rend(), path.rbegin(), [](char a, char b) {
           return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
         });
}

std::string name_of_file(const std::string& path) { return path.substr(path.rfind('/') + 1); }

const Format* find_format(const std::string& path) {
  for (const Format& f : kFormats)
    if (has_suffix(path, f.suffix)) return &f;
  return nullptr;
}

/// By --format, else by the suffix.
const Format& chosen_format(const std::string& path, const ExportOptions& options) {
  const std::string name = name_of_file(path);
  const Format* found = find_format(options.format.empty() ? name : "x." + options.format);
  if (found) return *found;
  if (!options.format.empty())
    throw Error(ExitCode::kUsage,
                "--format: unknown format '" + options.format + "'; use a suffix of " + suffixes_with(0));
  const std::size_t dot = name.rfind('.');
  const std::string suffix = dot == std::string::npos ? "" : name.substr(dot);
  if (suffix == ".vtm" || suffix == ".sol")
    throw Error(ExitCode::kUsage, path + ": " + suffix + " is made of a finished mesh: st-export mesh.hdf -o " + name);
  std::vector<std::string> known;
  for (const Format& f : kFormats) known.emplace_back(f.suffix);
  if (std::find(known.begin(), known.end(), name) != known.end())
    throw Error(ExitCode::kUsage, path + ": is a suffix without a name; write mesh" + name);
  throw Error(ExitCode::kUsage, path + ": unknown suffix '" + suffix + "'" + did_you_mean(suffix, known) +
                                    " for an export; use one of " + suffixes_with(0) +
                                    ", with st-export also .vtm, .sol");
}

const Format& format_of(const std::string& path, const ExportOptions& options) {
  const Format& format = chosen_format(path, options);
  if (options.encoding == Encoding::kOfFormat || options.encoding == format.encoding) return format;
  if (!format.other)
    throw Error(ExitCode::kUsage, path + ": " + format.suffix + " has no " +
                                      (options.encoding == kText ? "text" : "binary") + " form; leave " +
                                      (options.encoding == kText ? "--ascii" : "--binary") + " out");
  return *find_format(std::string("x") + format.other);
}

void require_room(const std::string& path, const Format& format, Room room, const char* what, const char* flag) {
  if ((format.room & room) == 0)
    throw Error(ExitCode::kUsage,
                path + ": this format holds " + what + " only; for " + flag + " use one of " + suffixes_with(room));
}

/// What there is no room for.
std::vector<std::string> losses(const ExportMesh& all, const Format& format) {
  const SurfaceMesh& mesh = all.mesh;
  std::vector<std::string> lost;
  if (format.room & (kFeaturesOnly | kNodesOnly)) return lost;
  const auto lose = [&](const char* what, std::size_t n) {
    if (n > 0) lost.push_back(std::string(what) + " (" + std::to_string(n) + ")");
  };
  const std::vector<std::string>& groups = mesh.labels.group_name;
  const bool has_groups = groups.size() > 1 || (groups.size() == 1 && groups[0] != "default");
  if (has_groups && (format.room & kNamed) != kNamed)
    lose(format.room & kNumbers ? "names of groups" : "groups", groups.size());
  std::size_t n_parts = 0, n_tables = 0;
  for (const FaceNumbers& d : face_numbers(mesh)) d.name == "part" ? n_parts = d.names->size() : ++n_tables;
  if (!(format.room & kDivisions)) {
    lose("parts", n_parts);
    lose("further tables of groups", n_tables);
  }
  if (!(format.room & kEntityGroups))
    lose("groups of edges and vertices", mesh.labels.edge_groups.size() + mesh.labels.vertex_groups.size());
  if (!(format.room & kNodeValues)) lose("arrays of values at nodes", all.node_values.size());
  return lost;
}

/// The path without the suffix that its format was chosen by.
std::string stem_of(const std::string& path) {
  const Format* by_suffix = find_format(name_of_file(path));
  if (by_suffix) return path.substr(0, path.size() - std::strlen(by_suffix->suffix));
  const std::size_t dot = path.rfind('.'), slash = path.rfind('/');
  return dot == std::string::npos || (slash != std::string::npos && dot < slash) ? path : path.substr(0, dot);
}

}  // namespace

std::string export_suffixes() {
  std::string list;
  for (const Format& f : kFormats)
    if (std::strrchr(f.suffix, '.') == f.suffix) list.append(list.empty() ? "" : " ").append(f.suffix);
  return list;
}

std::string clean_name(std::string name, bool is_word) {
  for (char& c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < ' ' || byte == 0x7f || (is_word && byte == ' ')) c = '_';
    if (c == '"') c = '\'';
  }
  return name;
}

std::vector<std::string> group_words(const SurfaceMesh& m) {
  std::set<std::string> used;
  std::vector<std::string> words;
  for (const std::string& name : m.labels.group_name) {
    std::string word = clean_name(name, true);
    std::replace(word.begin(), word.end(), '/', '_');
    if (word.empty()) word = "group";
    std::string free = word;
    for (int k = 2; used.contains(free); ++k) (free = word).append("_").append(std::to_string(k));
    used.insert(free);
    words.push_back(free);
  }
  return words;
}

std::vector<std::int64_t> ExportTask::nodes_of(std::int64_t i) const {
  std::vector<std::int64_t> nodes;
  if (i < n_triangles())
    nodes.assign(mesh.triangles[elements.triangles[i]].n, mesh.triangles[elements.triangles[i]].n + 3);
  else
    nodes.assign(elements.quads[i - n_triangles()].n.begin(), elements.quads[i - n_triangles()].n.end());
  const std::size_t n_corners = nodes.size();
  for (std::size_t k = 0; !mid_nodes.empty() && k < n_corners; ++k)
    nodes.push_back(mesh.n_nodes() +
                    mid_nodes.between(static_cast<NodeId>(nodes[k]), static_cast<NodeId>(nodes[(k + 1) % n_corners])));
  return nodes;
}

std::vector<std::vector<std::int64_t>> elements_by_group(const ExportTask& task) {
  std::vector<std::vector<std::int64_t>> of_group(task.mesh.labels.group_name.size());
  for (std::int64_t i = 0; i < task.n_elements(); ++i) of_group[task.group_of(i)].push_back(i);
  return of_group;
}

bool has_export_suffix(const std::string& path) { return find_format(name_of_file(path)) != nullptr; }

void require_export_format(const std::string& path, const ExportOptions& options) {
  const Format& format = format_of(path, options);
  if (options.has_quads) require_room(path, format, kQuads, "triangles", "--quads");
  if (options.has_mid_nodes) require_room(path, format, kMidNodes, "straight elements", "--quadratic");
  if (options.has_parameters) require_room(path, format, kParameters, "coordinates", "--parametric");
}

std::vector<std::string> files_beside(const std::string& path, const ExportOptions& options) {
  const unsigned room = format_of(path, options).room;
  if (room & kMapbc) return {stem_of(path) + ".mapbc"};
  if (room & kMsh) return {stem_of(path) + ".msh"};
  return {};
}

std::vector<std::string> export_mesh(const std::string& path, const ExportMesh& mesh, const ExportOptions& options) {
  ExportOptions wanted = options;
  wanted.has_quads |= !mesh.elements.quads.empty();
  wanted.has_mid_nodes |= !mesh.mid_nodes.empty();
  require_export_format(path, wanted);
  const Format& format = format_of(path, wanted);
  const ExportTask task{
      mesh.mesh, mesh.elements, mesh.mid_nodes, options, mesh.values, mesh.node_values, name_of_file(stem_of(path))};
  Output out(path);
  format.write(out, task);
  for (const std::string& beside : files_beside(path, wanted)) {
    Output other(beside);
    format.room& kMsh ? export_msh(other, task) : export_mapbc(other, task);
    other.commit();
  }
  out.commit();
  return losses(mesh, format);
}

std::vector<std::string> export_mesh(const std::string& path, const SurfaceMesh& mesh) {
  return export_mesh(path, {mesh, all_triangles(mesh), {}}, {});
}

std::string path_of_group(const std::string& path, const std::string& word) {
  constexpr std::size_t kMost = 200;  // bytes: file systems take 255, and temporary names are longer
  const std::string stem = stem_of(path), suffix = path.substr(stem.size());
  const std::size_t base = stem.size() - (stem.rfind('/') + 1);  // npos + 1 is 0
  std::string kept = word;
  if (base + 1 + word.size() + suffix.size() > kMost) {
    const std::string digest = std::string("~").append(hash_hex(word.data(), word.size()));
    const std::size_t taken = base + 1 + digest.size() + suffix.size();
    std::size_t n = taken < kMost ? kMost - taken : 0;
    while (n > 0 && (static_cast<unsigned char>(word[n]) & 0xC0) == 0x80) --n;  // no half of a letter
    kept = word.substr(0, n) + digest;
  }
  return stem + "_" + kept + suffix;
}

}  // namespace st
