#include "geometry/import/mirror_image.h"

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Ax2.hxx>
#include <gp_Trsf.hxx>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <tuple>

#include "base/axis.h"
#include "base/box_tree.h"
#include "base/error.h"
#include "geometry/brep/compound.h"
#include "geometry/brep/occt_evaluators.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/import/face_probe.h"
#include "geometry/import/placed_copy.h"
#include "geometry/import/plane_cut.h"
#include "geometry/shape/projection.h"

namespace st::occt {
namespace {

constexpr double kSymmetric = 1e-5;         // of the diagonal: an image is no further from the faces on the other side
constexpr std::size_t kSamples = 16;        // of a face, about
constexpr std::size_t kMostNamed = 4;       // faces in a message
constexpr double kSameBox = 0.01;           // of its diagonal: the boxes of a face and of its image
constexpr double kEdgeShares[] = {.3, .8};  // where edges are sampled
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TopoDS_Shape forward(const TopoDS_Shape& shape) { return shape.Oriented(TopAbs_FORWARD); }

gp_Trsf reflection_at(const SymmetryPlane& plane) {
  gp_XYZ origin(0, 0, 0), normal(0, 0, 0);
  origin.SetCoord(plane.axis + 1, plane.value);
  normal.SetCoord(plane.axis + 1, 1);
  gp_Trsf trsf;
  trsf.SetMirror(gp_Ax2(gp_Pnt(origin), gp_Dir(normal)));
  return trsf;
}

std::vector<Vec3> samples_of(const TopoDS_Shape& face, FaceProbe& probe) {
  const std::vector<Vec3> all = probe.samples();
  std::vector<Vec3> some;
  for (std::size_t i = 0; i < all.size(); i += std::max<std::size_t>(1, all.size() / kSamples)) some.push_back(all[i]);
  for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
    double t0, t1;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(TopoDS::Edge(e.Current()), t0, t1);
    for (const double share : kEdgeShares)
      if (!curve.IsNull()) some.push_back(vec(curve->Value(t0 + share * (t1 - t0))));
  }
  return some;
}

/// A face's samples, mirrored, against the faces of the other side.
struct Match {
  std::map<int, int> votes = {};  ///< by 1-based face: how many are within the tolerance, or nearest to no other
  double distance = 0;            ///< the largest
  Vec3 place;                     ///< there, on the face itself
};

class Mirroring {
 public:
  Mirroring(ImportedShape& model, const SymmetryPlane& plane, double diagonal, const std::string& path)
      : model_(model),
        plane_(plane),
        tolerance_(kSymmetric * diagonal),
        path_(path),
        probes_(model.faces.Extent() + 1),
        copy_(reflection_at(plane)) {
    reflection_.axis = plane.axis;
    reflection_.value = plane.value;
    boxes_.emplace_back();
    for (int f = 1; f <= model.faces.Extent(); ++f) boxes_.push_back(rough_box(model.faces(f)));
    tree_ = BoxTree(std::span(boxes_).subspan(1));
  }

  MirrorShapes run(std::vector<ImportFinding>& findings) {
    find_sides();
    find_partners();
    share_what_is_in_the_plane();
    const ImportedShape before = model_;
    put_images();
    name_edges(before);
    findings.push_back(
        {FindingKind::kMirrored, "", worst_.place, worst_.distance, true,
         std::to_string(shapes_.faces.size()) + " faces, moved by up to " + format_number(worst_.distance)});
    return std::move(shapes_);
  }

 private:
  PlaneSide kept() const { return plane_.side < 0 ? PlaneSide::kBelow : PlaneSide::kAbove; }
  PlaneSide other() const { return plane_.side < 0 ? PlaneSide::kAbove : PlaneSide::kBelow; }
  int n_faces() const { return model_.faces.Extent(); }
  PlaneSide side(int f) const { return sides_[f - 1]; }
  TopoDS_Shape face(int f) const { return forward(model_.faces(f)); }
  FaceProbe& probe(int f) {
    if (!probes_[f]) probes_[f] = std::make_unique<FaceProbe>(TopoDS::Face(face(f)), tolerance_);
    return *probes_[f];
  }

