#include "io/hdf5/merged_features.h"

#include "io/hdf5/artifact_checks.h"

namespace st {

void write_merged(Hdf5Writer& w, const MergedFeatures& m) {
  if (m.empty()) return;
  w.write("/st/merged/edge", m.edge);
  w.write("/st/merged/strip_face", m.strip_face);
  w.write("/st/merged/strip_kept", m.strip_kept);
  w.write("/st/merged/strip_closed", m.strip_closed);
  w.write("/st/merged/strip_is_opposed", m.strip_is_opposed);
}

MergedFeatures read_merged(const Hdf5Reader& r, std::size_t n_edges, std::size_t n_faces) {
  MergedFeatures m;
  if (!r.has("/st/merged/edge")) return m;
  m.edge = r.read<std::int32_t>("/st/merged/edge");
  m.strip_face = r.read<std::int32_t>("/st/merged/strip_face");
  m.strip_kept = r.read_rows<std::int32_t>("/st/merged/strip_kept", m.strip_face.size());
  m.strip_closed = r.read_rows<std::int32_t>("/st/merged/strip_closed", m.strip_face.size());
  m.strip_is_opposed = r.read_rows<std::uint8_t>("/st/merged/strip_is_opposed", m.strip_face.size());
  require_ids(r, "/st/merged/edge", m.edge, n_edges);
  require_ids(r, "/st/merged/strip_face", m.strip_face, n_faces);
  require_ids(r, "/st/merged/strip_kept", m.strip_kept, n_edges);
  require_ids(r, "/st/merged/strip_closed", m.strip_closed, n_edges);
  return m;
}

}  // namespace st
