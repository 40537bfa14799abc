#include "sizing/wing_record.h"

#include <algorithm>

#include "base/sort_once.h"
#include "sizing/wing_sizes.h"

namespace st {

WingRecord moved(const Similarity& frame, WingRecord wing) {
  for (WingRecord::Station& s : wing.stations) {
    s.nose = frame(s.nose);
    s.trailing = frame(s.trailing);
    s.chord *= frame.scale;
    s.asked *= frame.scale;
  }
  wing.span *= frame.scale;
  return wing;
}

WingRecord record_wing(const LiftingSurface& wing, const WingSizes& sizes, std::span<const std::uint8_t> is_left_out,
                       std::span<const Strip> strips) {
  WingRecord record;
  record.span = wing.span;
  record.has_noses = wing.has_noses;
  record.covered = wing.covered();
  record.faces = wing.faces;
  for (const ChordEdge& edge : wing.edges()) {
    record.edges.push_back(edge.edge);
    if (edge.base != kNone) record.bases.push_back(edge.base);
    for (const Strip& strip : strips)
      if (edge.base != kNone && strip.face == edge.base)
        record.bases.insert(record.bases.end(), strip.others.begin(), strip.others.end());
    if (edge.base != kNone && !is_left_out[edge.edge]) record.base_cells = (edge.is_half ? 0.5 : 1) * sizes.base_cells;
    for (const ChordStation& s : edge.stations) {
      if (wing.has_noses && !s.is_measured) continue;
      WingRecord::Station own{s.nose, s.trailing, s.chord};
      if (edge.is_inside || !is_left_out[edge.edge]) own.asked = length_along(wing, sizes, edge, s.chord);
      record.stations.push_back(own);
    }
  }
  for (const ChordEdge& front : wing.front)
    for (const ChordStation& s : front.stations) {
      record.stations.push_back({s.nose, s.nose, s.chord, length_along(wing, sizes, front, s.chord)});
      record.faces.push_back(s.nose_face);
    }
  sort_once(record.faces);
  sort_once(record.bases);
  std::erase_if(record.faces, [&](FaceId f) { return std::ranges::binary_search(record.bases, f); });
  return record;
}

}  // namespace st
