#include "stages/merge_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "io/hdf5/artifact_checks.h"
#include "mesh/corner_uv.h"

namespace st {
namespace {

constexpr std::int64_t kRowsAtOnce = 65'536;

class MergedRows {
 public:
  MergedRows(const std::vector<PatchInFile>& patches, const MergeInput& input, const MergeOrder& order)
      : patches_(patches), input_(input), order_(order) {}

  /// Nodes on boundaries as they are, then `value_of` each face for its nodes inside.
  template <class T, class ValueOf>
  Column<T> of_face_nodes(const std::vector<T>& of_boundary, const ValueOf& value_of) const {
    return {n_nodes(), [this, &of_boundary, value_of](const auto& take) {
              take(of_boundary);
              for (std::size_t i = 0; i < patches_.size(); ++i)
                repeat(value_of(patches_[i].face()), order_.numbers.inner_begin[i + 1] - order_.numbers.inner_begin[i],
                       take);
            }};
  }
  /// Nodes on boundaries as they are, then the rows of the patches.
  template <class T>
  Column<T> of_nodes(const std::vector<T>& of_boundary, RowPlace PatchRows::*rows) const {
    return {n_nodes(), [this, &of_boundary, rows](const auto& take) {
              take(of_boundary);
              for (std::size_t i = 0; i < patches_.size(); ++i) take_inner<T>(i, rows, take);
            }};
  }
  template <class T, class ValueOf>
  Column<T> of_faces(const ValueOf& value_of) const {
    return {n_triangles(), [this, value_of](const auto& take) {
              for (const PatchInFile& p : patches_) repeat(value_of(p.face()), p.file->n_triangles(p.patch), take);
            }};
  }
  template <class T>
  Column<T> of_triangles(RowPlace PatchRows::*rows) const {
    return {n_triangles(), [this, rows](const auto& take) {
              for (const PatchInFile& p : patches_)
                in_pieces(p.file->n_triangles(p.patch), [&](std::int64_t begin, std::int64_t n) {
                  const auto values = read<T>(p, rows, p.file->triangle_begin(p.patch) + begin, n);
                  take(values);
                });
            }};
  }
  Column<Vec2> corner_uv() const {
    return {3 * n_triangles(), [this](const auto& take) {
              for (std::size_t i = 0; i < patches_.size(); ++i) take_corner_uv(i, take);
            }};
  }
  /// Of the place on the CAD at the middle of each triangle.
  Column<FaceId> cad_faces(const CadPlaces& cad) const {
    return {n_triangles(), [this, &cad](const auto& take) {
              for (std::size_t i = 0; i < patches_.size(); ++i)
                take_corner_uv(i, [&](const std::vector<Vec2>& uv) {
                  std::vector<FaceId> faces;
                  for (const CadPlace& p : cad.on(patches_[i].face(), middles(uv))) faces.push_back(p.face);
                  take(faces);
                });
            }};
  }
  /// `value_of` the place on the CAD of each node inside a face; `none` on boundaries.
  template <class T, class ValueOf>
  Column<T> of_cad(const CadPlaces& cad, T none, const ValueOf& value_of) const {
    return {n_nodes(), [this, &cad, none, value_of](const auto& take) {
              repeat(none, order_.numbers.n_boundary(), take);
              for (std::size_t i = 0; i < patches_.size(); ++i)
                take_inner<Vec2>(i, &PatchRows::inner_uv, [&](const std::vector<Vec2>& uv) {
                  std::vector<T> values;
                  for (const CadPlace& p : cad.on(patches_[i].face(), uv)) values.push_back(value_of(p));
                  take(values);
                });
            }};
  }
  Column<Triangle> triangles() const {
    return {n_triangles(), [this](const auto& take) {
              for (std::size_t i = 0; i < patches_.size(); ++i) take_triangles(i, take);
            }};
  }

 private:
  std::size_t n_nodes() const { return static_cast<std::size_t>(order_.numbers.n_nodes()); }
  std::size_t n_triangles() const { return static_cast<std::size_t>(order_.numbers.n_triangles()); }

  template <class Function>
  static void in_pieces(std::int64_t n, const Function& f) {
    for (std::int64_t begin = 0; begin < n; begin += kRowsAtOnce) f(begin, std::min(kRowsAtOnce, n - begin));
  }

