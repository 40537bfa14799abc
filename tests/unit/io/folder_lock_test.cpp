#include "io/file/folder_lock.h"

#include <gtest/gtest.h>

#include <optional>

#include "base/error.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

TEST(FolderLock, one_run_holds_a_folder) {
  const TemporaryDirectory a, b;
  std::optional<FolderLock> first(a.path());
  EXPECT_ERROR(FolderLock{a.path()}, kOutput, "another run is working in this folder");
  const FolderLock other(b.path());
  first.reset();
  const FolderLock next(a.path());
}

TEST(FolderLock, what_cannot_be_locked_is_not_guarded) {
  const TemporaryDirectory a;
  EXPECT_NO_THROW(FolderLock{a / "none"});
}

}  // namespace
}  // namespace st
