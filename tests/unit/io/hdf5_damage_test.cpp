// Artifacts of which one part is damaged: each check refuses its own, by its own message.
#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "io/hdf5/hdf5_file.h"
#include "io/hdf5/mesh_part.h"
#include "io/hdf5/patches_file.h"
#include "unit/io/copied_artifact.h"
#include "unit/io/sample_sizing.h"
#include "unit/io/soft_limit.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

/// For all tests: HDF5 makes a table of 528 kB per open file, and keeps it from now on instead of mapping it again.
const bool kKeepsFreedMemory = H5set_free_list_limits(-1, -1, -1, -1, -1, -1) >= 0;

constexpr const char *kReals = "/st/reals", *kIntegers = "/st/integers", *kTexts = "/st/texts";
constexpr hsize_t kIntegerCount = 500;  // enough to be mapped

ArtifactHeader header_of(const std::string& schema, int version = 1) {
  ArtifactHeader header = sample_header();
  header.schema = schema;
  header.schema_version = version;
  return header;
}

std::string write_plain(const std::string& path) {
  Hdf5Writer writer(path, header_of("sizing"));
  writer.write(kReals, std::vector<double>{1, 2, 3, 4});
  writer.write(kIntegers, std::vector<std::int64_t>(kIntegerCount, 7));
  writer.write_strings(kTexts, {"a", "bc"});
  writer.commit();
  return path;
}

/// By HDF5 itself, which leaves all checksums of its own right.
void edit_hdf5(const std::string& path, const std::function<void(hid_t file)>& edit) {
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);  // and what is open in it
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, access);
  ASSERT_GE(file, 0);
  edit(file);
  H5Fclose(file);
  H5Pclose(access);
}

void remove_attribute(hid_t file, const char* name) { H5Adelete_by_name(file, "/st", name, H5P_DEFAULT); }

void add_attribute(hid_t object, const char* name, hid_t type, const void* value) {
  const hid_t space = H5Screate(H5S_SCALAR), made = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  EXPECT_GE(H5Awrite(made, type, value), 0) << name;
  H5Aclose(made);
  H5Sclose(space);
}

void set_version(hid_t file, hid_t type, const void* value) {
  remove_attribute(file, "schema_version");
  add_attribute(H5Gopen2(file, "/st", H5P_DEFAULT), "schema_version", type, value);
}

/// Without values and without a checksum.
hid_t make_dataset(hid_t file, const char* name, hid_t type, const std::vector<hsize_t>& shape,
                   hid_t creation = H5P_DEFAULT) {
  const hid_t space = H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
  const hid_t made = H5Dcreate2(file, name, type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  EXPECT_GE(made, 0) << name;
  H5Sclose(space);
  return made;
}

/// Makes a dataset again, without values, but with the checksum that it had: the content hash of the file still fits.
hid_t replace_dataset(hid_t file, const char* name, hid_t type, hsize_t n_rows, hid_t creation = H5P_DEFAULT) {
  char checksum[64] = {};
  const hid_t attribute = H5Aopen_by_name(file, name, "xxh3", H5P_DEFAULT, H5P_DEFAULT);
  const hid_t text = H5Aget_type(attribute);
  EXPECT_GE(H5Aread(attribute, text, checksum), 0);
  H5Aclose(attribute);
  H5Ldelete(file, name, H5P_DEFAULT);
  const hid_t made = make_dataset(file, name, type, {n_rows}, creation);
  add_attribute(made, "xxh3", text, checksum);
  return made;
}

hid_t text_type(std::size_t width) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, width);
  return type;
}

struct Hdf5Edit {
  const char* says;
  std::function<void(hid_t file)> edit;
};

void expect_edits_refused(const TemporaryDirectory& dir, const std::vector<Hdf5Edit>& edits) {
  const std::string path = dir / "a.hdf";
  for (const auto& [says, edit] : edits) {
    write_plain(path);
    EXPECT_NO_THROW(Hdf5Reader{path});
    edit_hdf5(path, edit);
    EXPECT_ERROR(Hdf5Reader{path}, kInput, path + ": " + says);
  }
}

