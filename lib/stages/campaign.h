// Many models meshed by one command: what came out of each, as a table and a page.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace st {

/// A model's run. Numbers are text, as they stand in the table; empty: there is none.
struct CampaignRow {
  std::string model, name;  ///< its file; that of its folder of results
  std::string verdict;      ///< "passes", "fails", "error"
  std::string reason;       ///< class of failure: names of checks, or "st-import: input"; empty where it passes
  std::string code;         ///< exit code
  std::string triangles, surfaces, held;  ///< lifting surfaces: how many, and the smallest share of a span that has
                                          ///< what was asked for
  std::string quality;                    ///< smallest
  std::string seconds;
  std::string message;  ///< of an error
  std::string key;      ///< campaign_key(): a row with the same one need not run again
};

/// From what st-run says with --json (the last line of `said`, perhaps nothing) and its exit code.
CampaignRow campaign_row(const std::string& model, const std::string& name, int code, const std::string& said,
                         double seconds);

/// Digest of the version, the settings and the content of the files; empty where one cannot be read.
std::string campaign_key(const std::string& settings, std::span<const std::string> files);

/// Names of their own for folders: those of earlier rows of the same models, else stems of the files.
std::vector<std::string> campaign_names(std::span<const std::string> models, std::span<const CampaignRow> earlier);

/// CSV (RFC 4180) with a heading.
std::string campaign_table(std::span<const CampaignRow> rows);
/// What campaign_table() wrote; rows of another heading, and a torn last one, are left out.
std::vector<CampaignRow> read_campaign_table(const std::string& text);

/// The page: worst first, each with its picture and a link to `folder`/<name>/report.html. `pictures`: data URIs, as
/// rows; empty: none.
std::string campaign_page(std::span<const CampaignRow> rows, std::span<const std::string> pictures,
                          const std::string& folder);

/// "7 pass, 1 fails (folds), 2 errors (st-import: input)"
std::string campaign_summary(std::span<const CampaignRow> rows);

}  // namespace st
