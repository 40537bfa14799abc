#include "stages/check_shares.h"

#include <algorithm>
#include <array>
#include <bit>
#include <filesystem>
#include <limits>
#include <set>
#include <span>
#include <system_error>
#include <utility>

#include "base/radix_sort.h"
#include "io/foreign/triangulation_reader.h"
#include "io/hdf5/sizing_artifact.h"
#include "mesh/triangle_tree.h"
#include "stages/foreign_mesh.h"
#include "stages/share_crossings.h"
#include "stages/stored_model.h"
#include "stages/wing_table.h"

namespace st {
namespace {

constexpr std::int64_t kNodesPerClass = 8'000'000;
constexpr std::int64_t kRowsAtOnce = 1'000'000;

/// Consecutive triangles of one face, and how many of a group.
struct Run {
  std::int32_t id = kNone;
  TriangleId first = 0;
  std::int64_t n = 0;
};

/// What one rank has seen of the rows.
struct Scan {
  bool is_sound = false;
  std::vector<Run> faces;
  std::vector<std::int64_t> groups;
  std::vector<SidePart> sides;
  Box3 box;

  static auto fields(auto& s) { return std::tie(s.is_sound, s.faces, s.groups, s.sides, s.box); }
};

class SharedMeasure {
 public:
  SharedMeasure(const CheckBasis& given, const MeshFile& file, const Executor& ranks, Progress& progress,
                std::int64_t per_share)
      : file_(file), ranks_(ranks), progress_(progress) {
    found_.basis = given;
    n_pieces_ = (file.n_triangles() + kPiece - 1) / kPiece;
    n_shares_ = static_cast<std::int32_t>(std::min<std::int64_t>(
        n_pieces_, std::max<std::int64_t>((file.n_triangles() + per_share - 1) / per_share, ranks.size())));
  }

  bool run() {
    if (n_shares_ < 2) return false;
    if (!agree_on_basis()) return false;
    progress_.step("measuring", 0.1);
    measure_own_shares();
    find_equal_nodes();
    if (ranks_.is_root()) finish();
    return true;
  }
  SharedFindings take() { return std::move(found_); }

 private:
  static constexpr auto kPiece = static_cast<std::int64_t>(kTrianglesPerPiece);

  /// What part `k` of `n` begins with: triangles in whole pieces.
  std::int64_t part_begin(std::int64_t k, std::int64_t n) const {
    return std::min(file_.n_triangles(), n_pieces_ * k / n * kPiece);
  }
  TriangleId share_begin(std::int32_t share) const { return static_cast<TriangleId>(part_begin(share, n_shares_)); }
  std::int32_t first_share(int rank) const {
    return static_cast<std::int32_t>(std::int64_t{n_shares_} * rank / ranks_.size());
  }
  const ModelTables* tables() const { return found_.basis.cad ? &found_.basis.cad->model.tables() : nullptr; }

  Scan scan() const {
    Scan scan;
    constexpr std::int64_t kAny = std::numeric_limits<std::int64_t>::max();
    std::array<std::int64_t, 3> n_entities{kAny, kAny,
                                           static_cast<std::int64_t>(file_.head().mesh.labels.face_name.size())};
    if (const ModelTables* t = tables())
      n_entities = {t->n_vertices(), t->n_edges(), std::min<std::int64_t>(t->n_faces(), n_entities[2])};
    scan.is_sound = file_.is_sound(ranks_.rank(), ranks_.size(), n_entities);
    if (!scan.is_sound) return scan;
    const std::int64_t begin = part_begin(ranks_.rank(), ranks_.size()),
                       end = part_begin(ranks_.rank() + 1, ranks_.size());
    scan.groups.assign(file_.head().mesh.labels.group_name.size(), 0);
    for (std::int64_t first = begin; first < end; first += kPiece) {
      const std::int64_t n = std::min(kPiece, end - first);
      const std::vector<FaceId> faces = file_.faces(first, n);
      for (std::size_t i = 0; i < faces.size(); ++i) {
        if (scan.faces.empty() || scan.faces.back().id != faces[i])
          scan.faces.push_back({faces[i], static_cast<TriangleId>(first + static_cast<std::int64_t>(i)), 0});
        ++scan.faces.back().n;
      }
      for (const std::int32_t g : file_.groups(first, n)) ++scan.groups[g];
      if (!tables()) continue;
      for (const SidePart& part : side_parts(file_.corner_uv(first, n), faces)) scan.sides.push_back(part);
    }
    const std::int64_t n_nodes = file_.n_nodes(), last = n_nodes * (ranks_.rank() + 1) / ranks_.size();
    for (std::int64_t first = n_nodes * ranks_.rank() / ranks_.size(); first < last; first += kRowsAtOnce)
      for (const Vec3 p : file_.points(first, std::min(kRowsAtOnce, last - first))) scan.box.add(p);
    return scan;
  }

