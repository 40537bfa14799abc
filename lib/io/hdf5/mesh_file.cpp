#include "io/hdf5/mesh_file.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <numeric>
#include <utility>

#include "base/limits.h"
#include "base/threads.h"
#include "io/hdf5/artifact_checks.h"
#include "io/hdf5/face_labels_io.h"
#include "io/hdf5/merged_features.h"

namespace st {
namespace {

constexpr std::int64_t kRowsAtOnce = 65'536;
constexpr std::uint8_t kVtkTriangle = 5;
constexpr std::int64_t kWorthReading = 64;  // rows between two that are asked for: cheaper than another read

constexpr const char *kPoints = "/VTKHDF/Points", *kNodes = "/VTKHDF/Connectivity", *kOffsets = "/VTKHDF/Offsets",
                     *kTypes = "/VTKHDF/Types", *kFaces = "/VTKHDF/CellData/face", *kGroups = "/VTKHDF/CellData/group",
                     *kDims = "/VTKHDF/PointData/entity_dim", *kEntities = "/VTKHDF/PointData/entity_id",
                     *kSizes = "/VTKHDF/PointData/size", *kParameters = "/st/node/t",
                     *kCornerUv = "/st/triangle/corner_uv";

/// Calls f(begin, end) for pieces of [begin, end).
template <class Function>
void in_pieces(std::int64_t begin, std::int64_t end, const Function& f) {
  for (; begin < end; begin += kRowsAtOnce) f(begin, std::min(end, begin + kRowsAtOnce));
}

/// Which of the nodes are there, and their numbers among these.
class NodeSet {
 public:
  explicit NodeSet(std::int64_t n) : words_(static_cast<std::size_t>(n + 63) / 64, 0) {}
  void add(NodeId n) { words_[static_cast<std::size_t>(n) / 64] |= bit(n); }
  bool has(NodeId n) const { return (words_[static_cast<std::size_t>(n) / 64] & bit(n)) != 0; }
  std::vector<NodeId> numbers() const {
    std::vector<NodeId> all;
    for (std::size_t w = 0; w < words_.size(); ++w)
      for (std::uint64_t left = words_[w]; left != 0; left &= left - 1)
        all.push_back(static_cast<NodeId>(64 * w) + std::countr_zero(left));
    return all;
  }
  /// Before rank(): no add() follows.
  void count() {
    before_.resize(words_.size());
    NodeId n = 0;
    for (std::size_t w = 0; w < words_.size(); ++w) before_[w] = n, n += std::popcount(words_[w]);
  }
  NodeId rank(NodeId n) const {
    const std::size_t w = static_cast<std::size_t>(n) / 64;
    return before_[w] + std::popcount(words_[w] & (bit(n) - 1));
  }

 private:
  static std::uint64_t bit(NodeId n) { return std::uint64_t{1} << (n % 64); }
  std::vector<std::uint64_t> words_;
  std::vector<NodeId> before_;
};

/// Rows with these numbers, ascending; `n_each`: rows of the dataset for each.
template <class T>
std::vector<T> read_rows(const RowReader& rows, const RowPlace& place, std::span<const std::int32_t> numbers,
                         std::size_t n_each = 1) {
  std::vector<T> values;
  values.reserve(numbers.size() * n_each);
  for (std::size_t i = 0, end = 0; i < numbers.size(); i = end) {
    const std::int64_t first = numbers[i];
    for (end = i + 1; end < numbers.size() && numbers[end] - numbers[end - 1] <= kWorthReading &&
                      numbers[end] - first < kRowsAtOnce;)
      ++end;
    const auto n = static_cast<std::size_t>(numbers[end - 1] - first + 1);
    const std::vector<T> some = rows.read<T>(place, static_cast<std::size_t>(first) * n_each, n * n_each);
    for (; i < end; ++i) {
      const auto at = some.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(numbers[i] - first) * n_each);
      values.insert(values.end(), at, at + static_cast<std::ptrdiff_t>(n_each));
    }
  }
  return values;
}

void make_zero_based(std::vector<std::int32_t>& ids) {
  for (std::int32_t& id : ids) --id;
}

}  // namespace

