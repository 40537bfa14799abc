#include "io/hdf5/wing_records_io.h"

#include <array>
#include <cstdint>
#include <string>

#include "io/hdf5/artifact_checks.h"

namespace st {
namespace {

constexpr const char* kStation = "/st/wing/station";  // nose, trailing, chord, asked
constexpr const char* kNumbers = "/st/wing/numbers";  // span, covered, base_cells, has_noses
constexpr std::size_t kStationColumns = 8, kNumberColumns = 4;

/// Ids of each wing, one after the other: "/st/wing/edge" and "/st/wing/edge_offset".
struct Lists {
  const char* name;
  std::vector<std::int32_t> WingRecord::*ids;
  const char* entities;  ///< a dataset with a row for each
};
constexpr std::array<Lists, 3> kLists = {{{"edge", &WingRecord::edges, "/st/edge/name"},
                                          {"face", &WingRecord::faces, "/st/face/name"},
                                          {"base", &WingRecord::bases, "/st/face/name"}}};

std::string path_of(const char* name) { return std::string("/st/wing/") + name; }
std::string offset_path(const char* name) { return path_of(name) + "_offset"; }

void add(std::vector<double>& row, Vec3 x) { row.insert(row.end(), {x.x, x.y, x.z}); }

/// Offsets of one list more than there are wings.
std::vector<std::int64_t> read_offsets(const Hdf5Reader& file, const char* name, std::size_t n_wings, std::size_t n) {
  const std::vector<std::int64_t> offsets = file.read_rows<std::int64_t>(offset_path(name), n_wings + 1);
  require_offsets(file, offset_path(name), offsets, n);
  return offsets;
}

WingRecord::Station station_of(const double* row) {
  return {{row[0], row[1], row[2]}, {row[3], row[4], row[5]}, row[6], row[7]};
}

void read_stations(const Hdf5Reader& file, std::vector<WingRecord>& wings) {
  const std::vector<double> rows = file.read<double>(kStation, kStationColumns);
  require_finite(file, kStation, rows);
  const auto offsets = read_offsets(file, "station", wings.size(), rows.size() / kStationColumns);
  for (std::size_t w = 0; w < wings.size(); ++w)
    for (std::int64_t i = offsets[w]; i < offsets[w + 1]; ++i) {
      wings[w].stations.push_back(station_of(rows.data() + kStationColumns * static_cast<std::size_t>(i)));
      const WingRecord::Station& s = wings[w].stations.back();
      if (!(s.chord > 0 && s.asked >= 0)) file.fail(kStation, "row " + std::to_string(i) + " has no chord > 0");
    }
}

}  // namespace

void write_wings(Hdf5Writer& file, const std::vector<WingRecord>& wings) {
  if (wings.empty()) return;
  std::vector<double> rows, numbers;
  std::vector<std::int64_t> offsets = {0};
  for (const WingRecord& wing : wings) {
    for (const WingRecord::Station& s : wing.stations) {
      add(rows, s.nose);
      add(rows, s.trailing);
      rows.insert(rows.end(), {s.chord, s.asked});
    }
    offsets.push_back(static_cast<std::int64_t>(rows.size() / kStationColumns));
    numbers.insert(numbers.end(), {wing.span, wing.covered, wing.base_cells, wing.has_noses ? 1.0 : 0.0});
  }
  file.write<double>(kStation, rows, kStationColumns);
  file.write<std::int64_t>(offset_path("station"), offsets);
  file.write<double>(kNumbers, numbers, kNumberColumns);
  for (const Lists& list : kLists) {
    std::vector<std::int32_t> ids;
    offsets = {0};
    for (const WingRecord& wing : wings) {
      const std::vector<std::int32_t>& own = wing.*list.ids;
      ids.insert(ids.end(), own.begin(), own.end());
      offsets.push_back(static_cast<std::int64_t>(ids.size()));
    }
    file.write<std::int32_t>(path_of(list.name), ids);
    file.write<std::int64_t>(offset_path(list.name), offsets);
  }
}

std::vector<WingRecord> read_wings(const Hdf5Reader& file) {
  if (!file.has(kStation)) return {};
  const std::vector<double> numbers = file.read<double>(kNumbers, kNumberColumns);
  require_finite(file, kNumbers, numbers);
  std::vector<WingRecord> wings(numbers.size() / kNumberColumns);
  for (std::size_t w = 0; w < wings.size(); ++w) {
    const double* row = numbers.data() + kNumberColumns * w;
    wings[w].span = row[0];
    wings[w].covered = row[1];
    wings[w].base_cells = row[2];
    wings[w].has_noses = row[3] != 0;
  }
  read_stations(file, wings);
  for (const Lists& list : kLists) {
    const std::vector<std::int32_t> ids = file.read<std::int32_t>(path_of(list.name));
    require_ids(file, path_of(list.name), ids, file.info(list.entities).shape[0]);
    const auto offsets = read_offsets(file, list.name, wings.size(), ids.size());
    for (std::size_t w = 0; w < wings.size(); ++w)
      (wings[w].*list.ids).assign(ids.begin() + offsets[w], ids.begin() + offsets[w + 1]);
  }
  return wings;
}

}  // namespace st
