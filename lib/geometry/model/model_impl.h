// The B-Rep behind a Model.
#pragma once

#include <Geom2d_Curve.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Shape.hxx>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <utility>
#include <vector>

#include "geometry/model/joined_tables.h"
#include "geometry/model/model.h"
#include "geometry/shape/composite_surface.h"

namespace st {

/// Curves or surfaces that were made once, by id: the next ones are their copies. For any thread.
template <class Shape>
class Originals {
 public:
  template <class Make>
  std::unique_ptr<Shape> get(std::int32_t id, const Make& make) {
    {
      const std::lock_guard lock(mutex_);
      if (const auto own = own_.find(id); own != own_.end()) return own->second->copy();
    }
    std::unique_ptr<Shape> made = make();  // perhaps by several threads: all of them the same
    if (std::unique_ptr<Shape> own = made->copy()) {
      const std::lock_guard lock(mutex_);
      own_.try_emplace(id, std::move(own));
    }
    return made;
  }

 private:
  std::mutex mutex_;
  std::unordered_map<std::int32_t, std::unique_ptr<Shape>> own_;
};

/// Trimming curves that OpenCASCADE makes whenever it is asked, by coedge. For any thread.
class MadeCurves2d {
 public:
  template <class Make>
  Handle(Geom2d_Curve) get(CoedgeId id, const Make& make) {
    {
      const std::lock_guard lock(mutex_);
      if (const auto own = own_.find(id); own != own_.end()) return own->second;
    }
    const Handle(Geom2d_Curve) made = make();  // perhaps by several threads: all of them the same
    const std::lock_guard lock(mutex_);
    return own_.try_emplace(id, made).first->second;
  }

 private:
  std::mutex mutex_;
  std::unordered_map<CoedgeId, Handle(Geom2d_Curve)> own_;
};

/// Charts of composites that were made once, by composite, without members: some of these cannot be copied. For any
/// thread.
class CompositeCharts {
 public:
  /// Of `members`; `make` returns one with members.
  template <class Make>
  std::unique_ptr<Surface> get(std::int32_t id, std::vector<std::unique_ptr<Surface>> members, const Make& make) {
    const CompositeSurface* known = nullptr;
    {
      const std::lock_guard lock(mutex_);
      if (const auto own = own_.find(id); own != own_.end()) known = own->second.get();
    }
    if (known) return known->with_members(std::move(members));
    std::unique_ptr<CompositeSurface> made = make(std::move(members));  // perhaps by several threads, all the same
    const std::lock_guard lock(mutex_);
    own_.try_emplace(id, made->with_members({}));
    return made;
  }

 private:
  std::mutex mutex_;
  std::unordered_map<std::int32_t, std::unique_ptr<CompositeSurface>> own_;
};

struct Model::Impl {
  TopoDS_Shape shape;
  TopTools_IndexedMapOfShape faces, edges;  ///< TopExp order of `shape`: the order of ids
  Originals<Curve> curves;
  Originals<Surface> surfaces;
  CompositeCharts composite_charts;
  MadeCurves2d pcurves_on_planes;
  // of a model with composites; its own shape and maps are empty then
  std::unique_ptr<const Model> cad;
  Composites composites;
  JoinedTables joined;  ///< but tables

  std::vector<FaceId> cad_faces(FaceId face) const {
    const std::int32_t i = joined.composite[face];
    if (i == kNone) return {face};
    const std::span<const FaceId> members = composites.members(i);
    return {members.begin(), members.end()};
  }
  std::unique_ptr<Curve> chain(EdgeId edge) const;
  std::unique_ptr<Surface> composite(std::int32_t composite, SurfaceType type, const double* bounds);
  std::unique_ptr<Curve2d> trimming(FaceId face, CoedgeId coedge, EdgeId edge) const;
  std::unique_ptr<Curve2d> rim(std::int32_t composite, CoedgeId cad_coedge) const;
};

namespace occt {

/// The bytes from which Model reads `shape` again.
std::vector<std::byte> brep_bytes(const TopoDS_Shape& shape);

}  // namespace occt
}  // namespace st
