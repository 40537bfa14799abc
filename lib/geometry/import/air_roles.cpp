#include "geometry/import/air_roles.h"

#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "geometry/brep/compound.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/import/air_pieces.h"
#include "geometry/model/edge_faces.h"

namespace st {

std::string AirFaces::in_words() const {
  const auto count = [](int n, const char* what) {
    return std::to_string(n) + (n == 1 ? " face is " : " faces are ") + what;
  };
  std::string text = count(n_farfield, "farfield");
  if (n_symmetry > 0) text += ", " + count(n_symmetry, "symmetry");
  if (n_interface > 0) text += ", " + count(n_interface, "interface, with air on both sides");
  return text;
}

namespace occt {
namespace {

constexpr double kAlongAxis = 1e-6;  // of a plane's normal from an axis of space

using Roles = std::array<std::pair<const char*, std::vector<FaceId>*>, 3>;

Roles roles_of(OwnAir& air) {
  return {{{"farfield", &air.farfield}, {"symmetry", &air.symmetry}, {"interface", &air.interface}}};
}

OwnAir named_air(const ModelTables& t) {
  OwnAir air;
  for (FaceId f = 0; f < t.n_faces(); ++f)
    for (auto& [role, faces] : roles_of(air))
      if (t.labels.group_role[t.labels.face_group[f]] == role) faces->push_back(f);
  if (air.farfield.empty() || air.farfield.size() + air.symmetry.size() == static_cast<std::size_t>(t.n_faces()))
    return {};
  return air;
}

void give_roles(ImportedShape& model, OwnAir& air) {
  for (const auto& [role, faces] : roles_of(air))
    for (const FaceId f : *faces) {
      FaceAttributes& a = model.attributes[f];
      a.role = role;
      if (a.name.empty()) a.name = role;
    }
}

/// Far field and planes have no free edge.
bool is_closed(const ModelTables& t, const OwnAir& air) {
  const EdgeFaces faces_at(t);
  return std::none_of(air.farfield.begin(), air.farfield.end(), [&](FaceId f) {
    const auto edges = t.edges_of(f);
    return std::any_of(edges.begin(), edges.end(),
                       [&](EdgeId e) { return faces_at[e].size() < 2 && !t.edge_is_degenerate[e]; });
  });
}

/// "box:20".
std::string in_words(const FarField& far) {
  return (far.kind == FarField::Kind::kBox ? "box:" : "sphere:") + format_number(far.size);
}

void require_wanted(const ModelTables& t, const FileAir& air, const AskedAir& asked, const std::string& path) {
  if (!air.faces.is_found()) {
    if (asked.replaces)
      throw Error(ExitCode::kUsage, path +
                                        ": the file has no far field to replace; use --farfield, or --flow-domain yes "
                                        "if it is the air around a body");
    return;
  }
  if (asked.replaces) return;
  const std::string found = path + ": the file has its own air: " + counts_of(air).in_words();
  const std::string otherwise = air.is_by_shape ? "; --flow-domain no takes all faces as walls" : "";
  if (asked.far)
    throw Error(ExitCode::kUsage, found + "; leave out --farfield to keep this domain, or use --replace-farfield " +
                                      in_words(*asked.far) + " to replace or enlarge it" + otherwise);
  if (asked.plane && air.is_by_shape && is_closed(t, air.faces))
    throw Error(ExitCode::kUsage,
                found +
                    "; leave out --symmetry to keep this domain, or give --replace-farfield box:20 as "
                    "well to cut the body and replace the domain" +
                    otherwise);
}

/// Of a face that is left, whether it belongs to a body of its own.
TopTools_IndexedMapOfShape faces_of_bodies(const ImportedShape& model, const TopTools_IndexedMapOfShape& gone,
                                           std::vector<TopoDS_Shape>& bodies) {
  TopTools_IndexedMapOfShape owned;
  for (TopExp_Explorer s(model.shape, TopAbs_SOLID); s.More(); s.Next()) {
    bool is_body = true;
    for (TopExp_Explorer f(s.Current(), TopAbs_FACE); f.More() && is_body; f.Next())
      is_body = !gone.Contains(f.Current());
    if (!is_body) continue;
    bodies.push_back(s.Current());
    TopExp::MapShapes(s.Current(), TopAbs_FACE, owned);
  }
  return owned;
}

SymmetryPlane plane_of(const ImportedShape& model, const std::vector<FaceId>& faces, double diagonal,
                       const std::string& path) {
  const std::vector<FaceSample> samples = sample_face(TopoDS::Face(model.faces(faces[0] + 1)));
  const Vec3 n = samples.empty() ? Vec3{} : samples[0].normal, x = samples.empty() ? Vec3{} : samples[0].xyz;
  const double normal[] = {std::abs(n.x), std::abs(n.y), std::abs(n.z)}, place[] = {x.x, x.y, x.z};
  SymmetryPlane plane;
  plane.axis = static_cast<int>(std::max_element(normal, normal + 3) - normal);
  plane.value = std::abs(place[plane.axis]) < kAlongAxis * diagonal ? 0 : place[plane.axis];
  bool is_one = normal[plane.axis] > 1 - kAlongAxis;
  for (const FaceId f : faces)
    for (const FaceSample& s : sample_face(TopoDS::Face(model.faces(f + 1)))) {
      const double at[] = {s.xyz.x, s.xyz.y, s.xyz.z};
      is_one = is_one && std::abs(at[plane.axis] - place[plane.axis]) < 1e-4 * diagonal;
    }
  if (!is_one)
    throw Error(ExitCode::kUsage,
                path +
                    ": --replace-farfield keeps one symmetry plane across x, y or z, and the file has "
                    "others; make the new domain in the CAD system");
  return plane;
}

/// A rule that says which faces bound the air.
bool speaks_of_air(const GroupRule& rule) {
  const GroupCriteria& wanted = rule.selection;
  const bool selects = !wanted.faces.empty() || !wanted.parts.empty() || !wanted.paths.empty() ||
                       !wanted.layers.empty() || !wanted.colors.empty() || !wanted.surfaces.empty() || wanted.inside ||
                       wanted.touching;
  return selects && rule.of == EntityDim::kFace && rule.table.empty() &&
         is_outer_role(rule.role ? *rule.role : role_of_name(rule.name));
}

}  // namespace

AirFaces counts_of(const FileAir& air) {
  AirFaces counts;
  counts.n_farfield = static_cast<int>(air.faces.farfield.size());
  counts.n_symmetry = static_cast<int>(air.faces.symmetry.size());
  counts.n_interface = static_cast<int>(air.faces.interface.size());
  counts.is_by_shape = air.is_by_shape;
  counts.doubt = air.faces.doubt;
  return counts;
}

AskedAir parse_air(const ImportOptions& options) {
  const AirOptions& air = options.air;
  AskedAir asked;
  if (!air.symmetry.empty()) asked.plane = parse_symmetry(air.symmetry, "--symmetry");
  if (!air.mirror.empty()) asked.mirror = parse_symmetry(air.mirror, "--mirror");
  if (!air.farfield.empty()) asked.far = parse_farfield(air.farfield, "--farfield");
  if (!air.replace_farfield.empty()) {
    if (asked.far) throw Error(ExitCode::kUsage, "--farfield and --replace-farfield: give one of them");
    asked.far = parse_farfield(air.replace_farfield, "--replace-farfield");
    asked.replaces = true;
  }
  if (air.flow_domain != "auto" && air.flow_domain != "yes" && air.flow_domain != "no")
    throw Error(ExitCode::kUsage, "--flow-domain: '" + air.flow_domain + "' is none of auto, yes, no");
  asked.may_search = air.flow_domain != "no";
  if (air.flow_domain == "yes") asked.search = AirSearch::kAsked;
  if (asked.search == AirSearch::kSure && !asked.plane && !asked.far &&
      std::any_of(options.groups.begin(), options.groups.end(), speaks_of_air))
    asked.may_search = false;
  return asked;
}

FileAir find_file_air(ImportedShape& model, const ModelTables& tables, const AskedAir& asked, const std::string& path) {
  FileAir air{named_air(tables), false};
  if (!air.faces.is_found() && asked.may_search) {
    air.faces = find_own_air(model, tables, asked.search);
    air.is_by_shape = air.faces.is_found();
    if (!air.is_by_shape && asked.search == AirSearch::kAsked)
      throw Error(ExitCode::kGeometry, path +
                                           ": --flow-domain yes: no closed boundary around a body is found; name the "
                                           "faces of the far field in a groups file");
  }
  require_wanted(tables, air, asked, path);
  if (air.is_by_shape) give_roles(model, air.faces);
  return air;
}

void remove_air(ImportedShape& model, const ModelTables& tables, const OwnAir& air, AskedAir& asked,
                const std::string& path) {
  if (!asked.plane && !air.symmetry.empty())
    asked.plane = plane_of(model, air.symmetry, tables.reference_diagonal(), path);
  TopTools_IndexedMapOfShape gone;
  for (const std::vector<FaceId>* faces : {&air.farfield, &air.symmetry, &air.interface})
    for (const FaceId f : *faces) gone.Add(model.faces(f + 1));
  std::vector<TopoDS_Shape> left;
  const TopTools_IndexedMapOfShape owned = faces_of_bodies(model, gone, left);
  for (int i = 1; i <= model.faces.Extent(); ++i)
    if (!gone.Contains(model.faces(i)) && !owned.Contains(model.faces(i))) left.push_back(model.faces(i));
  model.replace(compound_of(left), [](const TopoDS_Shape& face) { return face; });
}

}  // namespace occt
}  // namespace st