  /// Every rank makes the same of what all have seen. False: the mesh is not to be shared.
  bool agree_on_basis() {
    const std::vector<Scan> scans = gather_for_all(ranks_, scan());
    CheckBasis& basis = found_.basis;
    const FaceLabels& labels = file_.head().mesh.labels;
    basis.counts = {file_.n_triangles(), std::vector<std::int64_t>(labels.group_name.size(), 0),
                    std::vector<std::int64_t>(labels.face_name.size(), 0)};
    if (const ModelTables* t = tables()) basis.face_place.resize(t->n_faces());
    Box3 box;
    std::vector<SidePart> sides;
    FaceId last = kNone;
    for (const Scan& scan : scans) {
      if (!scan.is_sound) return false;
      for (const Run& run : scan.faces) {
        if (run.id < last) return false;
        if (run.id != last && tables()) basis.face_place[run.id] = middle_of(run.first);
        basis.counts.faces[run.id] += run.n;
        last = run.id;
      }
      for (std::size_t g = 0; g < scan.groups.size(); ++g) basis.counts.groups[g] += scan.groups[g];
      sides.insert(sides.end(), scan.sides.begin(), scan.sides.end());
      box.add(scan.box);
    }
    basis.origin = box.center();
    if (const ModelTables* t = tables()) basis.face_side = sides_of_faces(sides, t->n_faces());
    return true;
  }

  Vec3 middle_of(TriangleId t) const {
    const Triangle triangle = file_.triangles(t, 1)[0];
    Vec3 sum = file_.points(triangle.n[0], 1)[0];
    sum = sum + file_.points(triangle.n[1], 1)[0];
    return (sum + file_.points(triangle.n[2], 1)[0]) / 3;
  }

  void measure_own_shares() {
    const std::int32_t first = first_share(ranks_.rank()), last = first_share(ranks_.rank() + 1);
    CheckParts own;
    ShareCrossings crossings(file_, ranks_);
    for (std::int32_t k = first; k < last; ++k) {
      const MeshSelection share = file_.share(share_begin(k), share_begin(k + 1));
      const TriangleCorners corners(share.mesh);
      CheckParts parts =
          measure_share(found_.basis, share.mesh, corners, share.own(), {}, progress_, 0.7 / (last - first));
      if (found_.basis.cad)
        parts.causes = find_shape_causes(
            found_.basis.cad->model, share.mesh, corners,
            {parts.quality.large_jumps, parts.conformity.outside, found_.basis.options->list_below_deg}, share.own());
      crossings.add(share);
      own.add(parts, found_.basis.counts);
    }
    const std::vector<Bytes> all = ranks_.gather(packed(own));
    for (const Bytes& bytes : all) {
      CheckParts parts;
      unpack(bytes, parts);
      found_.parts.add(parts, found_.basis.counts);
    }
    crossings.find(found_.parts);
  }

  /// Whether any two nodes of a class are at one place, or seem to be.
  bool has_equal_nodes(std::uint64_t number, std::uint64_t n_classes) const {
    std::vector<std::uint64_t> hashes;
    for (std::int64_t first = 0; first < file_.n_nodes(); first += kRowsAtOnce)
      for (const Vec3 p : file_.points(first, std::min(kRowsAtOnce, file_.n_nodes() - first)))
        if (const std::uint64_t hash = hash_of(p); hash % n_classes == number) hashes.push_back(hash);
    const std::size_t n = hashes.size();
    sort_unique(hashes);
    return hashes.size() < n;
  }
  static std::uint64_t hash_of(Vec3 p) {
    std::uint64_t h = 0;
    for (const double x : {p.x, p.y, p.z}) {
      h = (h ^ std::bit_cast<std::uint64_t>(x + 0.0)) * 0x9E3779B97F4A7C15u;  // + 0.0: -0 and 0 are one place
      h ^= h >> 29;
    }
    return h;
  }

  void find_equal_nodes() {
    const auto n_classes = static_cast<std::uint64_t>((file_.n_nodes() + kNodesPerClass - 1) / kNodesPerClass);
    bool has_any = false;
    for (std::uint64_t c = 0; c < n_classes; ++c)
      if (c % static_cast<std::uint64_t>(ranks_.size()) == static_cast<std::uint64_t>(ranks_.rank()))
        has_any |= has_equal_nodes(c, n_classes);
    for (const Bytes& bytes : ranks_.gather(packed(has_any))) {
      bool has = false;
      unpack(bytes, has);
      may_have_equal_nodes_ |= has;
    }
  }

  /// On the first rank: what is of the whole mesh, one triangle after the other.
  void finish() {
    CheckParts& parts = found_.parts;
    ComponentFinder finder(file_.n_nodes());
    for (std::int64_t first = 0; first < file_.n_triangles(); first += kRowsAtOnce)
      finder.add(file_.triangles(first, std::min(kRowsAtOnce, file_.n_triangles() - first)));
    MeshParts whole;
    const std::vector<std::int32_t> component = finder.components(whole.n_components);
    whole.n_used_nodes = file_.n_nodes() - std::count(component.begin(), component.end(), kNone);
    parts.topology.set_parts(whole, file_.n_triangles());
    if (may_have_equal_nodes_) add_equal_nodes();
    settle_pairs();
    place_pairs(component);
    found_.edges = file_.select({}, MeshFile::Rows::kAllWithEdgeNodes);
  }