  /// A face in the plane is on the side of its shells, where they are on one.
  void find_sides() {
    sides_ = sides_of(model_, plane_, tolerance_);
    std::map<int, std::vector<PlaneSide>> around;  // by face in the plane
    for (TopExp_Explorer s(model_.shape, TopAbs_SHELL); s.More(); s.Next()) {
      std::vector<PlaneSide> own;
      for (TopExp_Explorer f(s.Current(), TopAbs_FACE); f.More(); f.Next())
        own.push_back(side(model_.faces.FindIndex(f.Current())));
      for (TopExp_Explorer f(s.Current(), TopAbs_FACE); f.More(); f.Next())
        if (const int i = model_.faces.FindIndex(f.Current()); side(i) == PlaneSide::kIn)
          around[i].insert(around[i].end(), own.begin(), own.end());
    }
    for (auto& [f, own] : around) {
      std::erase(own, PlaneSide::kIn);
      if (!own.empty() && std::equal(own.begin() + 1, own.end(), own.begin())) sides_[f - 1] = own.front();
    }
    for (const PlaneSide needed : {kept(), other()})
      if (std::find(sides_.begin(), sides_.end(), needed) == sides_.end())
        throw Error(ExitCode::kGeometry, path_ +
                                             ": --mirror: the model is on one side of the plane only; give a whole "
                                             "model, or mesh the half alone");
  }

  Match match(int f, PlaneSide on) {
    Match result;
    for (const Vec3 x : samples_of(face(f), probe(f))) {
      const double distance = vote(reflection_.image_of(x), on, result.votes);
      if (distance > result.distance) result.distance = distance, result.place = x;
    }
    return result;
  }

  /// Distance of the nearest face. Those within the tolerance get a vote each, or the nearest does.
  double vote(Vec3 p, PlaneSide on, std::map<int, int>& votes) {
    std::pair<double, int> best{kInfinity, 0};
    for (const bool is_near : {true, false}) {
      const auto matters = [&](std::int32_t, double d2) {
        return d2 <= (is_near ? tolerance_ * tolerance_ : best.first * best.first);
      };
      tree_.visit_near(p, matters, [&](std::int32_t i) {
        const double d2 = distance2(p, boxes_[i + 1]);
        if (side(i + 1) != on || !matters(i, d2) || (!is_near && d2 <= tolerance_ * tolerance_)) return;
        const double d = probe(i + 1).distance_to(p);
        if (d <= tolerance_) ++votes[i + 1];
        best = std::min(best, {d, i + 1});
      });
      if (best.first <= tolerance_) return best.first;
    }
    ++votes[best.second];
    return best.first;
  }

  /// Of faces on each other, as of bodies that touch, the one that looks the same way and has the same box.
  int choose(int f, const std::map<int, int>& votes, const std::vector<char>& is_taken) {
    if (votes.size() == 1) return votes.begin()->first;
    const Box3& own = boxes_[f];
    const std::vector<Vec3> at = samples_of(face(f), probe(f));
    const Vec3 normal = reflection_.image_of_direction(outward(f, at.front()));
    std::pair<std::tuple<int, bool, bool, bool>, int> best{{}, 0};
    for (const auto& [k, n] : votes) {
      const double off = distance(reflection_.image_of(own.center()), boxes_[k].center()) +
                         std::abs(own.diagonal() - boxes_[k].diagonal());
      const bool is_away = dot(normal, outward(k, reflection_.image_of(at.front()))) < 0;
      const std::pair now{std::tuple(-n, is_away, off > kSameBox * own.diagonal(), is_taken[k] != 0), k};
      if (best.second == 0 || now < best) best = now;
    }
    return best.second;
  }