TEST(Hdf5Damage, of_the_header_is_refused) {
  static const double real = 1;
  static const std::int64_t zero = 0, large = std::int64_t{1} << 32;
  static const std::int32_t small = 1;
  const TemporaryDirectory dir;
  expect_edits_refused(
      dir, {{"is HDF5, but no artifact of an st tool (no group /st)",
             [](hid_t f) { H5Lmove(f, "/st", f, "/other", H5P_DEFAULT, H5P_DEFAULT); }},
            {"group /st cannot be read",
             [](hid_t f) {
               H5Ldelete(f, "/st", H5P_DEFAULT);
               make_dataset(f, "/st", H5T_NATIVE_DOUBLE, {4});
             }},
            {"attribute /st@schema is missing", [](hid_t f) { remove_attribute(f, "schema"); }},
            {"attribute /st@schema_version is missing", [](hid_t f) { remove_attribute(f, "schema_version"); }},
            {"attribute /st@schema_version is missing", [](hid_t f) { set_version(f, H5T_NATIVE_DOUBLE, &real); }},
            {"schema version 0 does not exist", [](hid_t f) { set_version(f, H5T_NATIVE_INT64, &zero); }},
            {"schema version 4294967296 does not exist", [](hid_t f) { set_version(f, H5T_NATIVE_INT64, &large); }},
            {"attribute odd of /st cannot be read",
             [](hid_t f) { add_attribute(H5Gopen2(f, "/st", H5P_DEFAULT), "odd", H5T_NATIVE_INT32, &small); }}});
}