MeshFile::MeshFile(const std::string& path) : reader_(path, "mesh", kMeshVersion), rows_(path, reader_) {
  head_.header = reader_.header();
  head_.is_complete = reader_.int_attribute("/st", "is_complete") != 0;
  head_.mesh.labels = read_labels(reader_, reader_.read_strings("/st/face/name").size());
  head_.mesh.merged = read_merged(reader_, kAnyEdge, head_.mesh.labels.face_name.size());
  n_nodes_ = static_cast<std::int64_t>(rows_.n_rows(kDims));
  n_triangles_ = static_cast<std::int64_t>(rows_.n_rows(kFaces));
  require_countable(static_cast<std::size_t>(n_triangles_), "triangles of one mesh", kMaxTriangles);
  require_countable(static_cast<std::size_t>(n_nodes_), "nodes of one mesh");
  std::int64_t high = n_nodes_;
  while (n_edge_nodes_ < high) {
    const std::int64_t middle = (n_edge_nodes_ + high) / 2;
    const bool is_inner = rows_.read<std::uint8_t>(kDims, static_cast<std::size_t>(middle), 1)[0] >=
                          static_cast<std::uint8_t>(EntityDim::kFace);
    (is_inner ? high : n_edge_nodes_) = is_inner ? middle : middle + 1;
  }
}

std::vector<Vec3> MeshFile::points(std::int64_t first, std::int64_t n) const {
  return rows_.read<Vec3>(kPoints, static_cast<std::size_t>(first), static_cast<std::size_t>(n));
}

std::vector<std::uint8_t> MeshFile::dims(std::int64_t first, std::int64_t n) const {
  return rows_.read<std::uint8_t>(kDims, static_cast<std::size_t>(first), static_cast<std::size_t>(n));
}

std::vector<Triangle> MeshFile::triangles(std::int64_t first, std::int64_t n) const {
  std::vector<Triangle> triangles(static_cast<std::size_t>(n));
  const RowPlace place = rows_.find<std::int64_t>(kNodes);
  in_pieces(0, n, [&](std::int64_t begin, std::int64_t end) {
    const std::vector<std::int64_t> nodes = rows_.read<std::int64_t>(
        place, static_cast<std::size_t>(3 * (first + begin)), static_cast<std::size_t>(3 * (end - begin)));
    for (std::size_t i = 0; i < nodes.size(); ++i)
      triangles[static_cast<std::size_t>(begin) + i / 3].n[i % 3] = static_cast<NodeId>(nodes[i]);
  });
  return triangles;
}

std::vector<std::int32_t> MeshFile::ids(const char* name, std::int64_t first, std::int64_t n) const {
  auto ids = rows_.read<std::int32_t>(name, static_cast<std::size_t>(first), static_cast<std::size_t>(n));
  make_zero_based(ids);
  return ids;
}

std::vector<FaceId> MeshFile::faces(std::int64_t first, std::int64_t n) const { return ids(kFaces, first, n); }
std::vector<std::int32_t> MeshFile::groups(std::int64_t first, std::int64_t n) const { return ids(kGroups, first, n); }

std::vector<Vec2> MeshFile::corner_uv(std::int64_t first_triangle, std::int64_t n_triangles) const {
  return rows_.read<Vec2>(kCornerUv, static_cast<std::size_t>(3 * first_triangle),
                          static_cast<std::size_t>(3 * n_triangles));
}

bool MeshFile::are_nodes_sound(std::int64_t begin, std::int64_t end,
                               const std::array<std::int64_t, 3>& n_entities) const {
  bool is_sound = true;
  int last = begin > 0 ? rows_.read<std::uint8_t>(kDims, static_cast<std::size_t>(begin) - 1, 1)[0] : 0;
  in_pieces(begin, end, [&](std::int64_t first, std::int64_t behind) {
    const auto at = static_cast<std::size_t>(first), n = static_cast<std::size_t>(behind - first);
    const auto xyz = rows_.read<Vec3>(kPoints, at, n);
    const auto dim = rows_.read<std::uint8_t>(kDims, at, n);
    const auto entity = ids(kEntities, first, behind - first);
    const auto size = rows_.read<double>(kSizes, at, n);
    for (std::size_t i = 0; i < n; ++i) {
      is_sound &= is_finite(xyz[i]) && is_finite(size[i]) && size[i] >= 0 && dim[i] >= last && dim[i] <= 2;
      if (!is_sound) return;
      last = dim[i];
      is_sound &= entity[i] >= 0 && entity[i] < n_entities[dim[i]];
    }
  });
  return is_sound;
}

