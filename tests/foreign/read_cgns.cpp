// read_cgns FILE: what the CGNS library itself reads of a surface mesh, as JSON: unit, families with their conditions,
// sections, boundaries, area of each section, periodic connections.
#include <cgnslib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace {

constexpr int kBase = 1, kZone = 1;

void require(int status) {
  if (status != CG_OK) cg_error_exit();
}

std::array<std::vector<double>, 3> coordinates(int file, cgsize_t n) {
  std::array<std::vector<double>, 3> x;
  const char* names[] = {"CoordinateX", "CoordinateY", "CoordinateZ"};
  const cgsize_t first = 1;
  for (int k = 0; k < 3; ++k) {
    x[k].resize(static_cast<std::size_t>(n));
    require(cg_coord_read(file, kBase, kZone, names[k], CGNS_ENUMV(RealDouble), &first, &n, x[k].data()));
  }
  return x;
}

/// Of the polygon of an element's corners, from triangles with its first.
double area(const std::array<std::vector<double>, 3>& x, const cgsize_t* nodes, int n_corners) {
  double sum = 0;
  for (int k = 2; k < n_corners; ++k) {
    double a[3], b[3];
    for (int i = 0; i < 3; ++i) {
      a[i] = x[i][nodes[k - 1] - 1] - x[i][nodes[0] - 1];
      b[i] = x[i][nodes[k] - 1] - x[i][nodes[0] - 1];
    }
    sum += 0.5 * std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
  }
  return sum;
}

nlohmann::json sections(int file, const std::array<std::vector<double>, 3>& x) {
  nlohmann::json all = nlohmann::json::array();
  int n_sections = 0;
  require(cg_nsections(file, kBase, kZone, &n_sections));
  for (int s = 1; s <= n_sections; ++s) {
    char name[33];
    CGNS_ENUMT(ElementType_t) type;
    cgsize_t first, last, size;
    int n_boundary, has_parent, n_nodes;
    require(cg_section_read(file, kBase, kZone, s, name, &type, &first, &last, &n_boundary, &has_parent));
    require(cg_ElementDataSize(file, kBase, kZone, s, &size));
    require(cg_npe(type, &n_nodes));
    std::vector<cgsize_t> nodes(static_cast<std::size_t>(size));
    require(cg_elements_read(file, kBase, kZone, s, nodes.data(), nullptr));
    const bool is_triangle = type == CGNS_ENUMV(TRI_3) || type == CGNS_ENUMV(TRI_6);
    double sum = 0;
    for (std::size_t i = 0; i < nodes.size(); i += static_cast<std::size_t>(n_nodes))
      sum += area(x, nodes.data() + i, is_triangle ? 3 : 4);
    all.push_back(
        {{"name", name}, {"type", cg_ElementTypeName(type)}, {"first", first}, {"last", last}, {"area", sum}});
  }
  return all;
}

nlohmann::json families(int file) {
  nlohmann::json all = nlohmann::json::object();
  int n_families = 0;
  require(cg_nfamilies(file, kBase, &n_families));
  for (int f = 1; f <= n_families; ++f) {
    char name[33], condition_name[33];
    int n_conditions = 0, n_geometries = 0;
    CGNS_ENUMT(BCType_t) condition;
    require(cg_family_read(file, kBase, f, name, &n_conditions, &n_geometries));
    require(cg_fambc_read(file, kBase, f, 1, condition_name, &condition));
    all[name] = cg_BCTypeName(condition);
  }
  return all;
}

nlohmann::json boundaries(int file) {
  nlohmann::json all = nlohmann::json::array();
  int n_boundaries = 0;
  require(cg_nbocos(file, kBase, kZone, &n_boundaries));
  for (int b = 1; b <= n_boundaries; ++b) {
    char name[33], family[33];
    CGNS_ENUMT(BCType_t) type;
    CGNS_ENUMT(PointSetType_t) kind;
    CGNS_ENUMT(DataType_t) normal_type;
    cgsize_t n_points, normal_size, range[2];
    int normal_index[3], n_sets;
    require(cg_boco_info(file, kBase, kZone, b, name, &type, &kind, &n_points, normal_index, &normal_size, &normal_type,
                         &n_sets));
    require(cg_boco_read(file, kBase, kZone, b, range, nullptr));
    require(cg_goto(file, kBase, "Zone_t", kZone, "ZoneBC_t", 1, "BC_t", b, "end"));
    require(cg_famname_read(family));
    all.push_back({{"family", family}, {"first", range[0]}, {"last", range[1]}});
  }
  return all;
}

