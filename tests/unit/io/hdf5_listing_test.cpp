// list_artifact(): the header before the parts, places of values; what is kept, and when it no longer holds.
#include "io/hdf5/hdf5_listing.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>

#include "base/error.h"
#include "io/hdf5/kept_listings.h"
#include "unit/io/sample_artifacts.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

std::shared_ptr<const Hdf5Listing> listing_of(const std::string& path) {
  return list_artifact(path, [](const Hdf5Listing&) {});
}

void write_doubles(const std::string& path, const std::vector<double>& values) {
  ArtifactHeader header;
  header.schema = "sizing";
  header.tool = "st-prolong";
  Hdf5Writer writer(path, header);
  writer.write("/st/values", values);
  writer.write("/st/none", std::vector<int>());
  writer.commit();
}

/// Whether `test` holds in a process of its own: what is kept there is not kept here.
bool holds_apart(const std::function<bool()>& test) {
  const pid_t child = fork();
  if (child == 0) _exit(test() ? 0 : 1);
  int status = 0;
  return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(Hdf5Listing, says_where_the_values_are) {
  const TemporaryDirectory dir;
  const std::string path = dir / "a.hdf";
  const std::vector<double> values = {1.5, -2, 1e300};
  write_doubles(path, values);
  const auto listing = listing_of(path);
  std::ifstream file(path, std::ios::binary);
  file.seekg(listing->places.at("/st/values").offset);
  double read[3] = {};
  file.read(reinterpret_cast<char*>(read), sizeof read);
  EXPECT_EQ(std::memcmp(read, values.data(), sizeof read), 0);
  EXPECT_EQ(listing->places.at("/st/values").width, sizeof(double));
  EXPECT_EQ(listing->places.at("/st/none").offset, -1);
  EXPECT_EQ(listing->find("/st/nowhere"), nullptr);
}

TEST(Hdf5Listing, lets_the_header_be_refused_before_parts_are_looked_at) {
  const TemporaryDirectory dir;
  write_doubles(dir / "a.hdf", {1});
  const auto refuse = [](const Hdf5Listing& file) {
    EXPECT_EQ(file.header.schema, "sizing");
    EXPECT_TRUE(file.datasets.empty());
    throw Error(ExitCode::kInput, "refused");
  };
  EXPECT_THROW(list_artifact(dir / "a.hdf", refuse), Error);
}

TEST(Hdf5Listing, is_made_anew_unless_it_is_kept) {
  const TemporaryDirectory dir;
  write_doubles(dir / "a.hdf", {1});
  const auto first = listing_of(dir / "a.hdf");
  EXPECT_NE(listing_of(dir / "a.hdf"), first);
  EXPECT_EQ(kept_listing(dir / "a.hdf"), nullptr);
}

TEST(Hdf5Listing, is_kept_while_the_file_stays) {
  const TemporaryDirectory dir;
  const std::string path = dir / "a.hdf";
  write_doubles(path, {1});
  EXPECT_TRUE(holds_apart([&] {
    keep_listings();
    return kept_listing(path) == nullptr && listing_of(path) == listing_of(path) && kept_listing(path) != nullptr &&
           header_of_artifact(path).content_hash == listing_of(path)->header.content_hash;
  }));
}

TEST(Hdf5Listing, of_a_file_that_was_written_here_is_that_of_the_file) {
  const TemporaryDirectory dir;
  const std::string path = dir / "a.hdf";
  EXPECT_TRUE(holds_apart([&] {
    keep_listings();
    write_doubles(path, {1, 2, 3});
    const auto kept = kept_listing(path);
    std::filesystem::copy_file(path, dir / "b.hdf");
    const auto read = listing_of(dir / "b.hdf");
    return kept && kept->datasets.size() == 2 && kept->file_bytes == read->file_bytes &&
           kept->header.content_hash == read->header.content_hash && kept->header.schema == read->header.schema &&
           kept->attributes.size() == read->attributes.size() &&
           std::ranges::equal(kept->places, read->places, [](const auto& a, const auto& b) {
             return a.first == b.first && a.second.offset == b.second.offset && a.second.width == b.second.width;
           });
  }));
}

TEST(Hdf5Listing, of_another_file_by_the_same_name_is_another) {
  const TemporaryDirectory dir;
  const std::string path = dir / "a.hdf";
  write_doubles(path, {1});
  EXPECT_TRUE(holds_apart([&] {
    keep_listings();
    const auto first = listing_of(path);
    write_doubles(path, {1, 2});
    return kept_listing(path) != first && listing_of(path)->find("/st/values")->shape[0] == 2 &&
           header_of_artifact(path).content_hash != first->header.content_hash;
  }));
}

}  // namespace
}  // namespace st