  void add_equal_nodes() {
    SurfaceMesh mesh;
    mesh.node_xyz = file_.points(0, file_.n_nodes());
    mesh.triangles = file_.triangles(0, file_.n_triangles());
    mesh.triangle_face = file_.faces(0, file_.n_triangles());
    mesh.node_entity_dim = file_.dims(0, file_.n_nodes());
    found_.parts.shape.duplicate_nodes = find_duplicate_nodes(mesh);
  }

  /// Where triangles lie in each other without end, the search is that of a mesh in memory, which ends somewhere.
  void settle_pairs() {
    constexpr std::int64_t kSurely = 2;  // a search as a whole takes no more than so many times as long
    CheckParts& parts = found_.parts;
    if (parts.was_ended || kSurely * parts.n_compared > most_comparisons(static_cast<std::size_t>(file_.n_triangles())))
      parts.pairs = find_crossing_triangles(file_.points(0, file_.n_nodes()), file_.triangles(0, file_.n_triangles()),
                                            parts.was_ended);
    std::sort(parts.pairs.begin(), parts.pairs.end(),
              [](const TrianglePair& x, const TrianglePair& y) { return std::pair(x.a, x.b) < std::pair(y.a, y.b); });
    found_.was_ended = parts.was_ended;
  }

  void place_pairs(std::span<const std::int32_t> component) {
    std::set<TriangleId> numbers;
    for (const TrianglePair& p : found_.parts.pairs) numbers.insert({p.a, p.b});
    found_.crossing = file_.select({numbers.begin(), numbers.end()}, MeshFile::Rows::kAll);
    const std::vector<TriangleId>& all = found_.crossing.triangle_number;
    const auto place = [&](TriangleId t) {
      return static_cast<TriangleId>(std::lower_bound(all.begin(), all.end(), t) - all.begin());
    };
    for (const TrianglePair& p : found_.parts.pairs) found_.pairs.push_back({place(p.a), place(p.b), p.n_shared});
    for (const NodeId n : found_.crossing.node_number) found_.component.push_back(component[n]);
  }

  const MeshFile& file_;
  const Executor& ranks_;
  Progress& progress_;
  std::int64_t n_pieces_ = 0;
  std::int32_t n_shares_ = 0;
  SharedFindings found_;
  bool may_have_equal_nodes_ = false;
};

/// As part_as_meshed() of a mesh that is read whole. Goes through the faces of all triangles where some are joined.
void part_as_meshed(const MeshFile& file, GeometryArtifact& geometry) {
  std::vector<std::uint8_t> is_apart(static_cast<std::size_t>(geometry.composites.size()), !file.has_cad_faces());
  for (std::int64_t first = 0; first < file.n_triangles() && std::ranges::count(is_apart, 0) > 0;
       first += kTrianglesPerShare)
    mark_apart(geometry.composites, file.faces(first, std::min(kTrianglesPerShare, file.n_triangles() - first)),
               is_apart);
  part_joined_faces(geometry, is_apart);
}

}  // namespace

bool is_worth_sharing(const CheckStageOptions& o, const Executor& ranks) {
  constexpr std::int64_t kBytesPerTriangle = 89;  // of mesh.hdf, without nodes
  if (is_foreign_mesh(o.mesh) || !o.layers.empty()) return false;
  std::error_code none;
  return ranks.size() > 1 ||
         static_cast<std::int64_t>(std::filesystem::file_size(o.mesh, none)) > kBytesPerTriangle * kTrianglesPerShare;
}

SharedMesh::SharedMesh(const CheckStageOptions& o) : file(o.mesh) {
  const ArtifactHeader& own = file.head().header;
  if (!o.geometry.empty()) {
    GeometryArtifact geometry = read_geometry(o.geometry);
    require_same_geometry(o.mesh, own, o.geometry, geometry.header);
    part_as_meshed(file, geometry);
    cad = std::make_unique<CadSide>(std::move(geometry), o.geometry);
  }
  if (o.sizing.empty()) return;
  ArtifactHeader header;
  field = open_sizing(o.sizing, &header);
  require_same_geometry(o.mesh, own, o.sizing, header);
  wings = read_asked_wings(o.sizing);
}

std::optional<SharedFindings> measure_shares(const CheckBasis& given, const MeshFile& file, const Executor& ranks,
                                             Progress& progress, std::int64_t per_share) {
  SharedMeasure measure(given, file, ranks, progress, per_share);
  if (!measure.run()) return std::nullopt;
  return measure.take();
}

}  // namespace st
