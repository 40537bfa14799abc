// Model::contacts(): where two faces meet although they share nothing there.
#include <fmt/format.h>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>

#include <atomic>

#include "base/boxes.h"
#include "base/child_process.h"
#include "base/error.h"
#include "base/log.h"
#include "base/packer.h"
#include "geometry/brep/loaded_module.h"
#include "geometry/model/face_sections.h"
#include "geometry/model/model.h"
#include "geometry/model/model_impl.h"

namespace st {
namespace {

constexpr double kMostSeconds = 10;  // for two faces: damaged surfaces may take OpenCASCADE for ever, or crash it
constexpr int kMostGivenUp = 3;      // pairs of faces; then no more are tried

/// Of the bytes that a child gives back.
std::vector<FaceContact> contacts_of(const std::string& text) {
  const Bytes bytes(reinterpret_cast<const Bytes::value_type*>(text.data()),
                    reinterpret_cast<const Bytes::value_type*>(text.data()) + text.size());
  std::vector<FaceContact> contacts;
  unpack(bytes, contacts);
  return contacts;
}

}  // namespace

std::vector<FaceContact> Model::contacts(FaceId first, FaceId second) const {
  if (impl_->cad) {
    std::vector<FaceContact> all;
    for (const FaceId a : impl_->cad_faces(first))
      for (const FaceId b : impl_->cad_faces(second)) {
        const ModelTables& cad = impl_->cad->tables();
        if (a == b || !meet(cad.face_box[a], cad.face_box[b])) continue;
        std::vector<FaceContact> found = impl_->cad->contacts(a, b);
        all.insert(all.end(), found.begin(), found.end());
      }
    return all;
  }
  static std::atomic<int> n_given_up = 0;
  if (n_given_up >= kMostGivenUp || !facets_.empty()) return {};
  const TopoDS_Face a = TopoDS::Face(impl_->faces(first + 1)), b = TopoDS::Face(impl_->faces(second + 1));
  const auto find_sections =
      reinterpret_cast<SectionFunction>(occt::function_of_module("face_sections", kSectionFunction));
  const auto find = [&] {
    std::vector<FaceContact> found;
    find_sections(a, b, 1e-6 * tables_.box().diagonal(), found);
    const Bytes bytes = packed(found);
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  };
  try {
    return contacts_of(run_in_child(find, {kMostSeconds, "", 2 * kMostSeconds}, "damaged surfaces"));
  } catch (const Error&) {
    ++n_given_up;
    log_warning(
        fmt::format("where {} and {} meet was not found, OpenCASCADE crashed or took more than {} s: what "
                    "crosses there counts as a fault",
                    tables_.face_label(first), tables_.face_label(second), kMostSeconds));
  }
  return {};
}

}  // namespace st