  template <class T, class Take>
  static void repeat(T value, std::int64_t n, const Take& take) {
    const std::vector<T> values(static_cast<std::size_t>(std::min(n, kRowsAtOnce)), value);
    in_pieces(n, [&](std::int64_t, std::int64_t n_some) {
      take(std::span<const T>(values).first(static_cast<std::size_t>(n_some)));
    });
  }

  template <class T>
  static std::vector<T> read(const PatchInFile& p, RowPlace PatchRows::*rows, std::int64_t first, std::int64_t n) {
    const RowPlace& place = p.file->rows().*rows;
    std::vector<T> values = p.file->row_reader().read<T>(place, first, n);
    if constexpr (!std::is_same_v<T, std::int32_t> && !std::is_same_v<T, Triangle>)
      require_finite(p.file->reader(), place.name, values);
    return values;
  }

  template <class T, class Take>
  void take_inner(std::size_t i, RowPlace PatchRows::*rows, const Take& take) const {
    const PatchInFile& p = patches_[i];
    const std::vector<std::uint8_t> is_used =
        order_.has_unused[i] ? used_nodes(p.file->shape(p.patch)) : std::vector<std::uint8_t>();
    const std::size_t first_inner = is_used.empty() ? 0 : is_used.size() - p.file->n_inner(p.patch);
    in_pieces(p.file->n_inner(p.patch), [&](std::int64_t begin, std::int64_t n) {
      std::vector<T> values = read<T>(p, rows, p.file->inner_begin(p.patch) + begin, n);
      if (!is_used.empty()) {
        std::size_t kept = 0;
        for (std::size_t k = 0; k < values.size(); ++k)
          if (is_used[first_inner + begin + k]) values[kept++] = values[k];
        values.resize(kept);
      }
      take(values);
    });
  }

  template <class Take>
  void take_corner_uv(std::size_t i, const Take& take) const {
    const PatchInFile& p = patches_[i];
    const FacePatch patch = p.file->corners(p.patch);
    in_pieces(p.file->n_triangles(p.patch), [&](std::int64_t begin, std::int64_t n) {
      std::vector<Vec2> uv = corner_uvs(patch, static_cast<std::size_t>(begin), static_cast<std::size_t>(begin + n));
      for (std::size_t c = 0; order_.is_turned[i] && c < uv.size(); c += 3) std::swap(uv[c + 1], uv[c + 2]);
      take(uv);
    });
  }

  /// Node of the mesh for each of the patch; of those inside only where some are left out.
  std::vector<NodeId> numbers(std::size_t i) const {
    const PatchInFile& p = patches_[i];
    const FacePatch shape = order_.has_unused[i] ? p.file->shape(p.patch) : p.file->boundary(p.patch);
    return order_.numbers.of_patch(input_.edges, shape, i);
  }

  template <class Take>
  void take_triangles(std::size_t i, const Take& take) const {
    const PatchInFile& p = patches_[i];
    const std::vector<NodeId> number = numbers(i);
    const auto n_known = static_cast<NodeId>(number.size());
    const NodeId shift = order_.numbers.inner_begin[i] - n_known;
    in_pieces(p.file->n_triangles(p.patch), [&](std::int64_t begin, std::int64_t n) {
      std::vector<Triangle> triangles =
          read<Triangle>(p, &PatchRows::nodes, p.file->triangle_begin(p.patch) + begin, n);
      for (Triangle& t : triangles) {
        for (NodeId& node : t.n) node = node < n_known ? number[node] : node + shift;
        if (order_.is_turned[i]) std::swap(t.n[1], t.n[2]);
      }
      take(triangles);
    });
  }

  const std::vector<PatchInFile>& patches_;
  const MergeInput input_;
  const MergeOrder& order_;
};

}  // namespace

std::vector<PatchInFile> patches_of(const std::vector<std::unique_ptr<PatchesFile>>& files) {
  std::vector<PatchInFile> all;
  for (const auto& file : files)
    for (std::size_t i = 0; i < file->n_patches(); ++i) all.push_back({file.get(), i});
  std::stable_sort(all.begin(), all.end(),
                   [](const PatchInFile& a, const PatchInFile& b) { return a.face() < b.face(); });
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i].face() != all[i - 1].face()) continue;
    if (all[i].file == all[i - 1].file) all[i].file->reader().fail("/st/patch/face", "names a face twice");
    throw Error(ExitCode::kMismatch, fmt::format("face {} is in {} and in an earlier patches file; mesh each face once",
                                                 all[i].face() + 1, all[i].file->path()));
  }
  return all;
}

