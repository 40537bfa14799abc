#include "geometry/brep/kept_surfaces.h"

#include <atomic>
#include <cstring>
#include <mutex>
#include <unordered_map>
#include <utility>

namespace st::occt {
namespace {

constexpr std::size_t kMostPoles = 200'000;  // of all that are kept: with their spans some 50 MB

bool are_equal(const SplineInput& a, const SplineInput& b) {
  return a.u_degree == b.u_degree && a.v_degree == b.v_degree && a.u_period == b.u_period && a.v_period == b.v_period &&
         a.is_rational == b.is_rational && a.u_flat == b.u_flat && a.v_flat == b.v_flat &&
         a.poles.size() == b.poles.size() &&
         std::memcmp(a.poles.data(), b.poles.data(), a.poles.size() * sizeof(Pole)) == 0;
}

class Store {
 public:
  std::unique_ptr<BsplineSurface> get(const Handle(Geom_BSplineSurface) & original, SplineInput&& in,
                                      const Box2& bounds) {
    {
      const std::lock_guard lock(mutex_);
      if (const auto own = kept_.find(original.get()); own != kept_.end() && are_equal(own->second.input, in))
        return own->second.surface->within(bounds);
    }
    std::unique_ptr<BsplineSurface> made = surface_of(in, bounds);  // perhaps by several threads: all of them the same
    const std::lock_guard lock(mutex_);
    if (n_poles_ + in.poles.size() > kMostPoles) return made;
    n_poles_ += in.poles.size();
    kept_.insert_or_assign(original.get(), Kept{original, std::move(in), made->within(bounds)});
    return made;
  }

 private:
  struct Kept {
    Handle(Geom_BSplineSurface) original;  // no other one gets its address
    SplineInput input;
    std::unique_ptr<BsplineSurface> surface;
  };
  std::mutex mutex_;
  std::unordered_map<const Geom_BSplineSurface*, Kept> kept_;
  std::size_t n_poles_ = 0;
};

std::atomic<Store*> g_store = nullptr;

}  // namespace

KeptSurfaces::KeptSurfaces() { g_store = new Store; }

KeptSurfaces::~KeptSurfaces() { delete g_store.exchange(nullptr); }

std::unique_ptr<BsplineSurface> surface_of(SplineInput in, const Box2& bounds) {
  const int n_v = in.n_v();
  return std::make_unique<BsplineSurface>(KnotSpans(in.u_degree, in.u_flat, in.u_period),
                                          KnotSpans(in.v_degree, in.v_flat, in.v_period), std::move(in.poles), n_v,
                                          in.is_rational, bounds);
}

std::unique_ptr<BsplineSurface> surface_of(const Handle(Geom_BSplineSurface) & original, SplineInput input,
                                           const Box2& bounds) {
  Store* const store = g_store;
  return store ? store->get(original, std::move(input), bounds) : surface_of(std::move(input), bounds);
}

}  // namespace st::occt