bool MeshFile::are_triangles_sound(std::int64_t begin, std::int64_t end) const {
  bool is_sound = true;
  const auto n_faces = static_cast<FaceId>(head_.mesh.labels.face_name.size());
  const auto n_groups = static_cast<std::int32_t>(head_.mesh.labels.group_name.size());
  in_pieces(begin, end, [&](std::int64_t first, std::int64_t behind) {
    const auto at = static_cast<std::size_t>(first), n = static_cast<std::size_t>(behind - first);
    const auto node = rows_.read<std::int64_t>(kNodes, 3 * at, 3 * n);
    const auto offset = rows_.read<std::int64_t>(kOffsets, at, n + 1);
    const auto type = rows_.read<std::uint8_t>(kTypes, at, n);
    const std::vector<FaceId> face = faces(first, behind - first);
    const std::vector<std::int32_t> group = groups(first, behind - first);
    for (const std::int64_t i : node) is_sound &= i >= 0 && i < n_nodes_;
    for (std::size_t i = 0; i < n; ++i)
      is_sound &= type[i] == kVtkTriangle && offset[i] == 3 * (first + static_cast<std::int64_t>(i)) && face[i] >= 0 &&
                  face[i] < n_faces && group[i] >= 0 && group[i] < n_groups;
  });
  return is_sound;
}

bool MeshFile::is_sound(int part, int n_parts, const std::array<std::int64_t, 3>& n_entities) const {
  const auto share_of = [&](std::int64_t n, int k) { return n * k / n_parts; };
  try {
    const auto has_rows = [&](const char* name, std::int64_t n) {
      return static_cast<std::int64_t>(rows_.n_rows(name)) == n;
    };
    for (const char* name : {kPoints, kDims, kEntities, kSizes, kParameters})
      if (!has_rows(name, n_nodes_)) return false;
    for (const char* name : {kTypes, kFaces, kGroups})
      if (!has_rows(name, n_triangles_)) return false;
    if (!has_rows(kNodes, 3 * n_triangles_) || !has_rows(kOffsets, n_triangles_ + 1) ||
        !has_rows(kCornerUv, 3 * n_triangles_))
      return false;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < reader_.datasets().size(); ++i) {
      const DatasetInfo& info = reader_.datasets()[i];
      if (i % static_cast<std::size_t>(n_parts) == static_cast<std::size_t>(part) && info.type != ElementType::kString)
        names.push_back(info.name);
    }
    rows_.verify(names);
    rows_.find<double>(kParameters);
    rows_.find<Vec2>(kCornerUv);
    return are_nodes_sound(share_of(n_nodes_, part), share_of(n_nodes_, part + 1), n_entities) &&
           are_triangles_sound(share_of(n_triangles_, part), share_of(n_triangles_, part + 1));
  } catch (const Error&) {
    return false;
  }
}

std::vector<TriangleId> MeshFile::find_neighbours(TriangleId begin, TriangleId end) const {
  NodeSet own(n_nodes_);
  in_pieces(begin, end, [&](std::int64_t first, std::int64_t behind) {
    for (const Triangle& t : triangles(first, behind - first))
      for (const NodeId n : t.n) own.add(n);
  });
  std::vector<std::vector<TriangleId>> found(static_cast<std::size_t>(n_triangles_ + kRowsAtOnce - 1) / kRowsAtOnce);
  parallel_for(static_cast<std::size_t>(n_triangles_), kRowsAtOnce, [&](std::size_t first, std::size_t behind) {
    if (static_cast<std::int64_t>(first) >= begin && static_cast<std::int64_t>(behind) <= end) return;
    const std::vector<Triangle> some =
        triangles(static_cast<std::int64_t>(first), static_cast<std::int64_t>(behind - first));
    for (std::size_t i = 0; i < some.size(); ++i) {
      const auto t = static_cast<TriangleId>(first + i);
      const auto& n = some[i].n;
      if ((t < begin || t >= end) && (own.has(n[0]) || own.has(n[1]) || own.has(n[2])))
        found[first / kRowsAtOnce].push_back(t);
    }
  });
  std::vector<TriangleId> all;
  for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
  return all;
}