PatchSource source_of(const std::vector<PatchInFile>& patches) {
  PatchSource source;
  for (const PatchInFile& p : patches) {
    source.face.push_back(p.face());
    source.n_triangles.push_back(p.file->n_triangles(p.patch));
  }
  source.shape = [&patches](std::size_t i) { return patches[i].file->shape(patches[i].patch); };
  return source;
}

MeshColumns merged_columns(const std::vector<PatchInFile>& patches, const MergeInput& input, const MergeOrder& order,
                           const CadPlaces* cad) {
  const auto rows = std::make_shared<const MergedRows>(patches, input, order);
  const SurfaceMesh& head = order.boundary;
  const auto group_of = [groups = input.face_group](FaceId f) {
    return static_cast<std::size_t>(f) < groups.size() ? groups[f] : 0;
  };
  const auto keep = [rows]<class T>(Column<T> column) {  // the rows live as long as the columns
    return Column<T>{column.n_rows, [rows, give = std::move(column.give)](const auto& take) { give(take); }};
  };
  MeshColumns c;
  c.node_xyz = keep(rows->of_nodes(head.node_xyz, &PatchRows::inner_xyz));
  c.node_entity_dim = keep(
      rows->of_face_nodes(head.node_entity_dim, [](FaceId) { return static_cast<std::uint8_t>(EntityDim::kFace); }));
  c.node_entity = keep(rows->of_face_nodes(head.node_entity, [](FaceId f) { return f; }));
  c.node_t = keep(rows->of_face_nodes(head.node_t, [](FaceId) { return 0.0; }));
  c.node_size = keep(rows->of_nodes(head.node_size, &PatchRows::inner_size));
  c.triangles = keep(rows->triangles());
  c.triangle_face = keep(rows->of_faces<FaceId>([](FaceId f) { return f; }));
  c.triangle_group = keep(rows->of_faces<std::int32_t>(group_of));
  c.corner_uv = keep(rows->corner_uv());
  if (cad) {
    c.triangle_cad_face = keep(rows->cad_faces(*cad));
    c.node_cad_face = keep(rows->of_cad<FaceId>(*cad, kNone, [](const CadPlace& p) { return p.face; }));
    c.node_cad_uv = keep(rows->of_cad<Vec2>(*cad, Vec2{}, [](const CadPlace& p) { return p.uv; }));
  }
  if (input.edges.node_previous.empty()) return c;
  c.node_previous = keep(rows->of_nodes(head.node_previous, &PatchRows::inner_previous));
  c.triangle_previous = keep(rows->of_triangles<TriangleId>(&PatchRows::triangle_previous));
  return c;
}

void add_cad_places(const CadPlaces& cad, MeshArtifact& artifact) {
  const SurfaceMesh& m = artifact.mesh;
  artifact.node_cad_face.assign(m.node_xyz.size(), kNone);
  artifact.node_cad_uv.assign(m.node_xyz.size(), Vec2{});
  std::vector<std::vector<NodeId>> nodes(m.labels.face_name.size());
  std::vector<std::vector<Vec2>> uv(nodes.size());
  for (std::size_t first = 0, end; first < m.triangles.size(); first = end) {
    const FaceId face = m.triangle_face[first];
    for (end = first + 1; end < m.triangles.size() && m.triangle_face[end] == face;) ++end;
    const auto corners = std::span(m.corner_uv).subspan(3 * first, 3 * (end - first));
    for (const CadPlace& p : cad.on(face, middles(corners))) artifact.triangle_cad_face.push_back(p.face);
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const NodeId n = m.triangles[first + c / 3].n[c % 3];
      if (m.node_entity_dim[n] != static_cast<std::uint8_t>(EntityDim::kFace) || artifact.node_cad_face[n] != kNone)
        continue;
      artifact.node_cad_face[n] = face;  // once; of the CAD below
      nodes[static_cast<std::size_t>(face)].push_back(n);
      uv[static_cast<std::size_t>(face)].push_back(corners[c]);
    }
  }
  for (std::size_t f = 0; f < nodes.size(); ++f) {
    const std::vector<CadPlace> places = cad.on(static_cast<FaceId>(f), uv[f]);
    for (std::size_t i = 0; i < places.size(); ++i) {
      artifact.node_cad_face[nodes[f][i]] = places[i].face;
      artifact.node_cad_uv[nodes[f][i]] = places[i].uv;
    }
  }
}

}  // namespace st
