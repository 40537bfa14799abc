// Opening HDF5 files from strangers. Internal to io.
#pragma once

#include <hdf5.h>

#include <optional>
#include <string>
#include <vector>

namespace st {

/// HDF5 1.10 keeps a file whose closing failed (disk full) and crashes over it at exit. Its clean-up is not needed:
/// every file is closed by its handle. Set here, before whatever else calls HDF5 first.
inline const herr_t kNoCleanUp = H5dont_atexit();

/// Opens for reading, without HDF5's messages, locks and plug-ins; negative when it cannot. Closing the file closes
/// what was opened in it.
hid_t open_hdf5(const std::string& path);

/// Names of the links of a group, ascending. In one pass: asked for by number, HDF5 sorts all of them each time.
/// nullopt: they cannot be read, or are more than `most`.
std::optional<std::vector<std::string>> link_names(hid_t group, std::size_t most);
/// Of the group of this path, for a message; empty where there is none, or it has more than 1000.
std::vector<std::string> names_in(hid_t file, const char* group);

/// What makes a link or the storage of a dataset lead out of the file, or need code from elsewhere; "" when nothing.
/// Artifacts are plainer: hard links, contiguous data, no filters. Files of other programs may have soft links, chunks
/// and the filters of HDF5 itself.
enum class Hdf5Origin { kArtifact, kForeign };
std::string link_defect(hid_t group, const std::string& name, Hdf5Origin origin);
std::string storage_defect(hid_t dataset, Hdf5Origin origin);

/// Throws Error(kInput), with the name of the link or dataset, unless all of a file of another program lies in it.
void require_self_contained(hid_t file, const std::string& path);

}  // namespace st