  Vec3 outward(int f, Vec3 x) {
    return (model_.faces(f).Orientation() == TopAbs_REVERSED ? -1.0 : 1.0) * probe(f).normal_at(x);
  }

  void find_partners() {
    partner_.assign(n_faces() + 1, 0);
    std::vector<std::pair<double, int>> off;
    std::vector<Match> matches(n_faces() + 1);
    std::vector<char> is_taken(n_faces() + 1, 0);
    for (int f = 1; f <= n_faces(); ++f) {
      if (side(f) == PlaneSide::kIn) continue;
      const Match& m = matches[f] = match(f, side(f) == kept() ? other() : kept());
      if (side(f) == kept()) is_taken[partner_[f] = choose(f, m.votes, is_taken)] = 1;
      if (m.distance > worst_.distance) worst_ = m;
      if (m.distance > tolerance_) off.push_back({-m.distance, f});
    }
    std::sort(off.begin(), off.end());
    if (off.empty()) {
      const std::set<int> found = found_faces();
      for (int f = 1; f <= n_faces(); ++f)
        if (side(f) == other() && !found.contains(f)) off.push_back({0, f});
    }
    if (!off.empty()) refuse(off, matches);
  }

  /// Of partners, and of the faces of the file that these are parts of.
  std::set<int> found_faces() const {
    std::set<int> files, found;
    for (const int p : partner_)
      if (p > 0) found.insert(p), files.insert(model_.attributes[p - 1].file_face);
    for (int f = 1; f <= n_faces(); ++f)
      if (const int file = model_.attributes[f - 1].file_face; file != kNone && files.contains(file)) found.insert(f);
    return found;
  }

  [[noreturn]] void refuse(const std::vector<std::pair<double, int>>& off, const std::vector<Match>& matches) const {
    const char axis = static_cast<char>('x' + plane_.axis);
    std::string text = path_ + ": not symmetric about " + axis + " = " + format_number(plane_.value) + " within " +
                       format_number(tolerance_) + ": " + std::to_string(off.size()) +
                       (off.size() == 1 ? " face has no image: " : " faces have no image: ");
    for (std::size_t k = 0; k < std::min(off.size(), kMostNamed); ++k) {
      const int f = off[k].second;
      const std::string& name = model_.attributes[f - 1].name;
      const Vec3 x = matches[f].distance > 0 ? matches[f].place : boxes_[f].center();
      text += (k > 0 ? "; " : "") + model_.file_label(f) + (name.empty() ? "" : " \"" + name + "\"");
      if (matches[f].distance > tolerance_ && matches[f].distance < kInfinity)
        text += ", off by " + format_number(matches[f].distance);
      text += " near (" + format_number(x.x) + ", " + format_number(x.y) + ", " + format_number(x.z) + ")";
    }
    throw Error(ExitCode::kGeometry, text + (off.size() > kMostNamed ? " ..." : "") +
                                         "; mesh it without --mirror, or mend it in the CAD system");
  }

  /// Edges and vertices of both sides, or of one and a face in the plane, are their own images.
  void share_what_is_in_the_plane() {
    for (const TopAbs_ShapeEnum kind : {TopAbs_EDGE, TopAbs_VERTEX}) {
      TopTools_IndexedDataMapOfShapeListOfShape faces_of;
      TopExp::MapShapesAndUniqueAncestors(model_.shape, kind, TopAbs_FACE, faces_of);
      for (int i = 1; i <= faces_of.Extent(); ++i) {
        bool is_kept = false, is_elsewhere = false, is_in = true;
        for (const TopoDS_Shape& f : faces_of(i)) {
          const PlaneSide own = side(model_.faces.FindIndex(f));
          is_kept |= own == kept();
          is_elsewhere |= own != kept();
          is_in &= own == PlaneSide::kIn;
        }
        if ((is_kept && is_elsewhere) || is_in) share(faces_of.FindKey(i));
      }
    }
  }

