// That the CGNS library and VTK read such files is tested in tests/foreign.
#include <cmath>

#include "io/export/export.h"
#include "io/hdf5/artifact.h"
#include "io/hdf5/hdf5_handles.h"
#include "unit/io/sample_artifacts.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

TEST(ExportCgns, has_families_conditions_by_role_and_the_unit) {
  TemporaryDirectory dir;
  const SurfaceMesh m = sample_mesh().mesh;
  ExportOptions options;
  options.unit = "mm";
  export_mesh(dir / "m.cgns", {m, all_triangles(m), {}}, options);
  const std::string bytes = read_bytes(dir / "m.cgns");
  for (const char* text : {"body", "wing", "BCWall", "BCSymmetryPlane", "Millimeter", "FamilySpecified"})
    EXPECT_NE(bytes.find(text), std::string::npos) << text;
  export_mesh(dir / "n.cgns", m);
  EXPECT_EQ(read_bytes(dir / "n.cgns").find("Millimeter"), std::string::npos);
}

/// Values of a node of the tree.
template <class T>
std::vector<T> values_of(hid_t file, const std::string& node, hid_t type) {
  const Dataset set = H5Dopen2(file, (node + "/ data").c_str(), H5P_DEFAULT);
  const Space space = H5Dget_space(set);
  std::vector<T> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  if (H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) throw std::runtime_error(node);
  return values;
}

std::string type_of(hid_t file, const std::string& node) {
  char text[3] = {};
  const Attribute attribute = H5Aopen_by_name(file, node.c_str(), "type", H5P_DEFAULT, H5P_DEFAULT);
  const Type type = H5Aget_type(attribute);
  H5Aread(attribute, type, text);
  return text;
}

/// What the file says of one way of a pair.
struct Link {
  std::vector<std::int32_t> own, donor;
  Similarity motion;
};

Link read_link(const std::string& path, const std::string& name) {
  const File file = open_hdf5(path);
  const std::string link = "/Base/Zone/ZoneGridConnectivity/" + name,
                    periodic = link + "/GridConnectivityProperty/Periodic/";
  const auto vector_of = [&](const std::string& what) {
    EXPECT_EQ(type_of(file, periodic + what), "R4") << what;  // the CGNS library reads no other
    const auto v = values_of<double>(file, periodic + what, H5T_NATIVE_DOUBLE);
    return Vec3{v.at(0), v.at(1), v.at(2)};
  };
  const Vec3 turns = vector_of("RotationAngle");
  Link result{values_of<std::int32_t>(file, link + "/PointList", H5T_NATIVE_INT32),
              values_of<std::int32_t>(file, link + "/PointListDonor", H5T_NATIVE_INT32),
              rotation_about({1, 0, 0}, turns.x)
                  .then(rotation_about({0, 1, 0}, turns.y))
                  .then(rotation_about({0, 0, 1}, turns.z))
                  .about(vector_of("RotationCenter"))};
  result.motion.translation = result.motion.translation + vector_of("Translation");
  const auto donor_zone = values_of<char>(file, link, H5T_NATIVE_CHAR);
  EXPECT_EQ(std::string(donor_zone.begin(), donor_zone.end()), "Zone");
  return result;
}

/// Faces 0 and 1 are a pair, their nodes in another order each, 3 to 5 those of face 0.
SurfaceMesh periodic_mesh(const Similarity& motion) {
  SurfaceMesh m;
  m.node_xyz = {{}, {}, {}, {1, 2, 0}, {4, 2, 0}, {1, 5, 1}};
  m.node_xyz[2] = motion(m.node_xyz[3]);
  m.node_xyz[0] = motion(m.node_xyz[4]);
  m.node_xyz[1] = motion(m.node_xyz[5]);
  m.node_entity_dim.assign(6, 0);
  m.node_entity = {0, 1, 2, 3, 4, 5};
  m.node_t.assign(6, 0);
  m.node_size.assign(6, 1);
  m.triangles = {{{3, 4, 5}}, {{0, 2, 1}}};
  m.triangle_face = {0, 1};
  m.triangle_group = {0, 1};
  m.labels.group_name = {"low", "high"};
  m.labels.group_role = {"periodic", "periodic"};
  m.merged.pairs = {{0, 1, motion}};
  return m;
}

void expect_images(const Link& link, const std::vector<Vec3>& xyz) {
  ASSERT_EQ(link.own.size(), link.donor.size());
  for (std::size_t i = 0; i < link.own.size(); ++i)
    EXPECT_LT(distance(link.motion(xyz.at(link.own[i] - 1)), xyz.at(link.donor[i] - 1)), 1e-5) << i;
}

TEST(ExportCgns, links_periodic_faces_both_ways) {
  TemporaryDirectory dir;
  Similarity askew = rotation_about({0, 0.6, 0.8}, 0.4).about({3, 1, 7});
  askew.translation = askew.translation + Vec3{1, 0, 0};
  for (const Similarity& motion : {Similarity{.translation = {0, 0, 3}}, rotation_about({1, 0, 0}, 0.5), askew}) {
    const SurfaceMesh m = periodic_mesh(motion);
    export_mesh(dir / "m.cgns", m);
    const Link there = read_link(dir / "m.cgns", "face 1 to 2"), back = read_link(dir / "m.cgns", "face 2 to 1");
    EXPECT_EQ(there.own, (std::vector<std::int32_t>{4, 5, 6}));
    EXPECT_EQ(there.donor, (std::vector<std::int32_t>{3, 1, 2}));
    EXPECT_EQ(back.own, (std::vector<std::int32_t>{1, 2, 3}));
    EXPECT_EQ(back.donor, (std::vector<std::int32_t>{5, 6, 4}));
    expect_images(there, m.node_xyz);
    expect_images(back, m.node_xyz);
  }
}

TEST(ExportCgns, links_nodes_on_the_sides_of_curved_faces) {
  TemporaryDirectory dir;
  const SurfaceMesh m = periodic_mesh({.translation = {0, 0, 3}});
  const auto middle = [&](NodeId a, NodeId b) { return 0.5 * (m.node_xyz[a] + m.node_xyz[b]); };
  MidNodes mid;
  mid.ends = {{0, 1}, {0, 2}, {1, 2}, {3, 4}, {3, 5}, {4, 5}};
  for (const auto& [a, b] : mid.ends) mid.xyz.push_back(middle(a, b));
  mid.entity_dim.assign(6, 2);
  mid.entity = {1, 1, 1, 0, 0, 0};
  export_mesh(dir / "m.cgns", {m, all_triangles(m), mid}, {});
  const Link there = read_link(dir / "m.cgns", "face 1 to 2");
  EXPECT_EQ(there.own, (std::vector<std::int32_t>{4, 5, 6, 10, 11, 12}));
  std::vector<Vec3> xyz = m.node_xyz;
  xyz.insert(xyz.end(), mid.xyz.begin(), mid.xyz.end());
  expect_images(there, xyz);
}

TEST(ExportCgns, has_no_connectivity_without_pairs) {
  TemporaryDirectory dir;
  SurfaceMesh m = periodic_mesh({.translation = {0, 0, 3}});
  m.merged.pairs.clear();
  export_mesh(dir / "m.cgns", m);
  EXPECT_EQ(read_bytes(dir / "m.cgns").find("ZoneGridConnectivity"), std::string::npos);
}

}  // namespace
}  // namespace st