TEST(Hdf5Damage, of_the_list_of_parts_is_refused) {
  const TemporaryDirectory dir;
  expect_edits_refused(
      dir, {{"its parts do not fit its content hash", [](hid_t f) { H5Ldelete(f, kReals, H5P_DEFAULT); }},
            {"/st/a/a/a/a/a/a/a/a: groups too deep",
             [](hid_t f) {
               std::string name = "/st";
               for (int i = 0; i < 8; ++i) H5Gcreate2(f, (name += "/a").c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
             }},
            {"dataset /st/odd cannot be read", [](hid_t f) { make_dataset(f, "/st/odd", H5T_NATIVE_INT16, {4}); }},
            {"dataset /st/odd cannot be read",
             [](hid_t f) {
               make_dataset(f, "/st/odd", H5T_NATIVE_DOUBLE, {2, 2, 2});
             }},
            {"dataset /st/odd cannot be read",
             [](hid_t f) {
               H5Dcreate2(f, "/st/odd", H5T_NATIVE_DOUBLE, H5Screate(H5S_SCALAR), H5P_DEFAULT, H5P_DEFAULT,
                          H5P_DEFAULT);
             }},
            {"dataset /st/odd is larger than the file",
             [](hid_t f) { make_dataset(f, "/st/odd", H5T_NATIVE_DOUBLE, {hsize_t{1} << 40}); }},
            {"dataset /st/odd has no checksum", [](hid_t f) { make_dataset(f, "/st/odd", H5T_NATIVE_DOUBLE, {4}); }}});
}

/// So many parts do not stand in the group itself, but in a heap, which begins with FRHP. HDF5 1.10 must not sort them.
TEST(Hdf5Damage, of_what_lists_the_parts_of_a_group_is_refused) {
  const TemporaryDirectory dir;
  const std::string path = dir / "a.hdf";
  const auto make_many = [](hid_t file, bool are_links) {
    const hid_t group = H5Gcreate2(file, "/st/many", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    for (char name[] = "a"; name[0] < 'u'; ++name[0])
      if (are_links)
        H5Lcreate_hard(file, kReals, group, name, H5P_DEFAULT, H5P_DEFAULT);
      else
        add_attribute(group, name, H5T_NATIVE_INT64, &kIntegerCount);
  };
  for (const auto& [says, are_links] :
       {std::pair("group /st/many cannot be listed, or has more than 10000 parts", true),
        {"an attribute of /st/many cannot be read", false}}) {
    write_plain(path);
    edit_hdf5(path, [&, are_links = are_links](hid_t file) { make_many(file, are_links); });
    std::string bytes = read_bytes(path);
    const std::size_t at = bytes.find("FRHP");
    ASSERT_LT(at, bytes.size()) << says;
    bytes[at] = '?';
    write_bytes(path, bytes);
    EXPECT_ERROR(Hdf5Reader{path}, kInput, path + ": " + says);
  }
}

TEST(Hdf5Damage, of_a_file_that_is_cut_or_cannot_be_opened_is_refused) {
  const TemporaryDirectory dir;
  const std::string path = write_plain(dir / "a.hdf");
  EXPECT_NO_THROW(Hdf5Reader{path});
  {
    const SoftLimit no_files(RLIMIT_NOFILE, 0);
    EXPECT_ERROR(Hdf5Reader{path}, kInput, path + ": cannot be opened (Too many open files)");
  }
  std::filesystem::resize_file(path, 100);
  EXPECT_ERROR(Hdf5Reader{path}, kInput, path + ": cannot be opened as HDF5");
}

TEST(Hdf5Damage, of_a_mapped_array_is_found_by_its_checksum) {
  const TemporaryDirectory dir;
  const std::string path = write_plain(dir / "a.hdf");
  std::string bytes = read_bytes(path);
  {
    const Hdf5Reader reader(path);
    EXPECT_EQ(reader.map<std::int64_t>(kIntegers)[1], 7);
    ++bytes[static_cast<std::size_t>(reader.file_offset(kIntegers)) + 8];
  }
  write_bytes(path, bytes);
  EXPECT_ERROR(Hdf5Reader(path).map<std::int64_t>(kIntegers), kInput, "/st/integers: does not fit its checksum");
}

TEST(Hdf5Damage, of_texts_wider_than_the_file_is_refused) {
  const TemporaryDirectory dir;
  const std::string path = write_plain(dir / "a.hdf");
  edit_hdf5(path, [](hid_t f) { replace_dataset(f, kTexts, text_type(1 << 20), 2); });
  EXPECT_ERROR(Hdf5Reader(path).read_strings(kTexts), kInput, "/st/texts: is larger than the file");
}

/// Copies an artifact into the oldest form of HDF5, which has no checksums, and has one dataset start a megabyte after
/// the end of the file.
void move_dataset_away(const std::string& from, const std::string& to, const char* name, hid_t type, hsize_t n_rows) {
  std::uint64_t place[2] = {};  // offset and number of bytes, as they stand in the file
  edit_hdf5(from, [&](hid_t source) {
    const hid_t file = H5Fcreate(to.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY);
    ASSERT_GE(H5Ocopy(source, "/st", file, "/st", H5P_DEFAULT, H5P_DEFAULT), 0);
    const hid_t dataset = replace_dataset(file, name, type, n_rows, creation);
    place[0] = H5Dget_offset(dataset);
    place[1] = H5Dget_storage_size(dataset);
    H5Dclose(dataset);
    H5Pclose(creation);
    H5Fclose(file);
  });
  std::string bytes = read_bytes(to);
  const std::size_t at = bytes.find(std::string(reinterpret_cast<const char*>(place), sizeof place));
  ASSERT_LT(at, bytes.size());
  place[0] = bytes.size() / 8 * 8 + (std::uint64_t{1} << 20);
  std::memcpy(bytes.data() + at, place, sizeof place);
  write_bytes(to, bytes);
}

TEST(Hdf5Damage, of_the_place_of_an_array_is_refused) {
  const TemporaryDirectory dir;
  const std::string good = write_plain(dir / "good.hdf"), path = dir / "a.hdf";
  move_dataset_away(good, path, kIntegers, H5T_NATIVE_INT64, kIntegerCount);
  EXPECT_ERROR(Hdf5Reader(path).read<std::int64_t>(kIntegers), kInput, "/st/integers: cannot be read");
  EXPECT_ERROR(Hdf5Reader(path).map<std::int64_t>(kIntegers), kInput, "/st/integers: ends after the file");
  EXPECT_EQ(Hdf5Reader(path).read<double>(kReals).size(), 4u);
  move_dataset_away(good, path, kTexts, text_type(2), 2);
  EXPECT_ERROR(Hdf5Reader(path).read_strings(kTexts), kInput, "/st/texts: cannot be read");
}

/// Of one kind of artifact: what is wrong in it, and what a reader says.
template <class ArtifactKind>
using ArtifactBreaks = std::vector<std::pair<const char*, std::function<void(ArtifactKind&)>>>;

/// Of one length, with two cells split by a surface, and moved.
SizingArtifact split_sizing() {
  SizingArtifact sizing = sample_sizing();
  sizing.cones = {};
  sizing.lengths.cause.assign(sizing.lengths.cause.size(), kNone);
  sizing.blanking.colour.assign(sizing.lengths.cells.size(), CellColour::kFlow);
  sizing.blanking.split_leaf = {3, 7};
  sizing.blanking.split.assign(2, {{0, 0, 1}, 0, 0});
  sizing.lengths.second_cells.assign(2, sizing.lengths.cells[0]);
  sizing.lengths.second_cause.assign(2, kNone);
  sizing.frame.translation = {1, 2, 3};
  return sizing;
}

/// Likewise, with two cones, one of them in each site, both in the last.
SizingArtifact cone_sizing() {
  SizingArtifact sizing = split_sizing();
  const auto n_sites = static_cast<std::int32_t>(sizing.lengths.cells.size() + sizing.lengths.second_cells.size());
  sizing.cones.cone = {Cone({{0.1, 0.2, 0.3}, 0.02F, kNone, {}, {}, reach_of({0.01, 0, 0}, {0, 0.02, 0})}, 0.2F, {}),
                       Cone({{0.5, 0.2, 0.3}, 0.03F}, 0.1F, {})};
  sizing.cones.cause = {kNone, kNone};
  for (std::int32_t site = 0; site <= n_sites; ++site) sizing.cones.first.push_back(site);
  sizing.cones.of_site.assign(n_sites - 1, 1);
  sizing.cones.of_site.insert(sizing.cones.of_site.end(), {0, 1});
  ++sizing.cones.first.back();
  return sizing;
}

/// With two sources and a background of one tetrahedron.
SizingArtifact source_sizing() {
  SizingArtifact sizing = sample_sizing();
  SourceSpec point, line;
  point.point[0] = {0.3, 0.3, 0.3};
  point.spacing[0] = {0.001, 0.1, 0.2};
  line.kind = SourceKind::kLine;
  line.point = {{{0, 0, 0}, {1, 1, 1}, {}}};
  line.spacing = {{{0.002, 0, 0}, {0.003, 0, 0}, {}}};
  line.aspect = 3;
  line.direction = {0, 0, 1};
  sizing.sources.sources = {point, line};
  sizing.sources.background.node_xyz = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  sizing.sources.background.node_size.assign(4, {0.01, 0.01, {}});
  sizing.sources.background.tets = {{0, 1, 2, 3}};
  sizing.source_name = {"wake", "tip"};
  return sizing;
}

/// By the reader and the mapper, each with its message.
void expect_refused_by_both(const std::string& path, const SizingArtifact& good,
                            const ArtifactBreaks<SizingArtifact>& breaks) {
  for (const auto& [says, break_it] : breaks) {
    SizingArtifact sizing = good;
    break_it(sizing);
    write_sizing(path, sizing);
    EXPECT_ERROR(read_sizing(path), kInput, path + ": " + says);
    EXPECT_ERROR(map_sizing(path), kInput, path + ": " + says);
  }
}

TEST(SizingDamage, of_cones_is_refused_by_both_readers) {
  static constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const TemporaryDirectory dir;
  const std::string path = dir / "a.hdf";
  write_sizing(path, cone_sizing());
  const SizingArtifact read = read_sizing(path);
  const std::string unordered =
      "/st/cone/of_site: row " + std::to_string(read.cones.of_site.size() - 1) + " names a shorter cone";
  EXPECT_EQ(read.cones.of_site, cone_sizing().cones.of_site);
  EXPECT_EQ(read.cones.cone[1].slope, 0.1F);
  const MappedSizing mapped = map_sizing(path);
  EXPECT_EQ(mapped.field->data().cones.cone.size(), 2U);
  const ArtifactBreaks<SizingArtifact> breaks = {
      {"/st/cone/cone: row 1 is not a place with a length and a slope > 0",
       [](auto& s) { s.cones.cone[1].x[2] = kNan; }},
      {"/st/cone/cone: row 0 is not a place with a length and a slope > 0",
       [](auto& s) { s.cones.cone[0].length = 0; }},
      {"/st/cone/cone: row 0 is not a place with a length and a slope > 0",
       [](auto& s) { s.cones.cone[0].slope = -1; }},
      {"/st/cone/cone: row 0 is not a place with a length and a slope > 0",
       [](auto& s) { s.cones.cone[0].half[1] = kNan; }},
      {"/st/cone/cone: row 0 is not a place with a length and a slope > 0",
       [](auto& s) { s.cones.cone[0].side[0][2] = kNan; }},
      {"/st/cone/cause: does not fit the number of cones", [](auto& s) { s.cones.cause.pop_back(); }},
      {"/st/cone/first: does not fit the number of cells", [](auto& s) { s.cones.first.pop_back(); }},
      {"/st/cone/first", [](auto& s) { s.cones.first[2] = 1'000'000; }},
      {"/st/cone/of_site: row 1 names entity 2 of", [](auto& s) { s.cones.of_site[1] = 2; }},
      {unordered.c_str(),
       [](auto& s) { std::swap(s.cones.of_site.back(), s.cones.of_site[s.cones.of_site.size() - 2]); }}};
  expect_refused_by_both(path, cone_sizing(), breaks);
}

TEST(SizingDamage, of_sources_is_refused_by_both_readers) {
  static constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const TemporaryDirectory dir;
  const std::string path = dir / "a.hdf";
  const SizingArtifact good = source_sizing();
  write_sizing(path, good);
  const SizingArtifact read = read_sizing(path);
  const MappedSizing mapped = map_sizing(path);
  for (const Vec3 x : {Vec3{0.3, 0.3, 0.3}, Vec3{3, 2, 1}, Vec3{0.25, 0.1, 0.5}})
    EXPECT_EQ(static_cast<const SizeField&>(*mapped.field).size(x),
              static_cast<const SizeField&>(*good.field()).size(x));
  EXPECT_EQ(read.sources.sources[1].direction.z, 1);
  EXPECT_EQ(read.model.faces.leaf, good.model.faces.leaf);
  const ArtifactBreaks<SizingArtifact> breaks = {
      {"/st/source/numbers: row 31 is not finite", [](auto& s) { s.sources.sources[0].direction.z = kNan; }},
      {"/st/source/numbers: row 1 asks for no length > 0", [](auto& s) { s.sources.sources[1].spacing[1].length = 0; }},
      {"/st/source/numbers: row 0 asks for no length > 0", [](auto& s) { s.sources.sources[0].aspect = 0.5; }},
      {"/st/source/kind: names a kind that is unknown",
       [](auto& s) { s.sources.sources[0].kind = static_cast<SourceKind>(7); }},
      {"/st/source/name: does not fit the number of sources", [](auto& s) { s.source_name.pop_back(); }},
      {"/st/sizing@source_slope: is no slope > 0", [](auto& s) { s.sources.slope = 0; }},
      {"/st/background/node: row 2 is not finite", [](auto& s) { s.sources.background.node_xyz[2].x = kNan; }},
      {"/st/background/size: row 1 is no length > 0", [](auto& s) { s.sources.background.node_size[1].length = 0; }},
      {"/st/background/tet: row 3 names entity 4 of", [](auto& s) { s.sources.background.tets[0][3] = 4; }}};
  expect_refused_by_both(path, good, breaks);
}

TEST(SizingDamage, is_refused_by_both_readers) {
  static constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const TemporaryDirectory dir;
  const std::string path = dir / "a.hdf";
  write_sizing(path, split_sizing());
  EXPECT_NO_THROW(read_sizing(path));
  EXPECT_NO_THROW(map_sizing(path));
  const ArtifactBreaks<SizingArtifact> breaks = {
      {"/st/split/leaf: row 1 names entity 1000000 of", [](auto& s) { s.blanking.split_leaf[1] = 1'000'000; }},
      {"/st/split/leaf: does not ascend at row 1", [](auto& s) { s.blanking.split_leaf[1] = 3; }},
      {"/st/split/plane: row 0 is not a plane", [](auto& s) { s.blanking.split[0].margin = kNan; }},
      {"/st/split/cell: row 1 is not a finite length > 0", [](auto& s) { s.lengths.second_cells[1].length = kNan; }},
      {"/st/octree/frame: row 12 is not finite", [](auto& s) { s.frame.translation.z = kNan; }},
      {"/st/octree/frame: its scale is not positive", [](auto& s) { s.frame.scale = -1; }}};
  expect_refused_by_both(path, split_sizing(), breaks);
}

TEST(SizingDamage, of_lengths_that_are_mapped_is_refused) {
  const TemporaryDirectory dir;
  const std::string path = dir / "a.hdf";
  const ArtifactBreaks<SizingArtifact> breaks = {
      {"/st/octree/cause: has ", [](auto& s) { s.lengths.cause.pop_back(); }},
      {"/st/split/cause: has ", [](auto& s) { s.lengths.second_cause.pop_back(); }}};
  for (const auto& [says, break_it] : breaks) {
    SizingArtifact sizing = split_sizing();
    break_it(sizing);
    write_sizing(path, sizing);
    EXPECT_ERROR(map_sizing(path), kInput, path + ": " + says);
  }
  write_sizing(path, split_sizing());
  copy_artifact(Hdf5Reader(path), path, [](const std::string& name, auto& values, std::size_t) {
    if constexpr (std::is_same_v<decltype(values), std::vector<double>&>)
      if (name == "/st/sizing@smallest_length") values[0] = -1;
    return true;
  });
  EXPECT_ERROR(map_sizing(path), kInput, path + ": /st/sizing@smallest_length: is no length");
}

TEST(SizingDamage, of_stretched_samples_is_refused) {
  const TemporaryDirectory dir;
  RasterArtifact raster = sample_raster();
  raster.numbers.max_aspect = 8;
  raster.samples[1].stretch.along = -1;
  write_raster(dir / "r.hdf", raster);
  EXPECT_ERROR(read_raster(dir / "r.hdf"), kInput, "/st/sample/along: row 1 is not a finite number of at least 0");
}

TEST(SizingDamage, is_not_what_an_older_tool_wrote) {
  const TemporaryDirectory dir;
  const std::string path = dir / "a.hdf";
  Hdf5Writer(path, header_of("raster", 1)).commit();
  EXPECT_ERROR(read_raster(path), kInput, "schema version 1 of an older st-raster; run st-raster again");
  Hdf5Writer(path, header_of("sizing", 6)).commit();
  const char* says = "schema version 6 of an older st-prolong; run st-prolong again";
  EXPECT_ERROR(read_sizing(path), kInput, says);
  EXPECT_ERROR(map_sizing(path), kInput, says);
  EXPECT_ERROR(read_cause_names(path), kInput, says);
}

/// Writes the artifact again, its dataset `name` with the last row twice.
void repeat_last_row(const std::string& path, const std::string& name) {
  copy_artifact(Hdf5Reader(path), path, [&](const std::string& of, auto& values, std::size_t columns) {
    if (of == name) {
      const std::vector<std::decay_t<decltype(values[0])>> row(values.end() - static_cast<std::ptrdiff_t>(columns),
                                                               values.end());
      values.insert(values.end(), row.begin(), row.end());
    }
    return true;
  });
}

TEST(PatchesDamage, is_refused_patch_by_patch) {
  const TemporaryDirectory dir;
  const std::string path = dir / "p.hdf";
  const auto read_shapes = [&] {
    const PatchesFile file(path);
    for (std::size_t i = 0; i < file.n_patches(); ++i) file.shape(i);
  };
  const ArtifactBreaks<PatchesArtifact> breaks = {
      {"/st/patch/face: row 1 names entity 2 of 2", [](auto& p) { p.patches[1].face = 2; }},
      {"/st/inner/xyz: row 0 is not finite", [](auto& p) { p.patches[0].inner_xyz[0].y = std::nan(""); }},
      {"/st/triangle/nodes: patch of face 1 has no node 6", [](auto& p) { p.patches[0].triangles[0].n[1] = 6; }}};
  write_patches(path, sample_patches());
  EXPECT_NO_THROW(read_shapes());
  for (const auto& [says, break_it] : breaks) {
    PatchesArtifact patches = sample_patches();
    break_it(patches);
    write_patches(path, patches);
    EXPECT_ERROR(read_shapes(), kInput, path + ": " + says);
  }
  write_patches(path, sample_patches());
  repeat_last_row(path, "/st/inner/size");
  EXPECT_ERROR(read_shapes(), kInput, path + ": /st/inner/size: has 2 rows, not 1");
}

TEST(MeshDamage, of_connectivity_is_refused) {
  const TemporaryDirectory dir;
  const std::string path = dir / "m.hdf";
  write_mesh(path, sample_mesh());
  EXPECT_NO_THROW(read_mesh_part(path, 0, 1));
  repeat_last_row(path, "/VTKHDF/Connectivity");
  EXPECT_ERROR(read_mesh(path), kInput, path + ": /VTKHDF/Connectivity: is not made of triangles");
  for (const auto& [node, says] : {std::pair(4, "names node 4"), {-1, "names node -1"}}) {
    MeshArtifact mesh = sample_mesh();
    mesh.mesh.triangles[3].n[2] = node;
    write_mesh(path, mesh);
    EXPECT_ERROR(read_mesh_part(path, 0, 1), kInput, std::string("/VTKHDF/Connectivity: ") + says);
  }
}

}  // namespace
}  // namespace st
