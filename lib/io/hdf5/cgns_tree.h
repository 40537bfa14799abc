// A tree of CGNS nodes as bytes of an HDF5 file, by the published mapping of CGNS onto HDF5.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace st {

/// CGNS nodes in the order in which they are added. Written without dates, so that equal nodes give equal bytes, which
/// the CGNS library cannot do. All functions throw Error(kInternal) when HDF5 fails.
class CgnsTree {
 public:
  /// A place in the tree.
  using Node = std::int64_t;

  CgnsTree();
  ~CgnsTree();
  CgnsTree(const CgnsTree&) = delete;
  CgnsTree& operator=(const CgnsTree&) = delete;

  Node root() const;
  /// A node without data. `name`: 1 to 32 bytes, without '/', that no sibling has; `label`: of the SIDS, "Zone_t".
  Node add(Node parent, const std::string& name, const std::string& label);
  /// Nodes with data; `shape` as HDF5 has it (slowest first), empty: as many as there are.
  Node add_text(Node parent, const std::string& name, const std::string& label, const std::string& text,
                std::vector<std::uint64_t> shape = {});
  Node add_integers(Node parent, const std::string& name, const std::string& label,
                    const std::vector<std::int32_t>& values, std::vector<std::uint64_t> shape = {});
  Node add_reals(Node parent, const std::string& name, const std::string& label, const std::vector<double>& values);
  /// In single precision (R4), where the mapping takes no other.
  Node add_single_reals(Node parent, const std::string& name, const std::string& label,
                        const std::vector<float>& values);

  /// The bytes of the file. Nothing may be added afterwards.
  std::string bytes();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace st
