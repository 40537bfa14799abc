#include "base/equal_points.h"

#include <bit>
#include <numeric>

#include "base/radix_sort.h"

namespace st {
namespace {

struct Place {
  std::uint64_t key;
  std::int32_t node;
};

}  // namespace

std::uint64_t hash_of_place(Vec3 x) {
  std::uint64_t key = 0;
  for (const double value : {x.x, x.y, x.z}) {
    key ^= std::bit_cast<std::uint64_t>(value + 0.0);  // -0 becomes 0
    key *= 0x9e3779b97f4a7c15u;                        // 2^64 over the golden ratio, as Knuth's hashing has it
    key ^= key >> 29;
  }
  return key;
}

void join_equal_points(std::span<const Vec3> x, std::vector<std::array<std::int32_t, 3>>& corners) {
  std::vector<Place> places, other;
  places.reserve(x.size());
  for (const Vec3 place : x) places.push_back({hash_of_place(place), static_cast<std::int32_t>(places.size())});
  radix_sort(places, other, [](const Place& p) { return p.key; });
  std::vector<std::int32_t> first(x.size());
  std::iota(first.begin(), first.end(), 0);
  for (std::size_t begin = 0, end; begin < places.size(); begin = end) {
    for (end = begin; end < places.size() && places[end].key == places[begin].key; ++end)
      for (std::size_t i = begin; i < end; ++i)
        if (x[places[i].node] == x[places[end].node]) {
          first[places[end].node] = first[places[i].node];
          break;
        }
  }
  for (auto& c : corners)
    for (std::int32_t& n : c) n = first[n];
}

}  // namespace st
