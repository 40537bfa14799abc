// Findings of the import: their texts, and how they are read back.
#include "geometry/model/finding.h"

#include <gtest/gtest.h>

#include <set>

namespace st {
namespace {

constexpr int kKinds = static_cast<int>(FindingKind::kUnread) + 1;

TEST(Finding, every_kind_has_its_own_name_and_comes_back_as_it_was_stored) {
  std::set<std::string> names;
  for (int k = 0; k < kKinds; ++k) {
    ImportFinding f;
    f.kind = static_cast<FindingKind>(k);
    names.insert(name_of(f.kind));
    f.detail = "7 of 9 (x)";
    ImportFinding g;
    restore_kind(g, static_cast<std::uint8_t>(f.kind), f.detail, "worded in another way");
    EXPECT_EQ(g.kind, f.kind) << f.what();
    EXPECT_EQ(g.what(), f.what());
  }
  names.insert(name_of(FindingKind::kOther));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kKinds) + 1);
}

TEST(Finding, the_text_says_what_is_particular) {
  EXPECT_EQ((ImportFinding{FindingKind::kSewn, "", {}, 0, true, "14 free edges before, 0 after"}).what(),
            "sewn: 14 free edges before, 0 after");
}

TEST(Finding, a_text_of_another_version_stays_as_it_is) {
  for (const std::uint8_t kind : {std::uint8_t{kKinds}, std::uint8_t{200}, std::uint8_t{255}}) {
    ImportFinding f;
    restore_kind(f, kind, "new", "something new");
    EXPECT_EQ(f.kind, FindingKind::kOther);
    EXPECT_EQ(f.what(), "something new");
  }
}

}  // namespace
}  // namespace st
