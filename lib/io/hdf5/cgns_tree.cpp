#include "io/hdf5/cgns_tree.h"

#include <hdf5.h>

#include <algorithm>
#include <cstring>

#include "base/error.h"

namespace st {
namespace {

[[noreturn]] void fail(const std::string& what) {
  throw Error(ExitCode::kInternal, "HDF5 cannot write " + what + " of a CGNS file");
}

hid_t require(hid_t id, const std::string& what) {
  if (id < 0) fail(what);
  return id;
}

/// A string attribute of this many bytes, its end among them.
void set_text(hid_t group, const char* name, const std::string& text, std::size_t size) {
  const hid_t type = require(H5Tcopy(H5T_C_S1), name), space = require(H5Screate(H5S_SCALAR), name);
  H5Tset_size(type, size);
  std::string padded = text;
  padded.resize(size, '\0');
  const hid_t attribute = require(H5Acreate2(group, name, type, space, H5P_DEFAULT, H5P_DEFAULT), name);
  const herr_t status = H5Awrite(attribute, type, padded.data());
  H5Aclose(attribute);
  H5Sclose(space);
  H5Tclose(type);
  if (status < 0) fail(name);
}

void set_flags(hid_t group) {
  const hsize_t n = 1;
  const std::int32_t flags = 1;
  const hid_t space = require(H5Screate_simple(1, &n, nullptr), "flags");
  const hid_t attribute = require(H5Acreate2(group, "flags", H5T_STD_I32LE, space, H5P_DEFAULT, H5P_DEFAULT), "flags");
  const herr_t status = H5Awrite(attribute, H5T_NATIVE_INT32, &flags);
  H5Aclose(attribute);
  H5Sclose(space);
  if (status < 0) fail("flags");
}

void write_data(hid_t group, const char* name, hid_t type, const void* values,
                const std::vector<std::uint64_t>& shape) {
  const std::vector<hsize_t> dims(shape.begin(), shape.end());
  const hid_t space = require(H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr), name);
  const hid_t properties = require(H5Pcreate(H5P_DATASET_CREATE), name);
  H5Pset_obj_track_times(properties, false);
  const hid_t set = require(H5Dcreate2(group, name, type, space, H5P_DEFAULT, properties, H5P_DEFAULT), name);
  const herr_t status = H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
  H5Dclose(set);
  H5Pclose(properties);
  H5Sclose(space);
  if (status < 0) fail(name);
}

/// Sizes of the attributes of every node, by the mapping.
constexpr std::size_t kNameSize = 33, kTypeSize = 3;

}  // namespace

struct CgnsTree::Impl {
  hid_t file = -1;
  std::vector<hid_t> groups;  ///< all open, the root first

  ~Impl() {
    for (const hid_t g : groups) H5Gclose(g);
    if (file >= 0) H5Fclose(file);
  }

  Node create(Node parent, const std::string& name, const std::string& label, const char* type) {
    const hid_t properties = require(H5Pcreate(H5P_GROUP_CREATE), name);
    H5Pset_link_creation_order(properties, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);  // the order is the tree's
    H5Pset_obj_track_times(properties, false);
    const hid_t links = require(H5Pcreate(H5P_LINK_CREATE), name);
    H5Pset_char_encoding(links, H5T_CSET_UTF8);
    const hid_t group = require(
        H5Gcreate2(groups[static_cast<std::size_t>(parent)], name.c_str(), links, properties, H5P_DEFAULT), name);
    groups.push_back(group);
    H5Pclose(links);
    H5Pclose(properties);
    set_text(group, "name", name, kNameSize);
    set_text(group, "label", label, kNameSize);
    set_text(group, "type", type, kTypeSize);
    set_flags(group);
    return static_cast<Node>(groups.size()) - 1;
  }
};

CgnsTree::CgnsTree() : impl_(std::make_unique<Impl>()) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  constexpr std::size_t kGrowth = 1 << 20;
  const hid_t access = require(H5Pcreate(H5P_FILE_ACCESS), "the head");
  H5Pset_fapl_core(access, kGrowth, false);
  const hid_t creation = require(H5Pcreate(H5P_FILE_CREATE), "the head");
  H5Pset_link_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  H5Pset_obj_track_times(creation, false);
  impl_->file = require(H5Fcreate("in memory.cgns", H5F_ACC_TRUNC, creation, access), "the head");
  H5Pclose(creation);
  H5Pclose(access);
  const hid_t root = require(H5Gopen2(impl_->file, "/", H5P_DEFAULT), "the head");
  impl_->groups.push_back(root);
  set_text(root, "name", "HDF5 MotherNode", kNameSize);
  set_text(root, "label", "Root Node of HDF5 File", kNameSize);
  set_text(root, "type", "MT", kTypeSize);
  const std::string format("IEEE_LITTLE_32\0", 15);
  std::string version = "HDF5 Version 1.10";
  version.resize(kNameSize, '\0');
  write_data(root, " format", H5T_STD_I8LE, format.data(), {format.size()});
  write_data(root, " hdf5version", H5T_STD_I8LE, version.data(), {version.size()});
  constexpr float kLibraryVersion = 3.3F;  // of the layout
  const Node node = impl_->create(0, "CGNSLibraryVersion", "CGNSLibraryVersion_t", "R4");
  write_data(impl_->groups[static_cast<std::size_t>(node)], " data", H5T_IEEE_F32LE, &kLibraryVersion, {1});
}

CgnsTree::~CgnsTree() = default;

CgnsTree::Node CgnsTree::root() const { return 0; }

CgnsTree::Node CgnsTree::add(Node parent, const std::string& name, const std::string& label) {
  return impl_->create(parent, name, label, "MT");
}

CgnsTree::Node CgnsTree::add_text(Node parent, const std::string& name, const std::string& label,
                                  const std::string& text, std::vector<std::uint64_t> shape) {
  const Node node = impl_->create(parent, name, label, "C1");
  if (shape.empty()) shape = {text.size()};
  write_data(impl_->groups[static_cast<std::size_t>(node)], " data", H5T_STD_I8LE, text.data(), shape);
  return node;
}

CgnsTree::Node CgnsTree::add_integers(Node parent, const std::string& name, const std::string& label,
                                      const std::vector<std::int32_t>& values, std::vector<std::uint64_t> shape) {
  const Node node = impl_->create(parent, name, label, "I4");
  if (shape.empty()) shape = {values.size()};
  write_data(impl_->groups[static_cast<std::size_t>(node)], " data", H5T_STD_I32LE, values.data(), shape);
  return node;
}

CgnsTree::Node CgnsTree::add_reals(Node parent, const std::string& name, const std::string& label,
                                   const std::vector<double>& values) {
  const Node node = impl_->create(parent, name, label, "R8");
  write_data(impl_->groups[static_cast<std::size_t>(node)], " data", H5T_IEEE_F64LE, values.data(), {values.size()});
  return node;
}

CgnsTree::Node CgnsTree::add_single_reals(Node parent, const std::string& name, const std::string& label,
                                          const std::vector<float>& values) {
  const Node node = impl_->create(parent, name, label, "R4");
  write_data(impl_->groups[static_cast<std::size_t>(node)], " data", H5T_IEEE_F32LE, values.data(), {values.size()});
  return node;
}

std::string CgnsTree::bytes() {
  if (H5Fflush(impl_->file, H5F_SCOPE_GLOBAL) < 0) fail("the file");
  const ssize_t size = H5Fget_file_image(impl_->file, nullptr, 0);
  if (size < 0) fail("the file");
  std::string image(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(impl_->file, image.data(), image.size()) != size) fail("the file");
  return image;
}

}  // namespace st
