#include "io/hdf5/hdf5_open.h"

#include <algorithm>
#include <set>
#include <utility>

#include "base/error.h"

namespace st {
namespace {

// No library named by HDF5_PLUGIN_PATH is loaded, whatever filter a file asks for.
[[maybe_unused]] const herr_t kNoPlugins = H5PLset_loading_state(0);

bool is_own_filter(H5Z_filter_t filter) {
  return filter == H5Z_FILTER_DEFLATE || filter == H5Z_FILTER_SHUFFLE || filter == H5Z_FILTER_FLETCHER32 ||
         filter == H5Z_FILTER_SZIP || filter == H5Z_FILTER_NBIT || filter == H5Z_FILTER_SCALEOFFSET;
}

std::string filter_defect(hid_t creation, Hdf5Origin origin) {
  const int n = H5Pget_nfilters(creation);
  for (int i = 0; i < n; ++i) {
    unsigned flags = 0, config = 0;
    std::size_t n_values = 0;
    const H5Z_filter_t filter =
        H5Pget_filter2(creation, static_cast<unsigned>(i), &flags, &n_values, nullptr, 0, nullptr, &config);
    if (origin == Hdf5Origin::kArtifact || !is_own_filter(filter))
      return "is stored with filter " + std::to_string(filter);
  }
  return n < 0 ? "has filters that cannot be read" : "";
}

/// Walks through the hard links of a file, each group once.
class Walk {
 public:
  Walk(hid_t file, const std::string& path) : file_(file), path_(path) {}

  void visit(const std::string& name, int depth) {
    constexpr int kMaxDepth = 32;
    const hid_t object = H5Oopen(file_, name.c_str(), H5P_DEFAULT);
    if (object < 0) fail(name, "cannot be opened");
    H5O_info_t info{};
    if (H5Oget_info2(object, &info, H5O_INFO_BASIC) < 0) fail(name, "cannot be read");
    if (info.type == H5O_TYPE_DATASET) {
      if (const std::string defect = storage_defect(object, Hdf5Origin::kForeign); !defect.empty()) fail(name, defect);
    } else if (info.type == H5O_TYPE_GROUP && seen_.insert(info.addr).second) {
      if (depth > kMaxDepth) fail(name, "lies too deep");
      visit_links(object, name, depth);
    }
    if (++n_objects_ > kMaxObjects) fail(name, "is one of more than " + std::to_string(kMaxObjects) + " objects");
    H5Oclose(object);
  }

 private:
  [[noreturn]] void fail(const std::string& name, const std::string& what) const {
    H5Fclose(file_);
    throw Error(ExitCode::kInput, path_ + ": " + name + " " + what + "; write the file again, plainly and as one file");
  }

  void visit_links(hid_t group, const std::string& name, int depth) {
    const auto names = link_names(group, kMaxObjects);
    if (!names) fail(name, "cannot be listed");
    for (const std::string& child : *names) {
      const std::string child_name = (name == "/" ? "" : name) + "/" + child;
      if (const std::string defect = link_defect(group, child, Hdf5Origin::kForeign); !defect.empty())
        fail(child_name, defect);
      H5L_info_t link{};
      H5Lget_info(group, child.c_str(), &link, H5P_DEFAULT);
      if (link.type == H5L_TYPE_HARD) visit(child_name, depth + 1);
    }
  }

  static constexpr int kMaxObjects = 10000;
  hid_t file_;
  const std::string& path_;
  std::set<haddr_t> seen_;
  int n_objects_ = 0;
};

}  // namespace

hid_t open_hdf5(const std::string& path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // its messages, per thread
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  H5Pset_file_locking(access, false, true);
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access);
  H5Pclose(access);
  return file;
}

std::optional<std::vector<std::string>> link_names(hid_t group, std::size_t most) {
  H5G_info_t info{};
  if (H5Gget_info(group, &info) < 0 || info.nlinks > most) return std::nullopt;
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* names) -> herr_t {
    static_cast<std::vector<std::string>*>(names)->emplace_back(name);
    return 0;
  };
  std::vector<std::string> names;
  // As they come: asked to sort them, HDF5 1.10 crashes over a damaged heap.
  if (H5Literate(group, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, add, &names) < 0) return std::nullopt;
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> names_in(hid_t file, const char* group) {
  constexpr std::size_t kMost = 1000;
  const hid_t opened = H5Gopen2(file, group, H5P_DEFAULT);
  if (opened < 0) return {};
  std::vector<std::string> names = link_names(opened, kMost).value_or(std::vector<std::string>());
  H5Gclose(opened);
  return names;
}

std::string link_defect(hid_t group, const std::string& name, Hdf5Origin origin) {
  H5L_info_t link{};
  if (H5Lget_info(group, name.c_str(), &link, H5P_DEFAULT) < 0) return "cannot be read";
  if (link.type == H5L_TYPE_HARD) return "";
  if (link.type == H5L_TYPE_SOFT) return origin == Hdf5Origin::kForeign ? "" : "is a link to another name";
  return link.type == H5L_TYPE_EXTERNAL ? "is a link to another file" : "is a link of an unknown kind";
}

std::string storage_defect(hid_t dataset, Hdf5Origin origin) {
  const hid_t creation = H5Dget_create_plist(dataset);
  if (creation < 0) return "cannot be read";
  const H5D_layout_t layout = H5Pget_layout(creation);
  std::string defect = filter_defect(creation, origin);
  if (layout != H5D_CONTIGUOUS && origin == Hdf5Origin::kArtifact) defect = "is not stored in one piece";
  if (layout == H5D_VIRTUAL) defect = "is put together from other files";
  if (layout == H5D_CONTIGUOUS && H5Pget_external_count(creation) != 0) defect = "is stored in another file";
  H5Pclose(creation);
  return defect;
}

void require_self_contained(hid_t file, const std::string& path) { Walk(file, path).visit("/", 0); }

}  // namespace st
