// Patches written by several processes into one artifact.
#include "io/hdf5/patches_writer.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/packer.h"
#include "unit/io/sample_artifacts.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

std::vector<PatchCounts> counts_of(const PatchesArtifact& a) {
  std::vector<PatchCounts> counts;
  for (const FacePatch& p : a.patches) counts.push_back(st::counts_of(p));
  return counts;
}

TEST(PatchesWriter, makes_the_bytes_of_one_process_whoever_writes_which_patch) {
  const TemporaryDirectory dir;
  const PatchesArtifact a = sample_patches();
  ASSERT_GT(a.patches.size(), 1u);
  const std::string hash = write_patches(dir / "one.hdf", a);
  PatchesArtifact rest = a;
  rest.patches.clear();
  PatchesWriter writer(dir / "some.hdf", rest, counts_of(a));
  const Bytes message = packed(writer.target());  // to another rank
  PatchTarget there;
  unpack(message, there);
  PatchRowsFile here(writer.target()), far(there);
  for (std::size_t i = a.patches.size(); i-- > 0;) (i % 2 ? here : far).write(i, a.patches[i]);
  here.close();
  far.close();
  EXPECT_EQ(writer.commit(), hash);
  EXPECT_EQ(read_bytes(dir / "some.hdf"), read_bytes(dir / "one.hdf"));
}

TEST(PatchesWriter, writes_large_patches_in_pieces) {
  const TemporaryDirectory dir;
  PatchesArtifact a = sample_patches();
  FacePatch& p = a.patches.back();
  constexpr std::size_t kMany = 400'000;  // 9.6 MB of coordinates
  for (std::size_t i = p.inner_xyz.size(); i < kMany; ++i) {
    const auto x = static_cast<double>(i);
    p.inner_xyz.push_back({x, 0.5 * x, -x});
    p.inner_uv.push_back({x, -x});
    p.inner_size.push_back(1 + x);
  }
  p.inner_previous.resize(kMany, kNone);  // the sample was remeshed
  write_patches(dir / "large.hdf", a);
  const PatchesArtifact back = read_patches(dir / "large.hdf");
  EXPECT_EQ(back.patches.back().inner_xyz, p.inner_xyz);
  EXPECT_EQ(back.patches.back().inner_uv, p.inner_uv);
  EXPECT_EQ(back.patches.back().inner_size, p.inner_size);
}

TEST(PatchesWriter, leaves_nothing_without_commit) {
  const TemporaryDirectory dir;
  const PatchesArtifact a = sample_patches();
  {
    const PatchesWriter writer(dir / "p.hdf", a, counts_of(a));
    PatchRowsFile rows(writer.target());
    rows.write(0, a.patches[0]);
  }
  EXPECT_TRUE(std::filesystem::is_empty(dir / ""));
}

}  // namespace
}  // namespace st