  /// A pole is one of each face; its vertex is shared.
  void share(const TopoDS_Shape& part) {
    const BRep_Builder builder;
    double off = 0;
    if (part.ShapeType() == TopAbs_VERTEX) {
      const TopoDS_Vertex vertex = TopoDS::Vertex(part);
      off = std::abs(component(vec(BRep_Tool::Pnt(vertex)), plane_.axis) - plane_.value);
      builder.UpdateVertex(vertex, BRep_Tool::Tolerance(vertex) + 2 * off);
    } else {
      const TopoDS_Edge edge = TopoDS::Edge(part);
      if (!BRep_Tool::Degenerated(edge) && !lies_in(edge, plane_, tolerance_)) off = kInfinity;
    }
    if (off > tolerance_) {
      const Vec3 x = rough_box(part).center();
      throw Error(ExitCode::kGeometry, path_ + ": --mirror: faces of both sides meet away from the plane, near (" +
                                           format_number(x.x) + ", " + format_number(x.y) + ", " + format_number(x.z) +
                                           "); mesh it without --mirror, or mend it in the CAD system");
    }
    copy_.keep(part);
  }

  /// The image of a kept face as it stands for its partner oriented forward.
  TopoDS_Shape image_for(int f, int partner) {
    const TopoDS_Shape image = copy_.of(face(f));  // turned over
    const std::vector<Vec3> at = probe(f).samples();
    const Vec3 x = at.empty() ? samples_of(face(f), probe(f)).front() : at[at.size() / 2];
    const Vec3 normal = reflection_.image_of_direction(probe(f).normal_at(x));
    const bool is_turned = dot(normal, probe(partner).normal_at(reflection_.image_of(x))) < 0;
    return is_turned ? image.Reversed() : image;
  }

  void put_images() {
    std::vector<std::vector<TopoDS_Shape>> images(n_faces() + 1);
    for (int f = 1; f <= n_faces(); ++f) {
      if (side(f) != other()) images[f].push_back(face(f));
      if (side(f) == PlaneSide::kIn) shapes_.faces.emplace_back(face(f), face(f));
      if (side(f) != kept()) continue;
      images[partner_[f]].push_back(image_for(f, partner_[f]));
      shapes_.faces.emplace_back(face(f), forward(images[partner_[f]].back()));
    }
    shapes_.plane = plane_;
    for (const auto& [kind, pairs] :
         {std::pair{TopAbs_EDGE, &shapes_.edges}, std::pair{TopAbs_VERTEX, &shapes_.vertices}}) {
      TopTools_IndexedMapOfShape parts;
      for (const auto& [own, image] : shapes_.faces) TopExp::MapShapes(own, kind, parts);
      for (int i = 1; i <= parts.Extent(); ++i) pairs->emplace_back(forward(parts(i)), forward(copy_.of(parts(i))));
    }
    const auto of = [&](const TopoDS_Shape& f) { return images[model_.faces.FindIndex(f)]; };
    const TopoDS_Shape whole = with_faces(model_.shape, of);
    ImportedShape mirrored = model_;
    mirrored.replace(whole, [&](const TopoDS_Shape& f) { return TopoDS_Shape(compound_of(of(f))); });
    model_ = std::move(mirrored);
  }

  /// Names of edges of the other half go to the images that lie there.
  void name_edges(const ImportedShape& before) {
    TopTools_IndexedMapOfShape there;
    TopExp::MapShapes(model_.shape, TopAbs_EDGE, there);
    model_.edge_names.clear();
    std::vector<Box3> boxes;
    for (const auto& [own, image] : shapes_.edges) boxes.push_back(rough_box(image));
    const BoxTree near(boxes);
    for (const auto& [edge, name] : before.edge_names) {
      double t0, t1;
      const Handle(Geom_Curve) curve = BRep_Tool::Curve(TopoDS::Edge(edge), t0, t1);
      if (there.Contains(edge)) {
        model_.edge_names.emplace_back(edge, name);
      } else if (!curve.IsNull()) {
        if (const TopoDS_Shape image = image_near(vec(curve->Value(0.5 * (t0 + t1))), near); !image.IsNull())
          model_.edge_names.emplace_back(image, name);
      }
    }
  }

