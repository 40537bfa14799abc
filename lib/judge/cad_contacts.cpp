#include "judge/cad_contacts.h"

#include <algorithm>

namespace st {
namespace {

double distance_to(const FaceContact& contact, Vec3 p) {
  double nearest = distance(p, contact.points.front());
  for (std::size_t k = 1; k < contact.points.size(); ++k)
    nearest = std::min(nearest, segment_distance(p, contact.points[k - 1], contact.points[k]));
  return nearest;
}

}  // namespace

const std::vector<FaceContact>& CadContacts::contacts(FaceId a, FaceId b) {
  static const std::vector<FaceContact> kNoContact;
  const auto key = std::minmax(a, b);
  const auto known = found_.find(key);
  if (known != found_.end()) return known->second;
  if (found_.size() >= kMaxFacePairs) return kNoContact;
  return found_.emplace(key, model_.contacts(key.first, key.second)).first->second;
}

bool CadContacts::is_near(const TrianglePair& pair, bool passes_through) {
  if (!model_.facets().empty()) return passes_through && is_near_facets(pair);
  const FaceId a = mesh_.triangle_face[pair.a], b = mesh_.triangle_face[pair.b];
  if (a == b) return false;
  double reach = 0;
  Vec3 middle{0, 0, 0};
  for (const TriangleId t : {pair.a, pair.b})
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = mesh_.node_xyz[mesh_.triangles[t].n[k]], q = mesh_.node_xyz[mesh_.triangles[t].n[(k + 1) % 3]];
      reach = std::max(reach, distance(p, q));
      middle = middle + p / 6;
    }
  const std::vector<FaceContact>& all = contacts(a, b);
  return std::any_of(all.begin(), all.end(), [&](const FaceContact& c) {
    return c.passes_through == passes_through && distance_to(c, middle) <= reach;
  });
}

bool CadContacts::is_near_facets(const TrianglePair& pair) {
  if (!of_facets_) of_facets_ = std::make_unique<FacetCrossings>(model_.facets());
  double reach = 0;
  Box3 box;
  for (const TriangleId t : {pair.a, pair.b})
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = mesh_.node_xyz[mesh_.triangles[t].n[k]], q = mesh_.node_xyz[mesh_.triangles[t].n[(k + 1) % 3]];
      reach = std::max(reach, distance(p, q));
      box.add(p);
    }
  return of_facets_->is_near(box.center(), reach);
}

bool CadContacts::touches(const TrianglePair& pair) { return is_near(pair, false); }
bool CadContacts::crosses(const TrianglePair& pair) { return is_near(pair, true); }

}  // namespace st