MeshSelection MeshFile::share(TriangleId begin, TriangleId end) const {
  std::vector<TriangleId> all = find_neighbours(begin, end);
  const auto middle = std::lower_bound(all.begin(), all.end(), begin);
  const auto n_before = static_cast<TriangleId>(middle - all.begin());
  std::vector<TriangleId> own(static_cast<std::size_t>(end - begin));
  std::iota(own.begin(), own.end(), begin);
  all.insert(middle, own.begin(), own.end());
  MeshSelection share = select(std::move(all), Rows::kAllWithEdgeNodes);
  share.begin = n_before;
  share.end = n_before + (end - begin);
  share.first = begin;
  return share;
}

MeshSelection MeshFile::select(std::vector<TriangleId> triangles, Rows rows) const {
  MeshSelection share;
  share.end = static_cast<TriangleId>(triangles.size());
  share.mesh.labels = head_.mesh.labels;
  share.mesh.merged = head_.mesh.merged;
  NodeSet nodes(n_nodes_);
  for (NodeId n = 0; rows == Rows::kAllWithEdgeNodes && n < n_edge_nodes_; ++n) nodes.add(n);
  SurfaceMesh& mesh = share.mesh;
  mesh.triangles.reserve(triangles.size());
  const RowPlace place = rows_.find<std::int64_t>(kNodes);
  in_pieces(0, static_cast<std::int64_t>(triangles.size()), [&](std::int64_t begin, std::int64_t end) {
    const auto some =
        std::span(triangles).subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin));
    const std::vector<std::int64_t> corners = read_rows<std::int64_t>(rows_, place, some, 3);
    for (const std::int64_t n : corners)
      if (n < 0 || n >= n_nodes_) reader_.fail(kNodes, "names node " + std::to_string(n));
    for (std::size_t i = 0; i < corners.size(); i += 3) {
      Triangle& t = mesh.triangles.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) nodes.add(t.n[k] = static_cast<NodeId>(corners[i + k]));
    }
  });
  nodes.count();
  for (Triangle& t : mesh.triangles)
    for (NodeId& n : t.n) n = nodes.rank(n);
  mesh.triangle_face = read_rows<FaceId>(rows_, rows_.find<std::int32_t>(kFaces), triangles);
  mesh.triangle_group = read_rows<std::int32_t>(rows_, rows_.find<std::int32_t>(kGroups), triangles);
  make_zero_based(mesh.triangle_face);
  make_zero_based(mesh.triangle_group);
  if (rows != Rows::kPlaces) mesh.corner_uv = read_rows<Vec2>(rows_, rows_.find<Vec2>(kCornerUv), triangles, 3);
  share.node_number = nodes.numbers();
  share.triangle_number = std::move(triangles);
  read_nodes(rows, share);
  return share;
}

void MeshFile::for_faces(const std::function<bool(FaceId)>& is_wanted,
                         const std::function<void(const MeshSelection&)>& visit) const {
  constexpr std::size_t kAtOnce = 500'000;
  std::vector<TriangleId> wanted;
  FaceId last = kNone;
  bool is_last_wanted = false;
  const auto flush = [&] {
    if (!wanted.empty()) visit(select(std::exchange(wanted, {}), Rows::kPlaces));
  };
  in_pieces(0, n_triangles_, [&](std::int64_t begin, std::int64_t end) {
    const std::vector<FaceId> some = faces(begin, end - begin);
    for (std::size_t i = 0; i < some.size(); ++i) {
      if (some[i] != last) is_last_wanted = is_wanted(last = some[i]);
      if (is_last_wanted) wanted.push_back(static_cast<TriangleId>(begin + static_cast<std::int64_t>(i)));
    }
    if (wanted.size() >= kAtOnce) flush();
  });
  flush();
}

void MeshFile::read_nodes(Rows rows, MeshSelection& share) const {
  SurfaceMesh& mesh = share.mesh;
  mesh.node_xyz = read_rows<Vec3>(rows_, rows_.find<Vec3>(kPoints), share.node_number);
  if (rows == Rows::kPlaces) return;
  mesh.node_entity_dim = read_rows<std::uint8_t>(rows_, rows_.find<std::uint8_t>(kDims), share.node_number);
  mesh.node_entity = read_rows<std::int32_t>(rows_, rows_.find<std::int32_t>(kEntities), share.node_number);
  make_zero_based(mesh.node_entity);
  mesh.node_t = read_rows<double>(rows_, rows_.find<double>(kParameters), share.node_number);
  mesh.node_size = read_rows<double>(rows_, rows_.find<double>(kSizes), share.node_number);
}

}  // namespace st