/// Largest distance of a node's image, by the motion, from its donor; nodes of each connection.
nlohmann::json connections(int file, const std::array<std::vector<double>, 3>& x) {
  nlohmann::json all = nlohmann::json::array();
  int n_connections = 0;
  require(cg_nconns(file, kBase, kZone, &n_connections));
  for (int c = 1; c <= n_connections; ++c) {
    char name[33], donor[33];
    CGNS_ENUMT(GridLocation_t) location;
    CGNS_ENUMT(GridConnectivityType_t) type;
    CGNS_ENUMT(PointSetType_t) set, donor_set;
    CGNS_ENUMT(ZoneType_t) zone_type;
    CGNS_ENUMT(DataType_t) donor_type;
    cgsize_t n, n_donors;
    require(cg_conn_info(file, kBase, kZone, c, name, &location, &type, &set, &n, donor, &zone_type, &donor_set,
                         &donor_type, &n_donors));
    std::vector<cgsize_t> own(static_cast<std::size_t>(n)), other(static_cast<std::size_t>(n_donors));
    require(cg_conn_read(file, kBase, kZone, c, own.data(), CGNS_ENUMV(LongInteger), other.data()));
    float center[3], angle[3], translation[3];
    require(cg_conn_periodic_read(file, kBase, kZone, c, center, angle, translation));
    double most = 0;
    for (std::size_t i = 0; i < own.size(); ++i) {
      double p[3];
      for (int k = 0; k < 3; ++k) p[k] = x[k][own[i] - 1] - center[k];
      for (int k = 0; k < 3; ++k) {  // about x, then y, then z
        double &u = p[(k + 1) % 3], &v = p[(k + 2) % 3];
        const double turned = std::cos(angle[k]) * u - std::sin(angle[k]) * v;
        v = std::sin(angle[k]) * u + std::cos(angle[k]) * v;
        u = turned;
      }
      for (int k = 0; k < 3; ++k) p[k] += center[k] + translation[k] - x[k][other[i] - 1];
      most = std::max(most, std::hypot(p[0], p[1], p[2]));
    }
    all.push_back({{"name", name},
                   {"type", cg_GridConnectivityTypeName(type)},
                   {"location", cg_GridLocationName(location)},
                   {"nodes", n},
                   {"donors", n_donors},
                   {"apart", most}});
  }
  return all;
}

std::string unit(int file) {
  CGNS_ENUMT(MassUnits_t) mass;
  CGNS_ENUMT(LengthUnits_t) length;
  CGNS_ENUMT(TimeUnits_t) time;
  CGNS_ENUMT(TemperatureUnits_t) temperature;
  CGNS_ENUMT(AngleUnits_t) angle;
  require(cg_goto(file, kBase, "end"));
  return cg_units_read(&mass, &length, &time, &temperature, &angle) == CG_OK ? cg_LengthUnitsName(length) : "";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  int file = 0;
  require(cg_open(argv[1], CG_MODE_READ, &file));
  char name[33];
  cgsize_t size[3];
  require(cg_zone_read(file, kBase, kZone, name, size));
  const auto x = coordinates(file, size[0]);
  const nlohmann::json result = {{"nodes", size[0]},
                                 {"elements", size[1]},
                                 {"unit", unit(file)},
                                 {"families", families(file)},
                                 {"sections", sections(file, x)},
                                 {"boundaries", boundaries(file)},
                                 {"connections", connections(file, x)}};
  std::printf("%s\n", result.dump().c_str());
  require(cg_close(file));
}
