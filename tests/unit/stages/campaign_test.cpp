#include "stages/campaign.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/file/text_file.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

constexpr const char* kPasses =
    "{\"passes\":true,\"triangles\":120,\"failed\":[],\"stages\":{\"st-check\":{\"quality\":{\"min\":0.5},"
    "\"lifting_surfaces\":[{\"held\":0.9},{\"held\":0.75}]}}}\n";
constexpr const char* kFails =
    "a line\n{\"passes\":false,\"triangles\":7,\"failed\":[\"folds\",\"closed\"],\"stages\":{\"st-check\":{\"quality\":"
    "{\"min\":0.1}}}}\n";
constexpr const char* kError =
    "{\"error\":\"st-import: a.step: is empty, <see>\",\"exit_code\":3,\"tool\":\"st-run\"}\n";

std::vector<CampaignRow> three_rows() {
  return {campaign_row("m/a.step", "a", 0, kPasses, 1.26), campaign_row("b.step", "b", 5, kFails, 2),
          campaign_row("c, \"d\".step", "c", 3, kError, 0.1)};
}

TEST(Campaign, a_row_says_how_the_mesh_is) {
  const CampaignRow row = three_rows()[0];
  EXPECT_EQ(row.verdict, "passes");
  EXPECT_EQ(row.reason, "");
  EXPECT_EQ(row.triangles, "120");
  EXPECT_EQ(row.surfaces, "2");
  EXPECT_EQ(row.held, "0.75");
  EXPECT_EQ(row.quality, "0.500");
  EXPECT_EQ(row.seconds, "1.3");
}

TEST(Campaign, failures_have_a_class) {
  EXPECT_EQ(three_rows()[1].verdict, "fails");
  EXPECT_EQ(three_rows()[1].reason, "folds closed");
  EXPECT_EQ(three_rows()[1].held, "");
  EXPECT_EQ(three_rows()[2].verdict, "error");
  EXPECT_EQ(three_rows()[2].reason, "st-import: input");
  EXPECT_EQ(three_rows()[2].message, "st-import: a.step: is empty, <see>");
  EXPECT_EQ(campaign_row("a", "a", 139, "", 1).reason, "st-run: signal");
  EXPECT_EQ(campaign_row("a", "a", 70, "no json", 1).reason, "st-run: internal");
}

TEST(Campaign, a_mesh_without_figures_has_a_row) {
  for (const char* said : {"{\"passes\":false,\"triangles\":null,\"failed\":[\"empty\"],\"stages\":{\"st-check\":{"
                           "\"quality\":{\"min\":null},\"lifting_surfaces\":[{\"held\":null}]}}}",
                           "{\"failed\":[\"empty\"],\"stages\":{\"st-check\":{\"quality\":null}}}"}) {
    const CampaignRow row = campaign_row("a", "a", 5, said, 1);
    EXPECT_EQ(row.verdict + ":" + row.reason, "fails:empty");
    EXPECT_EQ(row.triangles + row.quality, "");
  }
}

TEST(Campaign, the_key_is_that_of_settings_and_content) {
  const TemporaryDirectory folder;
  const std::vector<std::string> files{folder / "a", folder / "b"};
  write_text_file(files[0], "1");
  EXPECT_EQ(campaign_key("", files), "");
  write_text_file(files[1], "2");
  const std::string key = campaign_key("", files);
  EXPECT_EQ(key.size(), 32U);
  EXPECT_EQ(campaign_key("", files), key);
  EXPECT_NE(campaign_key("lmax = 1", files), key);
  write_text_file(files[1], "3");
  EXPECT_NE(campaign_key("", files), key);
}

TEST(Campaign, a_model_keeps_its_folder_and_takes_no_other_ones) {
  const std::vector<std::string> first{"m/a.step", "n/a.step", "b.step"}, later{"n/a.step", "o/a.step", "c.step"};
  const std::vector<std::string> names = campaign_names(first, {});
  EXPECT_EQ(names, (std::vector<std::string>{"a", "a_2", "b"}));
  std::vector<CampaignRow> rows(3);
  for (std::size_t i = 0; i < 3; ++i) {
    rows[i].model = first[i];
    rows[i].name = names[i];
  }
  EXPECT_EQ(campaign_names(later, rows), (std::vector<std::string>{"a_2", "a_3", "c"}));
}

TEST(Campaign, a_table_is_read_as_it_was_written) {
  const std::vector<CampaignRow> rows = three_rows();
  const std::string text = campaign_table(rows);
  const std::vector<CampaignRow> read = read_campaign_table(text);
  ASSERT_EQ(read.size(), 3U);
  EXPECT_EQ(campaign_table(read), text);
  EXPECT_EQ(read[2].model, rows[2].model);
  EXPECT_EQ(read_campaign_table(text.substr(0, text.size() - 3)).size(), 2U);
  EXPECT_TRUE(read_campaign_table("other,columns\n1,2\n").empty());
  EXPECT_TRUE(read_campaign_table("").empty());
}

TEST(Campaign, the_summary_counts_by_class) {
  std::vector<CampaignRow> rows = three_rows();
  EXPECT_EQ(campaign_summary(rows), "1 passes, 1 fails (folds closed), 1 error (st-import: input)");
  rows.push_back(rows[2]);
  EXPECT_EQ(campaign_summary(rows), "1 passes, 1 fails (folds closed), 2 errors (2 st-import: input)");
}

TEST(Campaign, the_page_has_the_worst_first_and_links_to_its_report) {
  const std::vector<std::string> pictures{"data:image/bmp;base64,AA==", "", ""};
  const std::string page = campaign_page(three_rows(), pictures, "runs");
  const std::size_t error = page.find("runs/c/log.txt"), fails = page.find("runs/b/report.html"),
                    passes = page.find("runs/a/report.html");
  EXPECT_LT(error, fails);
  EXPECT_LT(fails, passes);
  EXPECT_NE(passes, std::string::npos);
  EXPECT_NE(page.find("is empty, &lt;see>"), std::string::npos);
  EXPECT_NE(page.find("src=\"data:image/bmp;base64,AA==\""), std::string::npos);
}

}  // namespace
}  // namespace st