  /// The first image of an edge at x. `near`: over the images.
  TopoDS_Shape image_near(Vec3 x, const BoxTree& near) const {
    std::size_t first = shapes_.edges.size();
    const auto matters = [&](std::int32_t, double d2) { return d2 <= tolerance_ * tolerance_; };
    near.visit_near(x, matters, [&](std::int32_t i) {
      const auto& [own, image] = shapes_.edges[static_cast<std::size_t>(i)];
      if (image.IsSame(own) || static_cast<std::size_t>(i) > first) return;
      double t0, t1;
      const Handle(Geom_Curve) curve = BRep_Tool::Curve(TopoDS::Edge(image), t0, t1);
      if (!curve.IsNull() && closest_point(*make_curve(curve, t0, t1), x).distance <= tolerance_)
        first = static_cast<std::size_t>(i);
    });
    return first < shapes_.edges.size() ? shapes_.edges[first].second : TopoDS_Shape();
  }

  ImportedShape& model_;
  SymmetryPlane plane_;
  double tolerance_;
  const std::string& path_;
  Mirror reflection_;                               // the plane alone
  std::vector<Box3> boxes_;                         // by 1-based face
  BoxTree tree_;                                    // of these, by face from 0
  std::vector<std::unique_ptr<FaceProbe>> probes_;  // by 1-based face, made when first asked
  std::vector<PlaneSide> sides_;
  std::vector<int> partner_;  // of kept faces, 1-based
  Match worst_;
  PlacedCopy copy_;
  MirrorShapes shapes_;
};

/// Partners by number; false where one of them is not there.
bool fill(const std::vector<std::pair<TopoDS_Shape, TopoDS_Shape>>& pairs, const TopoDS_Shape& shape,
          TopAbs_ShapeEnum kind, std::vector<std::int32_t>& partner) {
  TopTools_IndexedMapOfShape numbers;
  TopExp::MapShapes(shape, kind, numbers);
  partner.assign(numbers.Extent(), kNone);
  for (const auto& [own, image] : pairs) {
    const int a = numbers.FindIndex(own), b = numbers.FindIndex(image);
    if (a == 0 || b == 0) return false;
    partner[a - 1] = b - 1;
    partner[b - 1] = a - 1;
  }
  return std::count(partner.begin(), partner.end(), kNone) == 0;
}

}  // namespace

Mirror MirrorShapes::numbers_in(const TopoDS_Shape& shape, const std::string& path) const {
  Mirror mirror;
  mirror.axis = plane.axis;
  mirror.value = plane.value;
  if (!fill(faces, shape, TopAbs_FACE, mirror.face) || !fill(edges, shape, TopAbs_EDGE, mirror.edge) ||
      !fill(vertices, shape, TopAbs_VERTEX, mirror.vertex))
    throw Error(ExitCode::kGeometry, path +
                                         ": --mirror: repairs changed one half and not the other; mesh it without, "
                                         "or mend the model in the CAD system");
  mirror.face_is_image.assign(mirror.face.size(), 0);
  TopTools_IndexedMapOfShape numbers;
  TopExp::MapShapes(shape, TopAbs_FACE, numbers);
  for (const auto& [own, image] : faces)
    if (!own.IsSame(image)) mirror.face_is_image[numbers.FindIndex(image) - 1] = 1;
  return mirror;
}

MirrorShapes mirror_half(ImportedShape& model, SymmetryPlane plane, double diagonal,
                         std::vector<ImportFinding>& findings, const std::string& path) {
  return Mirroring(model, plane, diagonal, path).run(findings);
}

}  // namespace st::occt
