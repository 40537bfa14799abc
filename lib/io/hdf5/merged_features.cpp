#include "io/hdf5/merged_features.h"

#include "io/hdf5/columns.h"

namespace st {
namespace {

/// Rows of the rotation, then the translation.
void write_pairs(Hdf5Writer& w, const std::vector<FacePair>& pairs) {
  if (pairs.empty()) return;
  std::vector<std::int32_t> a, b;
  std::vector<Vec3> motion;
  for (const FacePair& p : pairs) {
    a.push_back(p.a);
    b.push_back(p.b);
    motion.insert(motion.end(), p.motion.rotation.begin(), p.motion.rotation.end());
    motion.push_back(p.motion.translation);
  }
  w.write("/st/pair/a", a);
  w.write("/st/pair/b", b);
  w.write("/st/pair/motion", motion);
}

std::vector<FacePair> read_pairs(const Hdf5Reader& r, std::size_t n_faces) {
  std::vector<FacePair> pairs;
  if (!r.has("/st/pair/a")) return pairs;
  const auto a = r.read<std::int32_t>("/st/pair/a");
  const auto b = r.read_rows<std::int32_t>("/st/pair/b", a.size());
  const auto motion = r.read_rows<Vec3>("/st/pair/motion", 4 * a.size());
  require_ids(r, "/st/pair/a", a, n_faces);
  require_ids(r, "/st/pair/b", b, n_faces);
  require_finite(r, "/st/pair/motion", motion);
  for (std::size_t i = 0; i < a.size(); ++i)
    pairs.push_back({a[i], b[i], {{motion[4 * i], motion[4 * i + 1], motion[4 * i + 2]}, 1, motion[4 * i + 3]}});
  return pairs;
}

template <class Io, class Features>
void visit_merged(const Io& io, Features& m, std::size_t n_edges, std::size_t n_faces) {
  io("/st/merged/edge", m.edge, {}, ids_below(n_edges));
  io("/st/merged/strip_face", m.strip_face, {}, ids_below(n_faces));
  io("/st/merged/strip_kept", m.strip_kept, {m.strip_face.size()}, ids_below(n_edges));
  io("/st/merged/strip_closed", m.strip_closed, {m.strip_face.size()}, ids_below(n_edges));
  io("/st/merged/strip_is_opposed", m.strip_is_opposed, {m.strip_face.size()});
}

}  // namespace

void write_merged(Hdf5Writer& w, const MergedFeatures& m) {
  write_pairs(w, m.pairs);
  if (!m.empty()) visit_merged(WrittenColumns{w}, m, 0, 0);
}

MergedFeatures read_merged(const Hdf5Reader& r, std::size_t n_edges, std::size_t n_faces) {
  MergedFeatures m;
  m.pairs = read_pairs(r, n_faces);
  if (r.has("/st/merged/edge")) visit_merged(ReadColumns{r}, m, n_edges, n_faces);
  return m;
}

}  // namespace st
